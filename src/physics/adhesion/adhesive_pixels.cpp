#include "physics/adhesion/adhesive_pixels.hpp"

#include "base/error.hpp"
#include "base/format.hpp"
#include "base/parallel.hpp"
#include "elements/connected_pixels.hpp"
#include "elements/pixel_spots.hpp"
#include "physics/adhesion/adhesive_elements.hpp"

namespace rsc {
namespace {

// Smallest ratio of the cohesive length to the side of a pixel, and that of accurate forces.
constexpr double kCoarsest = 0.5, kFine = 4;
// Largest error of the work of a step, relative to w times the area that attracts: beyond it the
// step is divided, at once into this number of pieces at most, and never below this share of a
// level's way.
constexpr double kWorkShare = 0.003, kMostPieces = 8, kShortest = 1.0 / 4096;
constexpr double kJump = 0.1;  // least dissipated energy of a jump, relative to w times its area
constexpr double kFewest = 8;  // and least number of its points
constexpr double kInnerError = 1e-3;  // error of products in iterations
// Number of renewals after which pixels no longer leave the attracting set, so that the iteration
// ends; and largest number.
constexpr int kQuick = 200, kMost = 2000;
// Longest piece of a way of the tip: change of the clearances of attracting points relative to z0,
// and number of pixel sides.
constexpr double kPiece = 0.25, kPieceSides = 0.25;

}  // namespace

void require_resolved(double E_star, const Adhesion& adhesion, double step) {
    const double resolution = cohesive_length(E_star, adhesion) / step;
    if (!(resolution < kCoarsest)) return;
    const double wanted = std::sqrt(kFine / resolution);
    throw Error(
        Failure::bad_input,
        format("solids%%adhesion_range = %.6g: the attraction at the edge of a contact acts "
               "across %.2g of a pixel's side, (pi/4) E* adhesion_range^2/adhesion; "
               "elements need 0.5 at least, and 4 for accurate forces: %.2g times as many "
               "points a side, or adhesion_range = %.2g",
               adhesion.range, resolution, kFine / resolution, wanted * adhesion.range));
}

AdhesivePixels::AdhesivePixels(const HeightMap& heights_, const Indenter& indenter_,
                               const SolverOptions& options_)
    : CutMap(heights_),
      heights(heights_),
      indenter(indenter_),
      options(options_),
      s0(options.adhesion.work / options.adhesion.range),
      z0(options.adhesion.range),
      pixel(heights.dx * heights.dy) {
    const auto refuse = [](const std::string& what) {
        throw Error(Failure::bad_input, "solids%adhesion: " + what);
    };
    if (!(z0 > 0))
        refuse("boundary elements require solids%adhesion_range > 0 (JKR is the limit of 0)");
    if (std::isfinite(options.hardness.H0)) refuse("not available yet with solids%hardness");
    if (!options.relaxation.none()) refuse("not available yet with solids%relaxation_share");
    require_resolved(indenter.E_star, options.adhesion, std::max(heights.dx, heights.dy));
    const Substrate body = substrate_of(indenter);
    if (indenter.period.finite()) {
        raised = heights.copy();
        set_clearances();
        flats = std::make_unique<PeriodicElements>(
            Relief{raised.nx, raised.ny, raised.dx, raised.dy, raised.data.get(), raised.stride},
            body, kInfinity);
    } else {
        bulge = body.bulge();
        products = make_tree_products(body, heights.dx, heights.dy, kInnerError,
                                      0.1 * options.tolerance, false);
        field = make_tree_products(body, heights.dx, heights.dy, kInnerError,
                                   0.1 * options.tolerance, false);
        spots.emplace(*products, kInfinity);
        set_clearances();
    }
    forget();
}

// Of the present position of the tip.
void AdhesivePixels::set_clearances() {
    cut_open(indenter, 1);
    clearance.resize(at(heights.nx) * at(heights.ny));
    for (int j = 0; j < heights.ny; ++j)
        for (int i = 0; i < heights.nx; ++i) {
            const double z = indenter.clearance(heights.x0 + i * heights.dx,
                                                heights.y0 + j * heights.dy, heights(i, j));
            clearance[at(j) * at(heights.nx) + at(i)] = z;
            if (raised.data) raised.row(j)[i] = z;
        }
    top = *std::max_element(clearance.begin(), clearance.end());
}

// No level, and no point attracts.
void AdhesivePixels::forget() {
    accepted = {};
    tried.reset();
    margin = bulged = 0;
    for (std::vector<double>* values : {&q, &gap_before, &p_before})
        values->assign(clearance.size(), 0.0);
    on.assign(clearance.size(), 0);
}

// Selects the points whose gap can be below z0 if points are raised by at most the margin and
// `bulged`; for periodic flats all points.
void AdhesivePixels::gather(double Z) {
    reach.clear();
    std::vector<Pixel> pixels;
    for (int j = 0; j < heights.ny; ++j)
        for (int i = 0; i < heights.nx; ++i) {
            const std::int32_t k = place({i, j});
            if (flats || on[at(k)] || clearance[at(k)] > Z - z0 - margin - bulged)
                reach.push_back(k), pixels.push_back({i, j});
            else
                q[at(k)] = 0;
        }
    if (field && !pixels.empty()) field->set_pixels(pixels);
}

// K p at the points within reach.
std::vector<double> AdhesivePixels::deflections(const std::vector<double>& p) {
    std::vector<double> u(p.size());
    if (p.empty()) return u;
    if (!flats) {
        field->apply(p.data(), u.data(), PixelProducts::Accuracy::full);
        return u;
    }
    std::vector<Pixel> where;
    std::vector<double> some;
    for (std::size_t k = 0; k < p.size(); ++k)
        if (p[k] != 0) where.push_back(pixel_at(reach[k])), some.push_back(p[k]);
    return flats->deflections(where, some);
}

// Solves for q with fixed attracting points. Returns false if it does not converge.
bool AdhesivePixels::press(double Z, Level& level) {
    ElementsOutcome outcome;
    if (flats) {
        for (std::size_t k = 0; k < reach.size(); ++k)
            raised.row(reach[k] / heights.nx)[reach[k] % heights.nx] = clearance[k] + lift[k];
        flats->heights_changed();
        outcome = flats->approach(Z, options.tolerance, options.max_iterations);
        std::fill(q.begin(), q.end(), 0.0);
        for (std::size_t k = 0; k < flats->pixels().size(); ++k)
            q[at(flats->pixels()[k].y) * at(heights.nx) + at(flats->pixels()[k].x)] =
                flats->pressures()[k];
    } else {
        std::vector<Pixel> pixels;
        std::vector<double> g0, p;
        for (std::size_t k = 0; k < reach.size(); ++k) {
            double& here = q[at(reach[k])];
            const double g = clearance[at(reach[k])] - Z + lift[k];
            if (g > -bulged)
                pixels.push_back(pixel_at(reach[k])), g0.push_back(g), p.push_back(here);
            here = 0;
        }
        outcome = spots->solve(pixels, g0, options.tolerance, options.max_iterations, p);
        for (std::size_t k = 0; k < p.size(); ++k) q[at(place(pixels[k]))] = p[k];
    }
    level.iterations += outcome.iterations;
    level.products += outcome.products + 2;
    level.residual = outcome.residual;
    return outcome.converged;
}

// Finds the state at Z by renewing the attracting points, starting from the present ones. Returns
// false if it does not converge.
bool AdhesivePixels::renew(double Z, Level& level) {
    gather(Z);
    for (int round = 0; round < kMost; ++round) {
        stopping_point();
        std::vector<double> p(reach.size());
        for (std::size_t k = 0; k < reach.size(); ++k) p[k] = on[at(reach[k])] ? s0 : 0.0;
        lift = deflections(p);
        const double most = lift.empty() ? 0.0 : *std::max_element(lift.begin(), lift.end());
        if (!flats && most > margin) {
            margin = 1.5 * most;
            gather(Z);
            continue;
        }
        if (!press(Z, level)) return false;
        if (const double most_bulged = bulge * pixel * std::accumulate(q.begin(), q.end(), 0.0);
            most_bulged > bulged) {
            bulged = 1.5 * most_bulged;
            gather(Z);
            continue;
        }
        for (std::size_t k = 0; k < reach.size(); ++k) p[k] = q[at(reach[k])];
        p = deflections(p);
        long changed = 0;
        for (std::size_t k = 0; k < reach.size(); ++k) {
            const std::size_t i = at(reach[k]);
            gap[i] = p[k] - (lift[k] + clearance[i] - Z);
            char& attracts = on[i];
            const char next = gap[i] < z0 || (round > kQuick && attracts);
            changed += next != attracts;
            attracts = next;
        }
        if (changed == 0) return true;
    }
    return false;
}

Level AdhesivePixels::step(double Z) {
    now = accepted;
    std::fill(on.begin(), on.end(), char(0));
    for (const std::int32_t k : accepted.attracting) on[at(k)] = 1;
    Level level;
    level.separation = Z;
    level.method = Method::automatic;
    gap.resize(clearance.size());
    for (std::size_t i = 0; i < gap.size(); ++i) gap[i] = Z - clearance[i];
    const bool converged = renew(Z, level);
    level.candidates = static_cast<std::int32_t>(reach.size());
    now.separation = Z;
    now.attracting.clear();
    std::vector<Pixel> touching;
    std::vector<double> pressures;
    double twice = 0, attraction = 0, tension = 0;
    long cohesive = 0;
    for (std::size_t k = 0; k < reach.size() && converged; ++k) {
        const std::size_t i = at(reach[k]);
        const Pixel here = pixel_at(reach[k]);
        twice += pressure(i) * (gap[i] + clearance[i] - Z);
        if (q[i] > 0) touching.push_back(here), pressures.push_back(pressure(i));
        if (!on[i]) continue;
        now.attracting.push_back(reach[k]);
        attraction += s0 * (z0 - gap[i]);
        if (!(q[i] > 0))
            tension += s0, ++cohesive,
                level.pixels.cohesive.push_back(here.y * heights.nx + here.x);
    }
    std::sort(now.attracting.begin(), now.attracting.end());
    add_pixels(level, frame, indenter, kInfinity, touching, std::move(pressures), s0);
    number_by_map(level);
    level.pixels.tension = -s0;
    level.force -= pixel * tension;
    level.cohesive_area = pixel * static_cast<double>(cohesive);
    level.cohesive_resolution = resolution();
    energy = pixel * (0.5 * twice - attraction);
    if (accepted.separation < kInfinity)
        now.work += 0.5 * (accepted.force + level.force) * (accepted.separation - Z);
    else
        now.work = energy;
    now.force = level.force;
    now.least_force = std::min(now.least_force, level.force);
    level.least_force = now.least_force;
    level.energy_lost = now.lost = now.work - energy;
    if (converged) level.jumps = accepted.jumps + count_jumps();
    level.converged = converged;
    if (!converged) level.residual = 1;  // no state: Contact::finish() leaves no values
    return level;
}

// By point i between the accepted state and this one, per unit of area; see count_jumps().
double AdhesivePixels::dissipated(std::size_t i) const {
    const auto psi = [&](double w) { return -s0 * std::max(z0 - w, 0.0); };
    return -0.5 * (p_before[i] + pressure(i)) * (gap[i] - gap_before[i]) -
           (psi(gap[i]) - psi(gap_before[i]));
}

// Largest error of the trapezoidal work of the step: what points that changed their state seem to
// have dissipated, an artefact unless they jumped, or what the place of a jump within the step can
// change.
double AdhesivePixels::work_error() const {
    const double width = std::abs(accepted.separation - now.separation);
    if (!(width < kInfinity)) return 0;
    double sum = 0;
    for (const std::int32_t k : reach) sum += std::abs(dissipated(at(k)));
    return std::min(pixel * sum, 0.5 * width * std::abs(now.force - accepted.force));
}

// In as many steps as the work needs. The error of a step falls with the third power of its length,
// but in proportion to it if there is a jump.
Level AdhesivePixels::solve(double Z, bool trial) {
    std::optional<Level> done = std::exchange(tried, std::nullopt);
    const bool completes = !trial && done && done->separation == Z;
    Level level = completes ? std::move(*done) : step(Z);
    if (completes) level.iterations = 0, level.products = 0;
    if (trial) {
        tried = level;
        level.provisional = true;
        return level;
    }
    const double shortest = kShortest * std::abs(Z - accepted.separation);
    const auto pieces = [&] {
        const double most =
            kWorkShare * options.adhesion.work * pixel *
            static_cast<double>(std::max(now.attracting.size(), accepted.attracting.size()));
        const double error = !level.converged ? 0 : work_error();
        if (!(error > most) || !(std::abs(now.separation - accepted.separation) > shortest))
            return 1;
        return static_cast<int>(std::ceil(std::min(std::sqrt(error / most), kMostPieces)));
    };
    if (pieces() == 1) return level;
    const Past before = accepted;
    const std::vector<double> gaps = gap_before, pressures = p_before;
    std::vector<double> ends = {Z};  // of steps, the next one last
    std::int32_t iterations = level.iterations;
    std::int64_t products = level.products;
    const auto restore = [&] { accepted = before, gap_before = gaps, p_before = pressures; };
    try {
        while (true) {
            if (const int n = pieces(); n > 1) {
                const double end = ends.back(), way = accepted.separation - end;
                for (int k = 1; k < n; ++k) ends.push_back(end + way * k / n);
            } else {
                if (!level.converged) {  // in one step it converges
                    restore();
                    return step(Z);
                }
                ends.pop_back();
                if (ends.empty()) break;
                accepted = now, accepted.jumps = level.jumps;
                keep();
            }
            level = step(ends.back());
            iterations += level.iterations, products += level.products;
        }
    } catch (...) {
        restore();
        throw;
    }
    restore();
    level.iterations = iterations, level.products = products;
    return level;
}

// Number of connected sets of points that began or ceased to attract since the accepted level and
// dissipated energy by it. Between two states point k dissipates -(p + p')(w' - w)/2 - (psi' - psi)
// a unit area, where psi = -s0 (z0 - w) if it attracts and 0 otherwise: with trapezoidal work these
// add up exactly to energy_lost, because deflections are linear in the pressures. A point that
// crosses z0 smoothly dissipates at most half of s0 times the change of its gap, in the middle of a
// step nothing. Sets of fewer points, or of less dissipation per area than kJump w, are not
// counted: edges advance and recede from pixel to pixel in small jumps.
std::int32_t AdhesivePixels::count_jumps() const {
    if (!(accepted.separation < kInfinity)) return 0;
    std::vector<Pixel> where;
    std::vector<double> lost;
    for (const std::int32_t k : reach) {
        const std::size_t i = at(k);
        if ((p_before[i] != 0) == on[i]) continue;
        where.push_back(pixel_at(k));
        lost.push_back(dissipated(i));
    }
    std::vector<int> set;
    const int sets = connected_sets(where, set, flats ? heights.nx : 0, flats ? heights.ny : 0);
    std::vector<double> sum(at(sets)), points(at(sets));
    for (std::size_t c = 0; c < where.size(); ++c)
        sum[at(set[c])] += lost[c], points[at(set[c])] += 1;
    const double least = kJump * options.adhesion.work;
    std::int32_t jumps = 0;
    for (std::size_t c = 0; c < sum.size(); ++c)
        jumps += points[c] >= kFewest && sum[c] > least * points[c];
    return jumps;
}

// Stores gaps and pressures of the last level, the accepted one.
void AdhesivePixels::keep() {
    tried.reset();
    gap_before = gap;
    p_before.resize(gap.size());
    for (std::size_t i = 0; i < gap.size(); ++i) p_before[i] = pressure(i);
}

// Moves the tip on a straight line (the shortest one on a surface that repeats) at the accepted
// separation, in pieces that the state follows.
// If its path is lost, or after another exception, tip and accepted state are as before.
void AdhesivePixels::move(double x0, double y0) {
    const Indenter from = indenter;
    const Past before = accepted;
    const std::vector<double> gaps = gap_before, pressures = p_before;
    const Period& period = from.repeats.finite() ? from.repeats : from.period;
    const Vec2 way{period.nearest_x(x0 - from.x0), period.nearest_y(y0 - from.y0)};
    const double length = std::hypot(way.x, way.y);
    // If no point comes within reach of the attraction on the way, nothing is to be followed.
    const double nearest = accepted.separation - z0 - margin - bulged;
    const auto highest = [&] {
        double z = -kInfinity;
        for (int j = 0; j < heights.ny; ++j)
            z = std::max(z, *std::max_element(heights.row(j), heights.row(j) + heights.nx));
        return z;
    };
    const bool free =
        accepted.attracting.empty() &&
        (nearest == kInfinity ||
         top + indenter.shape->most_fallen(length, std::max(highest() - nearest, 0.0)) <= nearest);
    // Whole periods of the surface do not count.
    const auto inside = [](double x, double first, double over) {
        return std::isfinite(over) ? x - over * std::floor((x - first) / over) : x;
    };
    try {
        for (double done = 0; done < length;) {
            double steepest = 0;
            for (const std::int32_t k : accepted.attracting) {
                const Vec2 d = indenter.from_tip(heights.x0 + k % heights.nx * heights.dx,
                                                 heights.y0 + k / heights.nx * heights.dy);
                const Vec2 slope = indenter.shape->gradient(d.x, d.y);
                steepest = std::max(steepest, std::abs(slope.x * way.x + slope.y * way.y) / length);
            }
            const double piece = std::max(
                std::min(kPiece * z0 / steepest, kPieceSides * std::min(heights.dx, heights.dy)),
                1e-6 * length);
            done = free || !(done + piece < length) ? length : done + piece;
            const double x = done < length ? from.x0 + way.x * done / length : x0,
                         y = done < length ? from.y0 + way.y * done / length : y0;
            indenter.move(inside(x, heights.x0, from.repeats.x),
                          inside(y, heights.y0, from.repeats.y));
            follow();
        }
    } catch (...) {
        indenter = from, accepted = before, gap_before = gaps, p_before = pressures;
        set_clearances();
        if (before.separation < kInfinity) (void)solve(before.separation, false);
        throw;
    }
}

// The state follows the tip to its new position nearby. The work done on it is (p + p') (g' - g)/2
// a unit area, as by levels.
void AdhesivePixels::follow() {
    const std::vector<double> before = clearance;
    set_clearances();
    if (accepted.attracting.empty() && !(top > accepted.separation - z0 - margin - bulged)) {
        for (std::size_t i = 0; i < gap_before.size(); ++i)
            gap_before[i] = accepted.separation - clearance[i];
        return;
    }
    for (std::size_t i = 0; i < before.size(); ++i)
        if (std::isfinite(before[i]) != std::isfinite(clearance[i]) &&
            std::max(before[i], clearance[i]) > accepted.separation - z0 - margin - bulged)
            throw Error(Failure::bad_input,
                        "a body with an edge cannot be moved while points attract near its edge: "
                        "pull it off first");
    const Level level = solve(accepted.separation, false);
    if (!level.converged)
        throw Error(Failure::not_converged,
                    "the path of the attracting points to the new position of the tip is lost; the "
                    "tip stays where it was");
    double twice = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        if (const double p = p_before[i] + pressure(i); p != 0)
            twice += p * (clearance[i] - before[i]);
    now.work += 0.5 * pixel * twice;
    now.lost = now.work - energy;
    now.jumps = level.jumps;
    accepted = now;
    keep();
}

}  // namespace rsc
