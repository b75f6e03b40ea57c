#include "trust/judge.hpp"

#include "base/error.hpp"
#include "physics/physics.hpp"
#include "trust/asperity_error.hpp"
#include "trust/counts.hpp"

namespace rsc {
namespace {

// Larger expected errors of N of asperities, or with adhesion, are a doubt.
constexpr double kMuchError = 0.1;

// A larger error of N by the steps of sliding is a doubt.
constexpr double kLongSteps = 0.01;

// Asperities: largest slope_ratio of a good level. Where it is larger, the bodies touch beside the
// summits.
constexpr double kSteepest = 0.2;

// Largest slope that counts as small, of the surface (kSteep of run/remarks.cpp) and of the
// indenter over the contacts alike.
constexpr double kSmallSlope = 0.5;

// A larger share of the contact area on filled points is a doubt.
constexpr double kMuchFilled = 0.01;

// Error of N by points that were filled from their neighbours, times their share. Found by hand:
// with 30 % of them N of elements was 1 to 3.4 % too low.
constexpr double kScattered = 0.15;

bool known_shape(const Indenter& indenter) {
    const std::string_view name = indenter.shape->name();
    return name == "sphere" || name == "paraboloid" || indenter.shape->flat();
}

// What the study of asperities against elements (input/trust) contains: no flats other than
// isotropic Gaussian ones.
bool calibrated(const Level& level, const Path& contact, const SolverOptions& options) {
    const bool layers = contact.indenter().layers.count > 0;
    const auto compared = [&](const Physics* p) {
        return p->calibrated && p->calibrated(options.physics, layers);
    };
    const std::vector<double> depths = contact.remains(level).residual_depths;
    const auto yielded = std::ranges::count_if(depths, [](double depth) { return depth > 0; });
    return is_compared(options.law) && options.interaction == Interaction::point &&
           options.selection == Selection::overlap &&
           std::ranges::all_of(physics_asked(options.physics), compared) &&
           known_shape(contact.indenter()) && options.surface.mean_spacing > 0 &&
           !(options.surface.measured && contact.indenter().shape->flat()) &&
           options.surface.gentlest_slope > 0 &&
           yielded <= level.plastic_contacts;  // otherwise some are unloaded
}

// A list of asperities is all that is known of its surface, so that there are no elements to
// compare with, and no error is stated. Its laws take the indenter for flat: where its curvature c
// is not small beside that of an asperity of radius r, forces are too large by sqrt(1 + c r).
std::vector<Doubt> of_list(const Level& level, const Path& contact) {
    const Indenter& indenter = contact.indenter();
    const auto asperities = contact.asperities();
    double all = 0, more = 0;
    for (const auto k : indices(level.asperity)) {
        const double r = asperities->radius[at(level.asperity[k])];
        const Vec2 d = indenter.from_tip(level.x[k], level.y[k]);
        const Tensor c = indenter.shape->curvature(d.x, d.y);
        const double f = std::abs(level.f[k]);
        all += f;
        more += f * (std::sqrt(1 + std::max(0.0, 0.5 * (c.xx + c.yy) * r)) - 1);
    }
    std::vector<Doubt> doubts = {{Cause::outside_calibration, kNotComputed, kNotComputed, false}};
    if (more > kMuchError * all) doubts.push_back({Cause::beyond_law});
    return doubts;
}

// Share of the points of a map that were filled from their neighbours.
double scattered_share(const Measured* measured) {
    return measured ? double(measured->missing - std::ranges::count(measured->filled, 1)) /
                          double(measured->points())
                    : 0.0;
}

// The force of all points under pressure, which is N but for points under tension.
double pressed_force(const Level& level) {
    double sum = 0;
    for (const double p : level.pixels.pressure) sum += std::max(p, 0.0);
    return sum * level.pixels.dx * level.pixels.dy;
}

// The errors of the quantities of elements: by the resolution, by the steps of sliding, and the
// error of N that other causes have.
void state_errors(Level& level, std::span<const Doubt> doubts, const GridBodies& bodies) {
    level.errors.fill(kNotComputed);
    double others = level.converged ? 0.0 : kNotComputed;
    for (const Doubt& doubt : doubts)
        if (doubt.cause != Cause::grid) others += doubt.force;
    for (const LevelQuantity& quantity : level_quantities())
        for (const auto c : indices(quantity.components())) {
            double error = error_of_resolution(quantity, c, level, bodies) + others;
            if (level.with_half_the_steps)
                error += std::abs(1 - quantity.of(*level.with_half_the_steps, c) /
                                          quantity.of(level, c));
            level.errors[quantity.slot + c] = error;
        }
    level.errors[find_quantity("area_fraction")->quantity->slot] = level.area_error_expected;
}

}  // namespace

Tensor curvature_at_unit_height(const Moments& m) {
    return {m.tensor.m20 / m.m0, m.tensor.m11 / m.m0, m.tensor.m02 / m.m0};
}

Judge::Judge(const SolverOptions& options, JudgedSurface surface)
    : options_(options), surface_(std::move(surface)) {}

void Judge::judge(Level& level, Path& contact, bool by_force) {
    const bool elements = surface_.map;
    const Indenter& indenter = contact.indenter();
    count_contacts(level, indenter, options_);
    if (!level.converged) return conclude(level, {}, by_force);
    // It makes an error of N one of Z0.
    if (by_force && std::isnan(level.stiffness)) level.stiffness = contact.stiffness();
    std::vector<Doubt> doubts =
        elements ? of_elements(level, contact, by_force) : of_asperities(level, contact);
    if (level.indenter_slope > kSmallSlope) doubts.push_back({Cause::steep_indenter});
    if (level.edge_contacts > 0) doubts.push_back({Cause::border});
    const std::vector<FilledPoints> filled =
        filled_points(surface_.measured, surface_.x0, surface_.y0, indenter);
    if (!filled.empty()) {
        level.filled_share = share_on_filled(level, filled, indenter, options_.surface.sigma);
        if (level.filled_share > kMuchFilled) doubts.push_back({Cause::filled_points});
    }
    conclude(level, doubts, by_force, elements ? pressed_force(level) : kNotComputed);
    if (elements) state_errors(level, doubts, bodies(indenter));
}

std::vector<Doubt> Judge::of_asperities(Level& level, const Path& contact) const {
    const Indenter& indenter = contact.indenter();
    std::vector<Doubt> doubts;
    const auto doubt = [&](bool is, Cause cause) {
        if (is) doubts.push_back({cause});
    };
    if (level.contacts == 0 && level.force == 0) {
        doubt(may_touch_between(*contact.asperities(), indenter, options_, level.separation),
              Cause::missed_contact);
        return doubts;
    }
    if (!(options_.surface.gentlest_slope > 0)) {
        doubts = of_list(level, contact);
        doubt(level.wide_contacts > 0, Cause::layer);
        return doubts;
    }
    doubt(level.slope_ratio > kSteepest, Cause::slope_ratio);
    doubt(level.wide_contacts > 0, Cause::layer);
    doubt(!calibrated(level, contact, options_) || exceeds_nominal_area(level),
          Cause::outside_calibration);
    doubt(few_points(options_), Cause::few_points);
    if (!doubts.empty()) return doubts;
    const AsperityError error = asperity_error(level, options_);
    doubt(std::isnan(error.force), Cause::beyond_law);
    doubts.push_back({Cause::model_error, error.force, error.area, error.force > kMuchError});
    if (const double share = share_on_spikes(level, options_); share > 0)
        doubts.push_back({Cause::few_points, share, share, share > kMuchError});
    return doubts;
}

std::vector<Doubt> Judge::of_elements(const Level& level, Path& contact, bool by_force) {
    std::vector<Doubt> doubts;
    const bool attracts = level.cohesive_area > 0;
    if (level.contacts == 0 && !attracts) {
        if (level.separation < touch_between(level, contact))
            doubts.push_back({Cause::missed_contact});
        return doubts;
    }
    for (const Physics* p : physics_asked(options_.physics))
        if (p->doubts_range && p->doubts_range(level, *surface_.map, options_.physics))
            doubts.push_back({Cause::range});
    doubts.push_back(grid(level, contact));
    for (const Physics* p : physics_asked(options_.physics))
        if (Doubt& few = doubts.back(); by_force && p->further_approach)
            few.separation += few.force * p->further_approach(level, *surface_.map,
                                                              contact.indenter(), options_.physics);
    if (level.with_half_the_steps) {
        const double error = level.sliding_error, depth = contact.first_touch() - level.separation,
                     area_error = std::abs(1 - level.with_half_the_steps->area / level.area);
        doubts.push_back({Cause::sliding_steps, by_force ? 0.0 : error, area_error,
                          error > kLongSteps, by_force ? error * depth : 0.0});
    }
    if (const double scattered = scattered_share(surface_.measured); scattered > 0) {
        const double share = kScattered * scattered;
        doubts.push_back({Cause::filled_points, share, share, share > kLongSteps});
    }
    return doubts;
}

// Upper bound of the Z0 at which the bodies touch, between the points of elements, too; -Infinity
// if the surface is lower than its map.
double Judge::touch_between(const Level& level, const Path& contact) {
    const Indenter& indenter = contact.indenter();
    const PlaceOfTip tip{indenter.x0, indenter.y0};
    if (!surface_.map || contact.relaxes() || !contact.remains(level).residual_profile.x.empty())
        return -kInfinity;
    if (between_at_ == tip) return between_;
    between_at_ = tip;
    if (!surface_.curvature) return between_ = touch_between_points(*surface_.map, indenter);
    // Not all heights of synthetic surfaces need be kept. A top is at most twice as curved as is
    // expected at its height.
    const Tensor& c = *surface_.curvature;
    const double dx = surface_.map->dx, dy = surface_.map->dy, touch = contact.first_touch();
    return between_ = touch + 0.25 * std::max(touch, options_.surface.sigma) *
                                  (std::abs(c.xx) * dx * dx + std::abs(c.yy) * dy * dy);
}

GridBodies Judge::bodies(const Indenter& indenter) const {
    const bool map = indenter.shape->keys().map != nullptr;
    return grid_bodies((options_.surface.measured && !surface_.curvature) || map, indenter);
}

// The error by the grid, with adhesion by the resolution of the edges, too.
Doubt Judge::grid(const Level& level, Path& contact) const {
    const Indenter& indenter = contact.indenter();
    const HeightMap& map = *surface_.map;
    const double side = map.step();
    const GridError by_size =
        error_of_grid(level, bodies(indenter), indenter.shape->edge(side), side);
    Doubt doubt{Cause::grid};
    for (const Physics* p : physics_asked(options_.physics)) {
        if (!p->grid_error) continue;
        const GridError error = p->grid_error(level, map, indenter, options_.physics, by_size);
        doubt.force = error.force;
        doubt.area = error.area;
        // Where tension nearly balances it, N is small beside what presses.
        doubt.serious = !(error.force * std::abs(level.force) <= kMuchError * pressed_force(level));
        return doubt;
    }
    const double stiffness = std::isnan(level.stiffness) ? contact.stiffness() : level.stiffness;
    const GridError crests = error_of_crests(level, stiffness, map, indenter, surface_.curvature);
    doubt.force = std::max(by_size.force, crests.force);
    doubt.area = std::max(by_size.area, crests.area);
    doubt.serious = doubt.force > kMuchForceError || doubt.area > kMuchAreaError;
    return doubt;
}

}  // namespace rsc
