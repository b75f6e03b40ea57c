#include "run/friction.hpp"

#include "contact/equivalent.hpp"

namespace rsc {

FrictionLevels::FrictionLevels(const Case& settings,
                               const std::function<std::unique_ptr<Path>()>& copy)
    : friction_{settings.solids.friction, tangential_ratio(settings.solids.E, settings.solids.nu)} {
    copies_[0] = copy();
    if (by_elements(settings)) {
        table_.emplace(*copies_[0]);
    } else {
        copies_[1] = copy();
        curve_.emplace(*copies_[0], *copies_[1]);
    }
}

bool FrictionLevels::add(const Level& level, FrictionLoops& loops) {
    constexpr int steps = 40;  // of first loading
    const double delta = -level.separation;
    const long before = failed();
    LoadCurve* curve = curve_ ? static_cast<LoadCurve*>(&*curve_) : &*table_;
    const bool touches = level.converged && delta > curve->first_touch();
    if (table_ && touches) {
        table_->add(level);
        table_->prepare(delta);
    }
    loops.points = slide_cycle_points(steps);
    loops.first = steps + 1;
    SlideCycle cycle;
    if (touches)
        cycle = slide_cycle(*curve, friction_, delta, steps);
    else
        cycle.displacement = cycle.force = std::vector<double>(loops.points, kNotComputed);
    loops.stiffness.push_back(touches ? -friction_.ratio * level.stiffness : kNotComputed);
    loops.cycle_work.push_back(touches ? cycle.work : kNotComputed);
    append(loops.displacement, cycle.displacement);
    append(loops.force, cycle.force);
    return failed() == before;
}

LevelPixels FrictionLevels::stuck(const Level& level, double share) {
    const double delta = -level.separation, touch = copies_[0]->first_touch();
    if (!(delta > -touch)) return {};
    return copies_[0]->at_separation(-(delta - share * (delta + touch))).pixels;
}

}  // namespace rsc
