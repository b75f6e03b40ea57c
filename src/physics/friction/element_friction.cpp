#include "physics/friction/element_friction.hpp"

#include "base/error.hpp"

namespace rsc {

ElementFriction::ElementFriction(Path& contact, const Friction& friction, const PointGrid& map,
                                 double tolerance)
    : contact_(contact),
      friction_(friction),
      map_(map),
      sliding_(contact.indenter(), friction, map, tolerance) {}

void ElementFriction::restore(State state) {
    const auto& t = state.tractions;
    const std::size_t n = t.pixels.size();
    const bool sound = t.limit.size() == n && t.q.size() == 2 * n && t.u.size() == 2 * n &&
                       t.slip.size() == 2 * n && std::ranges::is_sorted(t.pixels) &&
                       (n == 0 || (t.pixels.front() >= 0 && at(t.pixels.back()) < map_.points()));
    if (!sound) bad_input("the state does not belong to a contact with this friction");
    sliding_.move_tip(contact_.indenter());
    sliding_.restore(state.tractions);
    now_ = std::move(state);
}

// Slides to the pressures of a level, and takes its loads.
bool ElementFriction::follow(const Level& level, Slide by) {
    const bool solved = sliding_.slide(level.pixels, by);
    now_.load = level.force;
    now_.energy = contact_.energy();
    now_.step_lost = sliding_.step_lost();
    now_.tractions = sliding_.state();
    return solved && level.converged;
}

bool ElementFriction::go_to(double separation, Slide xi) {
    if (!std::isfinite(separation) || !std::isfinite(xi.x) || !std::isfinite(xi.y))
        bad_input("separation and slide must be finite");
    const Level level = contact_.at_separation(separation);
    const Slide by = now_.begun ? Slide{xi.x - now_.xi.x, xi.y - now_.xi.y} : Slide{};
    const bool solved = follow(level, by);
    now_.begun = true;
    now_.separation = separation;
    now_.xi = xi;
    return solved;
}

bool ElementFriction::move_tip(double x0, double y0) {
    contact_.move_tip(x0, y0);
    sliding_.move_tip(contact_.indenter());
    return !now_.begun || follow(contact_.at_separation(now_.separation), {});
}

// The pressures of the state.
LevelPixels ElementFriction::pressures() const {
    LevelPixels pixels;
    pixels.columns = map_.nx;
    pixels.index = now_.tractions.pixels;
    for (const double limit : now_.tractions.limit)
        pixels.pressure.push_back(friction_.coefficient > 0 ? limit / friction_.coefficient : 0.0);
    return pixels;
}

bool ElementFriction::slide_to(const std::vector<double>& xi, double* force) {
    for (const double x : xi)
        if (!(x >= 0) || std::isinf(x))
            bad_input("slides of first loading must be finite and not negative");
    std::vector<std::size_t> order(xi.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return xi[k]; });
    const LevelPixels pixels = pressures();
    sliding_.restore({});
    bool solved = true;
    double last = 0;
    for (const std::size_t k : order) {
        solved = sliding_.slide(pixels, {xi[k] - last, 0}) && solved;
        last = xi[k];
        force[k] = sliding_.force().x;
    }
    sliding_.restore(now_.tractions);
    return solved;
}

// Q grows with the slide; each trial is one increment from rest.
bool ElementFriction::slide_at_force(double Q, double& xi) {
    const double most = friction_.coefficient * now_.load;
    if (!(Q >= 0) || Q > most) bad_input("the tangential force must be from 0 to mu N = ", most);
    double low = 0, high = full_slip();
    bool solved = true;
    constexpr int halvings = 24;
    for (int k = 0; k < halvings && Q > 0; ++k) {
        xi = 0.5 * (low + high);
        double force = 0;
        solved = slide_to({xi}, &force) && solved;
        (force < Q ? low : high) = xi;
    }
    xi = Q > 0 ? 0.5 * (low + high) : 0.0;
    return solved;
}

std::vector<SpotSlip> ElementFriction::spots() const {
    std::vector<SpotSlip> spots;
    const auto& level = contact_.level();
    if (!level || !touches()) return spots;
    for (const int index : level->asperity) spots.push_back({.asperity = index, .force = {}});
    const auto& t = now_.tractions;
    const double area = map_.dx * map_.dy;
    const std::size_t n = t.pixels.size();
    for (const auto k : indices(n)) {
        SpotSlip& spot = spots.at(at(level->pixels.contact[k]));
        const double x = t.q[k], y = t.q[n + k];
        spot.radius += area / pi;
        if (std::hypot(x, y) < (1 - 1e-9) * t.limit[k]) spot.stick_radius += area / pi;
        spot.force.x += area * x;
        spot.force.y += area * y;
    }
    for (SpotSlip& spot : spots) {
        spot.radius = std::sqrt(spot.radius);
        spot.stick_radius = std::sqrt(spot.stick_radius);
    }
    return spots;
}

}  // namespace rsc
