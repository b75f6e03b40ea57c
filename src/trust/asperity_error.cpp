#include "trust/asperity_error.hpp"

#include "trust/asperity_error_table.hpp"

namespace rsc {
namespace {

// Mean contact radius, weighted by the forces.
double mean_radius(const Level& level) {
    return std::inner_product(level.f.begin(), level.f.end(), level.a.begin(), 0.0) /
           sum_of(level.f);
}

// Summits that are points of a grid of step h lie below the tops between them: by (u^2 + v^2)
// h^2/2r for a top beside the point by u h, v h, each from -1/2 to 1/2 at random. Relative to
// Hertz's penetration a^2/r this is h^2/a^2 times 1/12 on average, 0.147 or less in nine of ten
// cases; by n contacts it is averaged.
AsperityError below_tops(const Level& level, double h) {
    constexpr double average = 1.0 / 12, most = 0.147;
    const double part = average + (most - average) / std::sqrt(double(std::max(level.contacts, 1)));
    AsperityError error{0, 0};
    for (const auto k : indices(level.f)) {
        const double deeper = part * h * h / (level.a[k] * level.a[k]),
                     share = level.f[k] / level.force;
        error.force += share * (std::pow(1 + deeper, 1.5) - 1);
        error.area += share * deeper;
    }
    return error;
}

// Null: the law was not compared with elements.
const LawError* errors_of(LawKind kind) {
    const std::string_view name = kLawNames[at(kind)];
    const auto found = std::ranges::find(kLawErrors, name, &LawError::law);
    return found == std::end(kLawErrors) ? nullptr : found;
}

}  // namespace

bool is_compared(LawKind kind) { return errors_of(kind) != nullptr; }

AsperityError asperity_error(const Level& level, const SolverOptions& options) {
    const double radius = mean_radius(level) / options.surface.mean_spacing;
    const LawError* const law = errors_of(options.law);
    const auto bin = at(std::ranges::upper_bound(kRadii, radius) - std::begin(kRadii));
    if (!law || bin >= std::size(kRadii)) return {};
    const auto error = [&](std::size_t what) {
        return law->errors[what][bin] * (options.surface.measured ? law->of_files[what] : 1.0) *
               (level.plastic_contacts > 0 ? law->of_yielding[what] : 1.0);
    };
    const AsperityError grid = options.law == LawKind::hertz
                                   ? below_tops(level, options.surface.grid_step)
                                   : AsperityError{0, 0};
    return {error(0) + grid.force, error(1) + grid.area};
}

double least_stated_error(LawKind law) {
    const LawError* const errors = errors_of(law);
    return errors ? std::ranges::min(errors->errors[0]) : kInfinity;
}

bool few_points(const SolverOptions& options) {
    return !(options.surface.points_per_wave >= kFewestPointsPerWave);
}

double share_on_spikes(const Level& level, const SolverOptions& options) {
    if (!options.surface.marks || options.surface.marks->spikes.empty()) return 0;
    const MapMarks& marks = *options.surface.marks;
    double force = 0;
    for (const auto k : indices(level.x)) {
        const double near = std::max(1.5 * marks.reach, level.a[k]);
        const bool on_spike =
            std::ranges::any_of(marks.spikes, [&](const std::array<double, 2>& spike) {
                return std::hypot(spike[0] - level.x[k], spike[1] - level.y[k]) < near;
            });
        if (on_spike) force += level.f[k];
    }
    return force / level.force;
}

bool may_touch_between(const Asperities& asperities, const Indenter& indenter,
                       const SolverOptions& options, double Z0) {
    const double w = options.surface.mean_spacing;
    if (!(w > 0)) return false;
    // Grid points lie below the tops between them, which are within half a step in both directions.
    const double below = 0.125 * options.surface.grid_step * options.surface.grid_step;
    for (const auto i : indices(asperities)) {
        const double bend = asperities.kappa1.empty() ? 2 / asperities.radius[i]
                                                      : asperities.kappa1[i] + asperities.kappa2[i];
        const double top = asperities.z[i] + below * bend;
        if (!(top > Z0)) continue;  // the indenter is nowhere lower than its tip
        const Vec2 d = indenter.from_tip(asperities.x[i], asperities.y[i]);
        const Box around{d.x - w, d.x + w, d.y - w, d.y + w};
        if (top - indenter.shape->lowest(around) > Z0) return true;
    }
    return false;
}

}  // namespace rsc
