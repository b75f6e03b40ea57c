#include "run/friction_loops.hpp"

#include <limits>

namespace rsc {
namespace {

constexpr int kSteps = 40;  // of first loading

}  // namespace

FrictionRows::FrictionRows(const Friction& friction, std::unique_ptr<Contact> one, std::unique_ptr<Contact> other)
    : friction_(friction), one_(std::move(one)), other_(std::move(other)), curve_(*one_, *other_) {}

bool FrictionRows::add(const Level& level, FrictionLoops& loops) {
    const double delta = -level.separation;
    const long failed = curve_.failed();
    loops.points = slide_cycle_points(kSteps);
    loops.first = kSteps + 1;
    SlideCycle cycle;
    if (delta > curve_.first_touch()) {
        cycle = slide_cycle(curve_, friction_, delta, kSteps);
        loops.stiffness.push_back(-friction_.ratio * level.stiffness);
        loops.cycle_work.push_back(cycle.work);
    } else {
        const double absent = std::numeric_limits<double>::quiet_NaN();
        cycle.displacement.assign(loops.points, absent);
        cycle.force = cycle.displacement;
        loops.stiffness.push_back(absent);
        loops.cycle_work.push_back(absent);
    }
    loops.displacement.insert(loops.displacement.end(), cycle.displacement.begin(), cycle.displacement.end());
    loops.force.insert(loops.force.end(), cycle.force.begin(), cycle.force.end());
    return curve_.failed() == failed;
}

}  // namespace rsc
