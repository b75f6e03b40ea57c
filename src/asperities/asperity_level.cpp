#include "asperities/asperity_level.hpp"

#include "asperities/spots.hpp"
#include "interaction/close_pairs.hpp"
#include "interaction/mesh.hpp"
#include "interaction/products.hpp"
#include "trust/expected_error.hpp"
#include "trust/validity.hpp"

namespace rsc {
namespace {

// Contact spots of a level on the surface; their long axes are in the direction of the smaller
// curvature.
std::vector<Spot> spots_of(const Level& level, const Law& law, const Asperities& asperities) {
    std::vector<Spot> spots;
    for (std::size_t k = 0; k < level.asperity.size(); ++k) {
        const double root = std::sqrt(law.axes(level.asperity[k]));
        spots.push_back({level.x[k], level.y[k], level.a[k] / root, level.a[k] * root,
                         asperities.angle[at(level.asperity[k])]});
    }
    return spots;
}

// Place on the flank of a summit where the indenter, with the slope s there, touches first, H^-1 s
// beside the top with the summit's curvatures H, or if the tip is nearer, there; and how much
// nearer than the top it is.
struct Flank {
    double nearer;  // [length]
    Vec2 way;       // from the top [length]
};
Flank flank_of(const Asperities& asperities, std::size_t i, const Indenter& indenter) {
    const Vec2 d = indenter.from_tip(asperities.x[i], asperities.y[i]),
               slope = indenter.shape->gradient(d.x, d.y);
    const bool round = asperities.kappa1.empty();
    const double c = round ? 1.0 : std::cos(asperities.angle[i]),
                 s = round ? 0.0 : std::sin(asperities.angle[i]);
    const double along = slope.x * c + slope.y * s, across = slope.y * c - slope.x * s;
    const double u = along * (round ? asperities.radius[i] : 1 / asperities.kappa2[i]);
    const double v = across * (round ? asperities.radius[i] : 1 / asperities.kappa1[i]);
    const double way = std::hypot(u, v),
                 part = way > 0 ? std::min(std::hypot(d.x, d.y) / way, 1.0) : 0.0;
    return {(part - 0.5 * part * part) * (along * u + across * v),
            {-part * (u * c - v * s), -part * (u * s + v * c)}};
}

// Largest Z0 at which the flank of a summit touches the indenter. `heights` (optional) are those of
// the surface at and around the places of the flanks that are highest as paraboloids, and under a
// tip below which no summit need lie; without them the touch is that of the paraboloids. Summits
// that are grid points lie below their tops, which are within half a step in both directions.
double beside(const Asperities& asperities, const Indenter& indenter,
              const SolverOptions& options) {
    constexpr std::size_t kMost = 40;
    struct Touch {
        double touch;
        Vec2 summit, way;
    };
    std::vector<Touch> flanks;
    const double below_top =
        traits(options.law).between_points ? 0.0 : 0.125 * options.grid_step * options.grid_step;
    double highest = -kInfinity;
    for (std::size_t i = 0; i < asperities.size(); ++i) {
        const auto [nearer, way] = flank_of(asperities, i, indenter);
        const double bend = asperities.kappa1.empty() ? 2 / asperities.radius[i]
                                                      : asperities.kappa1[i] + asperities.kappa2[i];
        const double clear = indenter.clearance(asperities.x[i], asperities.y[i], asperities.z[i]),
                     touch = clear + nearer;
        highest = std::max(highest, clear + below_top * bend);
        if (!std::isfinite(touch)) continue;  // beside the indenter
        flanks.push_back({touch, indenter.image(asperities.x[i], asperities.y[i]), way});
    }
    std::partial_sort(flanks.begin(),
                      flanks.begin() + static_cast<std::ptrdiff_t>(std::min(flanks.size(), kMost)),
                      flanks.end(),
                      [](const Touch& a, const Touch& b) { return a.touch > b.touch; });
    if (!traits(options.law).between_points &&
        indenter.shape->keys().map)  // the highest points of both bodies may meet
        for (std::size_t i = 0; i < asperities.size(); ++i) {
            const Vec2 d = indenter.from_tip(asperities.x[i], asperities.y[i]);
            const double w = options.mean_spacing;
            highest =
                std::max(highest, asperities.z[i] -
                                      indenter.shape->lowest({d.x - w, d.x + w, d.y - w, d.y + w}));
        }
    if (!options.heights || indenter.shape->flat())
        return flanks.empty() ? highest : std::max(highest, flanks[0].touch);
    flanks.resize(std::min(flanks.size(), kMost));
    std::vector<Vec2> places;
    constexpr int kRings = 8, kAround = 12;
    const double wide = std::min(indenter.shape->reach(), options.mean_spacing);
    for (int k = 0; k <= kRings * kAround; ++k) {  // under the tip, to the next summit
        const double r = wide * ((k + kAround - 1) / kAround) / kRings,
                     t = 2 * std::numbers::pi * k / kAround;
        places.push_back({indenter.x0 + r * std::cos(t), indenter.y0 + r * std::sin(t)});
    }
    for (const Touch& f : flanks)
        for (const double part : {0.6, 1.0, 1.4})
            places.push_back({f.summit.x + part * f.way.x, f.summit.y + part * f.way.y});
    Vec2 best{};
    const auto look = [&](std::vector<Vec2> at) {
        std::sort(at.begin(), at.end(), [](const Vec2& a, const Vec2& b) {
            return a.y < b.y;
        });  // rows are made one after the other
        const std::vector<double> z = options.heights(at);
        for (std::size_t k = 0; k < z.size(); ++k)
            if (const double touch = indenter.clearance(at[k].x, at[k].y, z[k]); touch > highest)
                highest = touch, best = at[k];
    };
    look(std::move(places));
    const double far = flanks.empty() ? 0.0 : 0.25 * std::hypot(flanks[0].way.x, flanks[0].way.y);
    for (double step = std::max(far, wide / kRings), last = 0.01 * step; step > last; step *= 0.6) {
        places.clear();
        for (const double y : {-step, 0.0, step})
            for (const double x : {-step, 0.0, step}) places.push_back({best.x + x, best.y + y});
        look(places);
    }
    return highest;
}

// The points under the edge of the indenter, as dense as the grid of the surface.
void find_edge(const ContactBodies& bodies, double radius) {
    const Indenter& indenter = bodies.indenter;
    EdgePoints& edge = bodies.edge;
    if (edge.x0 == indenter.x0 && edge.y0 == indenter.y0) return;
    edge = {indenter.x0, indenter.y0, {}};
    constexpr double kFewest = 64, kMost = 1e5;
    const double step = bodies.options.grid_step, round = 2 * std::numbers::pi * radius;
    const int count =
        radius > 0 ? static_cast<int>(std::clamp(step > 0 ? round / step : kFewest, kFewest, kMost))
                   : 1;
    std::vector<Vec2> places;
    for (int k = 0; k < count; ++k) {
        const double t = 2 * std::numbers::pi * k / count;
        places.push_back({indenter.x0 + radius * std::cos(t), indenter.y0 + radius * std::sin(t)});
    }
    const std::vector<double> z = bodies.options.heights(places);
    for (std::size_t k = 0; k < z.size(); ++k)
        edge.points.push_back({places[k].x, places[k].y, z[k] - indenter.shape->height(radius, 0)});
}

// Error of the attraction within a range, of which the surface beside the summits has a part, too
// (chosen on some 30 random cases by both models, test/README).
constexpr double kAttraction = 0.3;

// Expected errors with adhesion: bounds were calibrated without it, so they are those of the forces
// that press, of which N is a part. What attracts without contact is underestimated by an unknown
// share, because only summits do.
void expect_error_of_pressed(Level& level, const Asperities& asperities, const Indenter& indenter,
                             const SolverOptions& options, const ContactTraits& contacts) {
    Level pressed = level;
    pressed.f.clear();
    for (std::size_t k = 0; k < level.tractions.a.size(); ++k)
        if (level.tractions.a[k] > 0) pressed.f.push_back(level.tractions.pressed[k]);
    pressed.force = std::accumulate(pressed.f.begin(), pressed.f.end(), 0.0);
    expect_error(pressed, asperities, indenter, options, contacts);
    if (level.force == 0) return;
    if (level.contacts == 0 && options.mean_spacing > 0)
        level.status = graver(level.status, LevelStatus::out_of_validity);
    level.force_error_expected =
        pressed.force_error_expected * std::max(pressed.force / std::abs(level.force), 1.0);
    if (options.adhesion.range > 0) {
        const double pulled =
            std::accumulate(level.tractions.pulled.begin(), level.tractions.pulled.end(), 0.0);
        level.force_error_expected += kAttraction * std::abs(pulled / level.force);
    }
    level.area_error_expected = pressed.area_error_expected;
    level.error_cause = pressed.error_cause;
}

// Force that the edge of the indenter would carry where it is deeper than the surface, which is
// lowered by the contacts. Summits do not represent the edge. Each point counts as if the whole
// edge were as deep.
double carried_by_edge(const Level& level, const ContactBodies& bodies) {
    const Indenter& indenter = bodies.indenter;
    const double radius = indenter.shape->edge(bodies.blunt);
    if (!(radius >= 0) || !bodies.options.heights) return 0;
    find_edge(bodies, radius);
    const SmoothContact carried = indenter.shape->smooth(indenter.E_star)
                                      .value_or(SmoothContact{2 * indenter.E_star * radius});
    double sum = 0;
    for (const auto& [x, y, touch] : bodies.edge.points) {
        double gap = touch - level.separation;
        for (std::size_t k = 0;
             k < level.x.size() && gap > 0 && bodies.kernel && !bodies.kernel->none(); ++k) {
            const double d = std::hypot(indenter.around.nearest_x(level.x[k] - x),
                                        indenter.around.nearest_y(level.y[k] - y));
            const double a = level.a[k], f = level.f[k] / indenter.E_star;
            gap -= d < a ? 0.75 * f / a * (1 - 0.5 * d * d / (a * a))
                         : f / (std::numbers::pi * d);  // within a spot: of Hertz's pressure
        }
        if (gap > 0) sum += carried.force(gap);
    }
    return sum / static_cast<double>(bodies.edge.points.size());
}

// Options with the points on the border of a synthetic surface, which summits do not represent, if
// the indenter may touch them.
std::optional<SolverOptions> with_rim(const Level& level, const ContactBodies& bodies) {
    const SolverOptions& options = bodies.options;
    const Indenter& indenter = bodies.indenter;
    const Rectangle& s = options.surface;
    if (options.marks || !options.heights || !s.known() || !(options.grid_step > 0) ||
        indenter.period.finite() || indenter.around.finite())
        return {};
    constexpr double kHighest = 5;  // rms heights
    const double west = s.x0 - indenter.x0, south = s.y0 - indenter.y0, east = west + s.Lx,
                 north = south + s.Ly;
    double lowest = kInfinity;
    for (const Box& side : {Box{west, west, south, north}, Box{east, east, south, north},
                            Box{west, east, south, south}, Box{west, east, north, north}})
        lowest = std::min(lowest, indenter.shape->lowest(side));
    if (!(kHighest * options.sigma - lowest > level.separation)) return {};
    if (!bodies.rim) {
        const auto nx = std::lround(s.Lx / options.grid_step),
                   ny = std::lround(s.Ly / options.grid_step);
        if (nx < 3 || ny < 3) return {};
        std::vector<Vec2> places;
        for (long j = 0; j < ny; ++j)
            for (long i = 0; i<nx; i += j> 0 && j < ny - 1 ? nx - 1 : 1)
                places.push_back({s.x0 + static_cast<double>(i) * options.grid_step,
                                  s.y0 + static_cast<double>(j) * options.grid_step});
        const std::vector<double> z = options.heights(places);
        auto marks = std::make_shared<MapMarks>();
        for (std::size_t k = 0; k < z.size(); ++k)
            marks->border.push_back({places[k].x, places[k].y, z[k]});
        marks->reach = options.grid_step;
        bodies.rim = std::move(marks);
    }
    SolverOptions with = options;
    with.marks = bodies.rim;
    return with;
}

// True if the summits of the difference between surface and indenter differ from those of the
// surface.
bool shifts_summits(const Indenter& indenter, const SolverOptions& options) {
    require_sound(indenter);
    return !indenter.shape->flat() && traits(options.law).between_points && options.rms_slope > 0;
}

// Asperities of a list touch a flat, whatever the curvature c of the indenter at the contact (on a
// cone's tip that at the rim of the contact): by Hertz's law their force is too large by sqrt(1 + c
// r), their area by 1 + c r. The change of N and A, relative; 0 for summits of a surface, which
// slope_ratio judges.
std::pair<double, double> stiffened(const Level& level, const ContactBodies& bodies) {
    const Asperities& asperities = bodies.asperities;
    if (bodies.options.rms_slope > 0 || level.contacts == 0) return {0, 0};
    double force = 0, area = 0, of_force = 0, of_area = 0;
    for (std::size_t k = 0; k < level.asperity.size(); ++k) {
        const auto i = at(level.asperity[k]);
        const double r = asperities.kappa1.empty()
                             ? asperities.radius[i]
                             : 2 / (asperities.kappa1[i] + asperities.kappa2[i]);
        const double x = level.x[k] - bodies.indenter.x0, y = level.y[k] - bodies.indenter.y0,
                     rim = std::max(level.a[k], std::hypot(x, y));
        const auto c = rim > std::hypot(x, y) ? bodies.indenter.shape->curvature(rim, 0)
                                              : bodies.indenter.shape->curvature(x, y);
        const double softer = 1 + std::max(0.0, 0.5 * (c.xx + c.yy) * r), f = std::abs(level.f[k]),
                     A = level.a[k] * level.a[k];
        force += f, of_force += f * (std::sqrt(softer) - 1);
        area += A, of_area += A * (softer - 1);
    }
    return {force > 0 ? of_force / force : 0.0, area > 0 ? of_area / area : 0.0};
}

// Difference of the indenter's face from the paraboloid that the law takes it for, a contact radius
// from a summit of mean curvature `kappa` at an offset (x, y) from the tip, over the paraboloid's
// own descent; at most 1. The mean of eight points: large beside the corner of a cone.
double unlike_paraboloid(const IndenterShape& shape, double x, double y, double a, double kappa) {
    const double middle = shape.height(x, y), descent = 0.5 * kappa * a * a;
    const Vec2 g = shape.gradient(x, y);
    const Tensor c = shape.curvature(x, y);
    double sum = 0;
    constexpr int points = 8;
    for (int k = 0; k < points; ++k) {
        const double t = 2 * std::numbers::pi * k / points, u = a * std::cos(t),
                     v = a * std::sin(t);
        const double rest = shape.height(x + u, y + v) - middle - g.x * u - g.y * v -
                            0.5 * (c.xx * u * u + 2 * c.xy * u * v + c.yy * v * v);
        sum += std::min(std::abs(rest) / descent, 1.0);
    }
    return sum / points;
}

// With the spacing of summits and the points per wave of the finer of two rough bodies: contacts
// are as small and as close as its waves.
SolverOptions of_both(SolverOptions options, const Indenter& indenter) {
    const ShapeKeys& second = indenter.shape->keys();
    if (second.spacing > 0 && options.mean_spacing > 0)
        options.mean_spacing = std::min(options.mean_spacing, second.spacing);
    if (second.shortest_wave > 0 && options.points_per_wave > 0 && options.grid_step > 0)
        options.points_per_wave =
            std::min(options.points_per_wave, second.shortest_wave / options.grid_step);
    return options;
}

}  // namespace

ContactBodies::ContactBodies(const Asperities& given, const Indenter& indenter_,
                             const SolverOptions& options_)
    : of_surface(given),
      options(of_both(options_, indenter_)),
      blunt(std::accumulate(given.radius.begin(), given.radius.end(), 0.0) /
            static_cast<double>(given.size())),
      indenter(indenter_),
      of_difference(
          shifts_summits(indenter, options)
              // beyond half the mean distance of summits lies the range of others
              ? std::make_unique<ShiftedSummits>(of_surface, indenter, 0.5 * options.mean_spacing)
              : nullptr),
      asperities(of_difference ? of_difference->summits() : of_surface),
      kernel(make_kernel(options_.interaction, substrate_of(indenter_), indenter_.period)) {}

// `auto`: direct or mesh by the estimated cost of a Newton solve, with rates measured by
// test/bench. The dense method is never the cheapest.
Method choose_method(const SolverOptions& options, const Kernel& kernel,
                     const WorkingSet& candidates) {
    if (kernel.none()) return options.method == Method::dgesv ? Method::dgesv : Method::direct;
    if (options.method != Method::automatic) return options.method;
    // A solve takes about 40 inner products. The overhead of the mesh includes its setup and denser
    // points near the middle.
    constexpr double contacts_per_candidate = 0.4, mesh_overhead = 4;
    const double contacts = contacts_per_candidate * static_cast<double>(candidates.size());
    // length scale of a smooth part, relative to the extent of the candidates Between flats the
    // finer mesh is left out: direct sums are slower by the same factor.
    double scale = 1e300;
    if (kernel.smooth() && !kernel.lattice() && candidates.size() > 0) {
        const auto [west, east] = std::minmax_element(candidates.x.begin(), candidates.x.end());
        const auto [south, north] = std::minmax_element(candidates.y.begin(), candidates.y.end());
        scale = kernel.smooth()->scale() / std::max({*east - *west, *north - *south, 1e-300});
    }
    const double mesh_cost =
        mesh_overhead * MeshPotential::estimated_cost(at(candidates.size()), 1e-3, 1, scale);
    return contacts * contacts / direct_rate(kernel, at(candidates.size())) > mesh_cost
               ? Method::mesh
               : Method::direct;
}

void judge_asperities(Level& level, const Law& law, const ContactBodies& bodies) {
    const Asperities& asperities = bodies.asperities;
    const Indenter& indenter = bodies.indenter;
    const SolverOptions& options = bodies.options;
    ContactTraits contacts;
    if (traits(options.law).elliptic_spots) {
        level.spots = spots_of(level, law, asperities);
        level.area =
            union_area(level.spots, &level.overlapping_pairs, indenter.period, &level.own_area);
        double all = 0;
        for (const Spot& s : level.spots) all += std::numbers::pi * s.major * s.minor;
        if (all > 0) contacts.twice = std::max(0.0, 1 - level.area / all);
    } else {
        level.overlapping_pairs = count_overlapping(level.x, level.y, level.a, indenter.period);
    }
    if (level.overlapping_pairs > 0) level.status = LevelStatus::overlapping;
    if (options.rms_slope > 0)
        level.slope_ratio = steepest_contact(level, indenter) / options.rms_slope;
    const IndenterShape& shape = *indenter.shape.operator->();
    double upright = 0, leaning = 0;  // N, and what it were with contacts on the flanks
    for (std::size_t k = 0; k < level.asperity.size(); ++k) {
        const int i = level.asperity[k];
        contacts.yielded += law.deepest(i) > 0;
        const double x = level.x[k] - indenter.x0, y = level.y[k] - indenter.y0,
                     f = std::abs(level.f[k]);
        upright += f;
        if (bodies.of_difference && !shape.keys().map)
            contacts.bent +=
                f * unlike_paraboloid(shape, x, y, level.a[k],
                                      0.5 * (asperities.kappa1[at(i)] + asperities.kappa2[at(i)]));
        if (!bodies.of_difference && options.rms_slope > 0 && !shape.flat() && level.u[k] > 0) {
            const Vec2 g = shape.gradient(x, y);
            const double largest =
                asperities.kappa2.empty() ? asperities.radius[at(i)] : 1 / asperities.kappa2[at(i)];
            const bool gentle = 0.5 * largest * (g.x * g.x + g.y * g.y) <
                                0.01 * level.u[k];  // the force is within 1.5 %
            leaning +=
                f * (gentle
                         ? 1.0
                         : std::pow(1 + flank_of(asperities, at(i), indenter).nearer / level.u[k],
                                    1.5));
        }
    }
    if (upright > 0) contacts.bent /= upright;
    if (leaning > upright) contacts.flanks = 1 - upright / leaning;
    // Those that yielded at another position of the tip are out of reach: lower than this level by
    // more than any can recover.
    double most = 0;
    for (const int i : law.yielded()) most = std::max(most, law.deepest(i));
    for (const int i : law.yielded()) {
        const double deepest = law.deepest(i),
                     top = indenter.clearance(asperities.x[at(i)], asperities.y[at(i)],
                                              asperities.z[at(i)]);
        if (top - deepest < level.separation - 2 * most) continue;
        contacts.yielded_force += law.response(i, deepest).force,
            contacts.yielded_area += law.area(i, deepest);
    }
    if (options.adhesion.work > 0)
        expect_error_of_pressed(level, asperities, indenter, options, contacts);
    else
        expect_error(level, asperities, indenter, options, contacts);
    if (const double carried = carried_by_edge(level, bodies), N = std::abs(level.force);
        carried > 0) {
        if (carried > kMuchError * N) {
            level.status = graver(level.status, LevelStatus::out_of_validity);
            level.error_cause = kEdgeCause;
        }
        if (N > 0)
            level.force_error_expected += carried / N, level.area_error_expected += carried / N;
    }
    const auto rim = with_rim(level, bodies);
    judge_range(level, indenter, rim ? *rim : options);
    if (const auto [force, area] = stiffened(level, bodies); force > 0) {
        const auto also = [](double expected) { return std::isnan(expected) ? 0.0 : expected; };
        if (force > also(level.force_error_expected)) level.error_cause = kCurvedCause;
        level.force_error_expected = also(level.force_error_expected) + force;
        level.area_error_expected = also(level.area_error_expected) + area;
        if (level.force_error_expected > kMuchError)
            level.status = graver(level.status, LevelStatus::out_of_validity);
    }
    // Summits of the surface are the contact points only if the indenter is nearly flat beside
    // them, and a search may miss some.
    const bool of_surface = !bodies.of_difference;
    const auto flank_touches = [&] {
        FlankTouch& flanks = bodies.flanks;
        if (flanks.x0 != indenter.x0 || flanks.y0 != indenter.y0)
            flanks = {indenter.x0, indenter.y0, beside(bodies.of_surface, indenter, options)};
        return level.separation < flanks.Z0;
    };
    if ((of_surface && level.slope_ratio > kMostSlopeRatio) ||
        (level.contacts == 0 && flank_touches()))
        level.status = graver(level.status, LevelStatus::out_of_validity);
}

}  // namespace rsc
