#include "physics/friction/contact_curve.hpp"

namespace rsc {

// Index of the contact whose last level is nearer; a contact without a level is used first.
int ContactCurve::lane(double delta) const {
    if (!last_[0]) return 0;
    const double there = std::abs(-last_[0]->separation - delta);
    if (there == 0) return 0;
    if (!last_[1]) return 1;
    return there <= std::abs(-last_[1]->separation - delta) ? 0 : 1;
}

const Level& ContactCurve::level(double delta) {
    const int k = lane(delta);
    if (!last_[k] || last_[k]->separation != -delta) {
        last_[k].reset();  // after an exception there is no level instead of the old one
        last_[k] = std::make_unique<Level>(contact_[k]->at_separation(-delta));
        ++levels_;
        failed_ += !last_[k]->converged;
    }
    return *last_[k];
}

LoadCurve::Load ContactCurve::load(double delta) {
    if (!(delta > first_touch())) return {};
    const int k = lane(delta);
    const double force = level(delta).force;
    return {force, contact_[k]->energy()};
}

double ContactCurve::stiffness(double delta) {
    if (!(delta > first_touch())) return 0;
    const int k = lane(delta);
    (void)level(delta);
    return -contact_[k]->stiffness();
}

double ContactCurve::approach(double force) {
    last_[1].reset();
    last_[1] = std::make_unique<Level>(contact_[1]->at_force(force));
    ++levels_;
    failed_ += !last_[1]->converged;
    return -last_[1]->separation;
}

std::vector<SpotSlip> slip_of_spots(ContactCurve& curve, const FrictionHistory& history) {
    std::vector<SpotSlip> spots;
    const auto& nodes = history.state().nodes;
    if (nodes.size() < 2) return spots;
    const Level top = curve.level(history.approach());
    for (const auto k : indices(top.asperity)) spots.push_back({top.asperity[k], top.a[k], 0, {}});
    // Calls visit(spot, force, radius) for the contacts of a level that also exist at the top
    // level.
    const auto match = [&](const Level& level, auto&& visit) {
        std::size_t k = 0;
        for (const auto j : indices(level.asperity)) {
            while (k < spots.size() && spots[k].asperity < level.asperity[j]) ++k;
            if (k < spots.size() && spots[k].asperity == level.asperity[j])
                visit(spots[k], level.f[j], level.a[j]);
        }
    };
    // The sum over pieces of -p [f(end) - f(begin)] equals the sum over nodes of f (p_after -
    // p_before).
    const auto slope = [&](std::size_t piece) {
        const auto &begin = nodes[piece], &end = nodes[piece + 1];
        const double ds = end.approach - begin.approach;
        return ds > 0 ? Slide{(end.deflection.x - begin.deflection.x) / ds,
                              (end.deflection.y - begin.deflection.y) / ds}
                      : Slide{};
    };
    const double m = history.friction().ratio, stick = history.stick_approach();
    for (std::size_t n = 1; n < nodes.size(); ++n) {
        const Slide before = slope(n - 1), after = n + 1 < nodes.size() ? slope(n) : Slide{};
        const Level& level = curve.level(nodes[n].approach);
        match(level, [&](SpotSlip& spot, double f, double a) {
            spot.force.x += m * f * (after.x - before.x);
            spot.force.y += m * f * (after.y - before.y);
            if (nodes[n].approach == stick) spot.stick_radius = a;
        });
    }
    return spots;
}

}  // namespace rsc
