#include "physics/adhesion/adhesive_pixels.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "elements/connected_pixels.hpp"
#include "elements/pixel_spots.hpp"
#include "physics/adhesion/adhesive_elements.hpp"
#include "physics/adhesion/sticking.hpp"

namespace rsc {
namespace {

// Smallest ratio of the cohesive length to the side of a pixel, and that of accurate forces.
constexpr double kCoarsest = 0.5, kFine = 4;
// Without a range: largest side of a pixel over the thickness of a layer.
constexpr double kOfLayer = 0.5;
// Without a range: shortest part of the way to a level, relative to it, and the error of the work
// of a part.
constexpr double kShortestOfEdges = 1.0 / 16, kWorkError = 0.01;
// By how much the force may fall below the smallest one of the states that are computed, relative
// to it, before a jump or where its course is smooth. Parts of the way are not made shorter than
// kShortest for that.
constexpr double kLeastForceError = 0.01, kShortest = 1.0 / 1024;
// Errors of the residual of a stiffness: of that which is returned, and for this fall of the force.
constexpr double kStiffnessError = 1e-9, kFallError = 1e-3;
// With a range: parts into which the way is divided at most, to see what it loses.
constexpr int kMostParts = 10;
constexpr double kOfJump = 0.1;  // of w times the area that changes, is lost in a jump
// Tolerance of pressures at the ends of these parts: with 1e-3, losses are wrong by 5 %.
constexpr double kOnTheWay = 1e-4;
constexpr std::size_t kFewest = 8;    // least number of points of a jump, if there are several
constexpr double kInnerError = 1e-3;  // error of products in iterations
constexpr double kEarly = 0.1;        // error of pressures relative to the change of the attraction
constexpr double kFar = 1e6;          // largest gap relative to the range
constexpr double kFinest = 1e-9;      // smallest tolerance
constexpr double kSettled = 0.3;      // last change of the attraction relative to the tolerance
constexpr double kProductError = 0.3;  // error of products relative to that of pressures
constexpr int kMost = 2000;            // renewals of the attraction
// Change of shares at edges relative to the tolerance of forces. With 1, a force differs by more
// than its tolerance when a level is repeated in 1 of 400 levels, so that no state has a given one.
constexpr double kEdgeTolerance = 0.3;
constexpr double kPenetration = 1e-3;  // relative to z0: of points apart from contacts
// Longest piece of a way of the tip: change of the clearances of attracting points relative to z0,
// and number of pixel sides.
constexpr double kPiece = 0.25, kPieceSides = 0.25;

double below(double least_force) { return least_force - kLeastForceError * std::abs(least_force); }

// Smallest value between the outer ones of three at equal distances.
double least_of_parabola(double first, double middle, double last) {
    const double bend = first - 2 * middle + last, slope = 0.5 * (last - first);
    const bool inside = std::abs(slope) < bend;
    return inside ? middle - 0.5 * slope * slope / bend : std::min({first, middle, last});
}

// Integral of the positive part of a linear function over a triangle of unit area, from its values
// at the corners, and the derivatives with respect to these.
struct Linear {
    double integral = 0;
    std::array<double, 3> share{};
};
Linear positive_part(const std::array<double, 3>& d) {
    const auto positive = std::ranges::count_if(d, [](double value) { return value > 0; });
    Linear whole{(d[0] + d[1] + d[2]) / 3, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    if (positive == 0) return {};
    if (positive == 3) return whole;
    // The part of one corner, which has another sign than the others.
    std::size_t alone = 0;
    while ((d[alone] > 0) != (positive == 1)) ++alone;
    const std::size_t next = (alone + 1) % 3, last = (alone + 2) % 3;
    const double a = d[alone] / (d[alone] - d[next]), b = d[alone] / (d[alone] - d[last]);
    Linear part{a * b * d[alone] / 3, {}};
    part.share[alone] = a * b * (3 - a - b) / 3;
    part.share[next] = a * b * a / 3;
    part.share[last] = a * b * b / 3;
    if (positive == 1) return part;
    for (const auto k : indices(3)) whole.share[k] -= part.share[k];
    whole.integral -= part.integral;
    return whole;
}

// Iterates of a map x -> f(x), accelerated by combining the last ones so that f(x) - x is smallest
// (Anderson, J. ACM 12, 1965). Where this grows nevertheless, the combination begins anew. Where it
// stays above its smallest value, there is no fixed point nearby, and the iterates are f(x) until
// it has become smaller.
class Iterates {
public:
    // Sets x to the next iterate.
    void advance(const std::vector<double>& fx, std::vector<double>& x) {
        constexpr std::size_t most = 5;
        constexpr int patience = 6;
        constexpr double growth = 1.5, fresh = 1e-8, calmer = 0.1;
        std::vector<double> r(x.size());
        double size = 0;
        for (const auto i : indices(x)) {
            r[i] = fx[i] - x[i];
            size += r[i] * r[i];
        }
        since_best_ = size < best_ ? 0 : since_best_ + 1;
        if (size < (alone_ ? calmer : 1.0) * best_) {
            best_ = size;
            alone_ = false;
        }
        alone_ = alone_ || since_best_ == patience;
        if (alone_ || size > growth * size_) {
            dr_.clear();
            dfx_.clear();
        } else if (!r_.empty()) {
            for (const auto i : indices(x)) {
                r_[i] = r[i] - r_[i];
                fx_[i] = fx[i] - fx_[i];
            }
            dr_.push_back(std::move(r_));
            dfx_.push_back(std::move(fx_));
        }
        if (dr_.size() > most) {
            dr_.erase(dr_.begin());
            dfx_.erase(dfx_.begin());
        }
        x = fx;
        // Gram and Schmidt, from the latest difference on.
        std::vector<std::vector<double>> q, p;
        std::vector<double> rest = r;
        for (std::size_t j = dr_.size(); j-- > 0;) {
            std::vector<double> v = dr_[j], w = dfx_[j];
            const double whole = product(v, v);
            for (const auto k : indices(q)) {
                const double along = product(v, q[k]);
                add(v, -along, q[k]);
                add(w, -along, p[k]);
            }
            const double norm2 = product(v, v);
            if (!(norm2 > fresh * whole)) continue;
            const double per = 1 / std::sqrt(norm2);
            for (double& value : v) value *= per;
            for (double& value : w) value *= per;
            const double share = product(rest, v);
            add(rest, -share, v);
            add(x, -share, w);
            q.push_back(std::move(v));
            p.push_back(std::move(w));
        }
        for (double& value : x) value = std::clamp(value, 0.0, 1.0);
        r_ = std::move(r);
        fx_ = fx;
        size_ = size;
    }

private:
    static double product(const std::vector<double>& a, const std::vector<double>& b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    }
    static void add(std::vector<double>& to, double factor, const std::vector<double>& of) {
        for (const auto i : indices(to)) to[i] += factor * of[i];
    }
    double size_ = kInfinity, best_ = kInfinity;
    int since_best_ = 0;
    bool alone_ = false;
    std::vector<double> r_, fx_;
    std::vector<std::vector<double>> dr_, dfx_;
};

}  // namespace

void require_resolved(double E_star, const Adhesion& adhesion, double step) {
    const double resolution = cohesive_length(E_star, adhesion) / step;
    if (!(resolution < kCoarsest)) return;
    const double wanted = std::sqrt(kFine / resolution);
    bad_input(
        format("solids%%adhesion_range = %.6g: the attraction at the edge of a contact acts "
               "across %.2g of a pixel's side, (pi/4) E* adhesion_range^2/adhesion; "
               "elements need 0.5 at least, and 4 for accurate forces: %.2g times as many "
               "points a side, or adhesion_range = %.2g",
               adhesion.range, resolution, kFine / resolution, wanted * adhesion.range));
}

namespace {

// The edge of a contact releases the energy of the top layer only between pixels that are small
// beside the layers.
void require_resolved_layers(const LayeredBody& body, double step) {
    for (std::int64_t k = 0; k < body.count; ++k)
        if (const double thickness = body.layer[at(k)].thickness; !(step <= kOfLayer * thickness))
            bad_input(
                format("solids%%adhesion_range = 0: elements of side %.3g need layers that are at "
                       "least twice as thick, not solids%%layer_thickness = %.3g: give more points "
                       "a side, or a range",
                       step, thickness));
}

}  // namespace

AdhesivePixels::AdhesivePixels(const HeightMap& heights_, const Indenter& indenter_,
                               const SolverOptions& options_)
    : CutMap(heights_),
      heights(heights_),
      indenter(indenter_),
      options(options_),
      pixel(heights.dx * heights.dy) {
    const auto& [work, range] = options.physics.of<Adhesion>();
    const Substrate body = substrate_of(indenter);
    if (range > 0) {
        require_resolved(indenter.E_star, {work, range}, heights.step());
        z0 = range;
        s0 = work / range;
    } else {
        require_resolved_layers(indenter.layers, heights.step());
        const double row = AdhesiveEdges::kRow * std::sqrt(pixel) / body.modulus();
        s0 = std::sqrt(2 * work / row);
        z0 = 2 * work / s0;
    }
    if (indenter.period.finite()) {
        raised = heights.copy();
        set_clearances();
        flats = std::make_unique<PeriodicElements>(
            PeriodicHeights{raised.nx, raised.ny, raised.dx, raised.dy, raised.data.get(),
                            raised.stride},
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
    if (!(range > 0)) {
        edge_products = flats ? make_periodic_products(body, heights)
                              : make_tree_products(body, heights.dx, heights.dy, kInnerError,
                                                   0.1 * options.tolerance, false);
        edges.emplace(*edge_products, *this, bool(flats), s0, z0);
    }
    forget();
}

// Of the present position of the tip.
void AdhesivePixels::set_clearances() {
    cut_open(indenter, 1);
    clearance.resize(at(heights.nx) * at(heights.ny));
    for (const int j : indices(heights.ny))
        for (const int i : indices(heights.nx)) {
            const double z = indenter.clearance(heights.x0 + i * heights.dx,
                                                heights.y0 + j * heights.dy, heights(i, j));
            clearance[at(j) * at(heights.nx) + at(i)] = z;
            if (raised.data) raised.row(j)[i] = z;
        }
    top = std::ranges::max(clearance);
}

// No level, and no point attracts.
void AdhesivePixels::forget() {
    accepted = now = {};
    tried.reset();
    tracked.clear();
    margin = bulged = 0;
    for (std::vector<double>* values : {&q, &share, &p_before})
        values->assign(clearance.size(), 0.0);
}

// Selects the points whose gap can be below z0 if points are raised by at most the margin and
// `bulged`, and their neighbours, between which the gap is interpolated; for periodic flats all
// points.
void AdhesivePixels::gather(double Z) {
    reach.clear();
    std::vector<char> wanted(clearance.size(), flats ? 1 : 0);
    const auto include = [&](int i, int j) {
        for (int y = std::max(j - 1, 0); y <= std::min(j + 1, heights.ny - 1); ++y)
            for (int x = std::max(i - 1, 0); x <= std::min(i + 1, heights.nx - 1); ++x)
                wanted[at(place({x, y}))] = 1;
    };
    for (int j = 0; j < heights.ny && !flats; ++j)
        for (const int i : indices(heights.nx)) {
            const std::size_t k = at(place({i, j}));
            if (share[k] > 0 || clearance[k] > Z - z0 - margin - bulged) include(i, j);
        }
    for (const std::int32_t k : tracked) wanted[at(k)] = 1;
    std::vector<Pixel> pixels;
    for (const int j : indices(heights.ny))
        for (const int i : indices(heights.nx)) {
            const std::int32_t k = place({i, j});
            q[at(k)] = wanted[at(k)] ? q[at(k)] : 0.0;
            if (!wanted[at(k)]) continue;
            reach.push_back(k);
            pixels.push_back({i, j});
        }
    if (field && !pixels.empty()) field->set_pixels(pixels);
}

// K p at the points within reach, for pressures of this tolerance.
std::vector<double> AdhesivePixels::deflections(const std::vector<double>& p, double tolerance) {
    std::vector<double> u(p.size());
    if (p.empty()) return u;
    if (!flats) {
        using enum PixelProducts::Accuracy;
        const double most = kProductError * tolerance;
        field->apply(p.data(), u.data(),
                     field->error(inner) <= most     ? inner
                     : field->error(between) <= most ? between
                                                     : full);
        return u;
    }
    std::vector<Pixel> where;
    std::vector<double> some;
    for (const auto k : indices(p))
        if (p[k] != 0) {
            where.push_back(pixel_at(reach[k]));
            some.push_back(p[k]);
        }
    return flats->deflections(where, some);
}

// The traction s0 acts where the gap, linear between the points, is below z0. Returns s0^-1 times
// the integral of the attraction over the area, in pixels: of the positive part of z0 - gap; and
// the shares of the points, its derivatives with respect to z0 - gap there. Of the two ways in
// which four points make two triangles the mean is taken, so that mirrored maps have mirrored
// results.
double AdhesivePixels::attraction(std::vector<double>& shares) const {
    shares.assign(gap.size(), 0.0);
    double sum = 0;
    const auto index = [&](int i, int j) {
        const auto inside = [&](int k, int n) {
            if (flats) return k < 0 ? k + n : k >= n ? k - n : k;
            return std::clamp(k, 0, n - 1);
        };
        return at(place({inside(i, heights.nx), inside(j, heights.ny)}));
    };
    const int first = flats ? 0 : -1;
    const auto beyond = [&](int k, int n) { return !flats && (k < 0 || k == n - 1); };
    for (int j = first; j < heights.ny; ++j)
        for (int i = first; i < heights.nx; ++i) {
            const std::array corner = {index(i, j), index(i + 1, j), index(i, j + 1),
                                       index(i + 1, j + 1)};
            std::array<double, 4> d;
            for (const auto c : indices(4))
                d[c] = std::max(z0 - gap[corner[c]], -kFar * z0);  // beyond the edge of a body
            const auto [least, most] = std::ranges::minmax_element(d);
            if (!(*most > 0)) continue;
            // Half of a pixel at the border lies beyond the last points.
            const double part_of_cell =
                0.25 * (beyond(i, heights.nx) ? 0.5 : 1.0) * (beyond(j, heights.ny) ? 0.5 : 1.0);
            if (*least >= 0) {
                for (const auto c : indices(4)) {
                    shares[corner[c]] += part_of_cell;
                    sum += part_of_cell * d[c];
                }
                continue;
            }
            for (const auto& [a, b, c] : {std::array{0, 1, 2}, {1, 3, 2}, {0, 1, 3}, {0, 3, 2}}) {
                const std::array where = {corner[at(a)], corner[at(b)], corner[at(c)]};
                const Linear part = positive_part({d[at(a)], d[at(b)], d[at(c)]});
                sum += part_of_cell * part.integral;
                for (const auto k : indices(3)) shares[where[k]] += part_of_cell * part.share[k];
            }
        }
    return sum;
}

// Solves for q under a fixed attraction. Returns false if it does not converge.
bool AdhesivePixels::press(double Z, double tolerance, Level& level) {
    ElementsOutcome outcome;
    if (flats) {
        for (const auto k : indices(reach))
            raised.row(reach[k] / heights.nx)[reach[k] % heights.nx] = clearance[k] + lift[k];
        flats->heights_changed();
        outcome = flats->approach(Z, tolerance, options.max_iterations);
        std::ranges::fill(q, 0.0);
        for (const auto k : indices(flats->pixels()))
            q[at(flats->pixels()[k].y) * at(heights.nx) + at(flats->pixels()[k].x)] =
                flats->pressures()[k];
    } else {
        std::vector<Pixel> pixels;
        std::vector<double> g0, p;
        for (const auto k : indices(reach)) {
            double& here = q[at(reach[k])];
            const double g = clearance[at(reach[k])] - Z + lift[k];
            if (g > -bulged) {
                pixels.push_back(pixel_at(reach[k]));
                g0.push_back(g);
                p.push_back(here);
            }
            here = 0;
        }
        outcome = spots->solve(pixels, g0, tolerance, options.max_iterations, p);
        for (const auto k : indices(p)) q[at(place(pixels[k]))] = p[k];
    }
    level.iterations += outcome.iterations;
    level.products += outcome.products + 2;
    level.residual = outcome.residual;
    return outcome.converged;
}

// Pressures and gaps at Z under the present attraction. Returns false if this does not converge.
bool AdhesivePixels::load(double Z, double tolerance, Level& level) {
    for (int round = 0; round < kMost; ++round) {
        std::vector<double> p(reach.size());
        for (const auto k : indices(reach)) p[k] = s0 * share[at(reach[k])];
        lift = deflections(p, tolerance);
        const double most = lift.empty() ? 0.0 : std::ranges::max(lift);
        if (!flats && most > margin) {
            margin = 1.5 * most;
            gather(Z);
            continue;
        }
        if (!press(Z, tolerance, level)) return false;
        if (const double most_bulged = bulge * pixel * sum_of(q); most_bulged > bulged) {
            bulged = 1.5 * most_bulged;
            gather(Z);
            continue;
        }
        for (const auto k : indices(reach)) p[k] = q[at(reach[k])];
        p = deflections(p, tolerance);
        for (const auto k : indices(reach))
            gap[at(reach[k])] = p[k] - (lift[k] + clearance[at(reach[k])] - Z);
        return true;
    }
    return false;
}

// The energy of a state that has just been found, and its gaps at the tracked points, by products
// in full accuracy.
void AdhesivePixels::open(Past& state) {
    gather(state.separation);
    std::vector<double> p(reach.size());
    for (const auto k : indices(reach)) p[k] = pressure(at(reach[k]));
    const std::vector<double> u = deflections(p, 0);
    double twice = 0, pulled = -state.conjugate;
    for (const auto k : indices(reach)) {
        const std::size_t i = at(reach[k]);
        gap[i] = u[k] - (clearance[i] - state.separation);
        twice += p[k] * u[k];
        pulled += share[i] * (z0 - gap[i]);
    }
    state.energy = pixel * (0.5 * twice - s0 * pulled);
    state.gap.clear();
    for (const std::int32_t k : tracked) state.gap.push_back(gap[at(k)]);
}

// Finds the state at Z by renewing the attraction from the present one. As a stronger attraction
// only closes gaps and so becomes stronger still, the states on the way are all on one side of the
// nearest equilibrium if the separation has changed, and do not pass it. Returns false if it does
// not converge.
bool AdhesivePixels::renew(double Z, double aim, Level& level) {
    if (edges) return balance_edges(Z, aim, level);
    gather(Z);
    std::vector<double> next;
    Iterates iterates;
    double tolerance = std::max(aim, kEarly * kEarly);
    for (int round = 0; round < kMost; ++round) {
        stopping_point();
        if (!load(Z, tolerance, level)) return false;
        attracted = attraction(next);
        double change = 0, sum = 0;
        for (const std::int32_t i : reach) {
            change += std::abs(next[at(i)] - share[at(i)]);
            sum += next[at(i)];
        }
        if (change <= kSettled * aim * sum && tolerance <= aim) return true;
        tolerance = sum > 0 ? std::clamp(kEarly * change / sum, aim, tolerance) : aim;
        iterates.advance(next, share);
    }
    return false;
}

// Without a range, bodies that are apart touch where they would without adhesion. Returns false if
// this does not converge.
bool AdhesivePixels::touch(double Z, Level& level) {
    std::ranges::fill(q, 0.0);
    if (!(top > Z)) return true;
    gather(Z);
    lift.assign(reach.size(), 0.0);
    if (!press(Z, kInnerError, level)) return false;
    for (const std::int32_t k : reach)
        if (double& here = q[at(k)]; here > 0) {
            here += s0;
            share[at(k)] = 1;
        }
    return true;
}

// Selects the points at which the edges may run.
void AdhesivePixels::select_edges(bool more) {
    std::vector<double> p(q.size());
    for (const auto i : indices(p)) p[i] = pressure(i);
    edges->select(p, share, more);
    reach.clear();
    for (const Pixel& here : edges->pixels()) reach.push_back(place(here));
}

// Points apart from the contacts that the attraction raises so far that they touch. Returns whether
// there are any.
bool AdhesivePixels::join(double Z) {
    const std::vector<double>& p = edges->pressure();
    std::vector<double> pull(p.size()), w(p.size());
    for (const auto k : indices(p)) pull[k] = std::min(p[k], 0.0);
    edge_products->apply(pull.data(), w.data(), PixelProducts::Accuracy::inner);
    double most = bulge * pixel * sum_of(q);
    for (const double u : w) most = std::max(most, -u);
    std::vector<char> outside(share.size(), 0);
    for (const auto i : indices(outside)) outside[i] = flats || clearance[i] > Z - most;
    for (const std::int32_t k : reach) outside[at(k)] = 0;
    if (std::ranges::count(outside, 1) == 0) return false;
    // Row by row, with those of the edges among them.
    std::vector<double> all(share.size(), 0.0), pressures;
    for (const auto k : indices(reach)) all[at(reach[k])] = p[k];
    std::vector<char> requested;
    std::vector<Pixel> pixels;
    for (const int j : indices(heights.ny))
        for (const int i : indices(heights.nx))
            if (const std::size_t k = at(place({i, j})); outside[k] || all[k] != 0) {
                pixels.push_back({i, j});
                pressures.push_back(all[k]);
                requested.push_back(outside[k]);
            }
    w.resize(pixels.size());
    edge_products->elsewhere(pressures.data(), pixels, w.data(), requested.data());
    bool any = false;
    for (const auto k : indices(pixels)) {
        const std::size_t i = at(place(pixels[k]));
        if (!outside[i] || !(w[k] - (clearance[i] - Z) < -kPenetration * z0)) continue;
        share[i] = 1;
        q[i] = s0;
        any = true;
    }
    return any;
}

// The state at Z next to the present one, without a range.
bool AdhesivePixels::balance_edges(double Z, double tolerance, Level& level) {
    const double aim = std::max(kEdgeTolerance * tolerance, kFinest);
    if (sum_of(share) == 0 && !touch(Z, level)) return false;
    for (bool more = false;; more = true) {
        const long before = edge_products->count();
        select_edges(more);
        const AdhesiveEdges::Outcome outcome = edges->balance(clearance, Z, aim);
        std::ranges::fill(q, 0.0);
        for (const auto k : indices(reach)) {
            const std::size_t i = at(reach[k]);
            share[i] = edges->share()[k];
            gap[i] = edges->gap()[k];
            if (share[i] == 1) q[i] = edges->pressure()[k] + s0;
        }
        const bool sound = outcome.converged || outcome.wider,
                   again = outcome.wider || (sound && !reach.empty() && join(Z));
        level.iterations += outcome.rounds;
        level.products += edge_products->count() - before;
        level.residual = outcome.residual;
        if (!sound || level.iterations > kMost) return false;
        if (!again) break;
    }
    attracted = 0;
    for (const std::int32_t k : reach) attracted += 0.5 * z0 * share[at(k)] * share[at(k)];
    return true;
}

// dN/dZ0 for the present attraction.
double AdhesivePixels::stiffness() {
    if (edges) {
        if (sum_of(share) == 0) return 0;
        select_edges(false);
        return -pixel * edges->stiffness(kStiffnessError);
    }
    if (std::ranges::none_of(q, [](double value) { return value > 0; })) return 0;
    return flats ? -heights.Lx() * heights.Ly() * flats->stiffness(false)
                 : -pixel * spots->stiffness(1e-9, false);
}

// The level at Z next to the accepted state, or next to the attraction of another one.
Level AdhesivePixels::step(double Z, const Past* start, double tolerance) {
    now = accepted;
    restore(start ? *start : accepted);
    Level level;
    level.separation = Z;
    level.method = Method::automatic;
    gap.resize(clearance.size());
    for (const auto i : indices(gap)) gap[i] = Z - clearance[i];
    const bool converged = renew(Z, std::max({options.tolerance, tolerance, kFinest}), level);
    level.candidates = std::int32_t(reach.size());
    now.separation = Z;
    now.attracting.clear();
    now.share.clear();
    std::vector<Pixel> touching;
    std::vector<double> pressures;
    double twice = 0, cohesive = 0;
    std::vector<std::int32_t> sorted = reach;
    std::ranges::sort(sorted);
    for (std::size_t k = 0; k < sorted.size() && converged; ++k)
        if (const std::size_t i = at(sorted[k]); share[i] > 0) {
            now.attracting.push_back(sorted[k]);
            now.share.push_back(share[i]);
        }
    for (std::size_t k = 0; k < reach.size() && converged; ++k) {
        const std::size_t i = at(reach[k]);
        const Pixel here = pixel_at(reach[k]);
        twice += pressure(i) * (gap[i] + clearance[i] - Z);
        if (touches(i)) {
            touching.push_back(here);
            pressures.push_back(pressure(i));
        } else if (share[i] > 0) {
            cohesive += share[i];
            level.pixels.cohesive.push_back(here.y * heights.nx + here.x);
            level.pixels.attraction.push_back(-s0 * share[i]);
        }
    }
    add_pixels(level, frame, indenter, kInfinity, touching, std::move(pressures), s0);
    number_by_map(level);
    level.force -= pixel * s0 * cohesive;
    level.cohesive_area = edges ? 0.0 : pixel * cohesive;
    level.cohesive_resolution = resolution();
    now.energy = pixel * (0.5 * twice - s0 * attracted);
    now.conjugate = -attracted;
    for (const std::int32_t k : reach) now.conjugate += share[at(k)] * (z0 - gap[at(k)]);
    now.force = level.force;
    now.least_force = std::min(now.least_force, level.force);
    level.least_force = now.least_force;
    level.jumps = accepted.jumps;
    level.energy_lost = accepted.lost;
    level.converged = converged;
    if (!converged) level.residual = 1;  // no state: Path::finish() leaves no values
    return level;
}

// Energy below which a step counts as reversible.
double AdhesivePixels::negligible(const Past& from, const Past& to) const {
    const auto shares = [](const Past& past) { return sum_of(past.share); };
    const Adhesion& adhesion = options.physics.of<Adhesion>();
    return loss_share(adhesion.range) * adhesion.work * pixel * std::max(shares(from), shares(to));
}

// By how much the change of the attraction from that of a state to that of another one at the same
// separation lowers the energy. It is concave in the attraction: its slopes, the gaps, bound the
// change where it is small beside the errors of the energies.
double AdhesivePixels::released(const Past& one, const Past& other) {
    restore(one);
    std::array<double, 2> bound{};
    bound.fill(one.conjugate - other.conjugate);
    for (const auto k : indices(tracked)) bound[0] -= share[at(tracked[k])] * (z0 - one.gap[k]);
    for (const auto k : indices(tracked)) bound[1] -= share[at(tracked[k])] * (z0 - other.gap[k]);
    restore(other);
    for (const auto k : indices(tracked)) bound[0] += share[at(tracked[k])] * (z0 - one.gap[k]);
    for (const auto k : indices(tracked)) bound[1] += share[at(tracked[k])] * (z0 - other.gap[k]);
    const auto [low, high] = std::minmax(bound[0], bound[1]);
    return std::clamp(one.energy - other.energy, pixel * s0 * low, pixel * s0 * high);
}

// The work between two separations under an attraction that stays as it is, is the change of the
// energy under it, which needs no way. On the way the attraction changes in one direction, and the
// stronger it is, the smaller is the force: the loss is between what the change of the attraction
// releases at one end and at the other.
AdhesivePixels::Part AdhesivePixels::between(const Past& from, const Past& to, Level& effort) {
    const auto under = [&](const Past& attraction, double Z) {
        Past state = attraction;
        state.separation = Z;
        restore(state);
        for (const auto i : indices(gap)) gap[i] = Z - clearance[i];
        gather(Z);
        if (load(Z, kOnTheWay, effort))
            open(state);
        else
            state.energy = kNotComputed;
        return state;
    };
    const double at_from = released(from, under(to, from.separation)),
                 at_to = released(under(from, to.separation), to);
    double changed = 0;
    restore(from);
    for (const std::int32_t k : tracked) changed += share[at(k)];
    restore(to);
    for (const std::int32_t k : tracked) changed -= share[at(k)];
    const double most = pixel * s0 * z0 * std::abs(changed), apart = std::abs(at_from - at_to);
    Part part{from, to, 0.5 * (at_from + at_to)};
    part.doubt = std::min(std::abs(part.lost), 0.5 * apart);
    part.proved = part.lost > 0.5 * apart + kOnTheWay * most;
    if (part.lost > kOfJump * most) part.jumps = count_jumps(from, to);
    return part;
}

// The way from the accepted state to `now`: its parts, divided where their loss is least known. A
// loss that both halves do not have together is one of the mean in between().
std::vector<AdhesivePixels::Part> AdhesivePixels::divide(Level& effort) {
    const double most = negligible(accepted, now);
    Past begin = accepted, end = now;
    tracked.clear();
    std::ranges::set_union(begin.attracting, end.attracting, std::back_inserter(tracked));
    open(end);
    restore(begin);
    for (const auto i : indices(q)) q[i] = p_before[i] + s0 * share[i];
    for (const auto i : indices(gap)) gap[i] = begin.separation - clearance[i];
    open(begin);
    std::vector<Part> parts = {between(begin, end, effort)};
    const auto attracts = [](const Part& part) {
        return !part.from.attracting.empty() || !part.to.attracting.empty();
    };
    while (std::ranges::count_if(parts, attracts) < kMostParts) {
        const auto worst = std::ranges::max_element(parts, {}, &Part::doubt);
        const Part whole = *worst;
        if (!(whole.doubt > most)) break;
        const Level middle =
            step(0.5 * (whole.from.separation + whole.to.separation), &whole.from, kOnTheWay);
        effort.iterations += middle.iterations;
        effort.products += middle.products;
        if (!middle.converged) break;
        Past half = now;
        open(half);
        Part first = between(whole.from, half, effort), second = between(half, whole.to, effort);
        for (Part* part : {&first, &second})
            part->doubt = std::min(part->doubt, std::abs(whole.lost - first.lost - second.lost));
        *worst = std::move(first);
        parts.push_back(std::move(second));
    }
    tracked.clear();
    return parts;
}

// The level at Z after the way to it, whose losses are those of its parts.
Level AdhesivePixels::follow_range(double Z) {
    Level way = step(Z);
    if (!way.converged) return way;
    const Past end = now;
    const std::vector<Part> parts = divide(way);
    Level level = step(Z, &end);
    level.iterations += way.iterations;
    level.products += way.products;
    if (!level.converged) return level;
    for (const Part& part : parts) {
        now.least_force = std::min(now.least_force, part.to.force);
        const bool confirmed = part.lost > std::max(part.doubt, negligible(part.from, part.to));
        if (!part.proved && !confirmed) continue;
        now.lost += part.lost;
        level.jumps += part.jumps;
    }
    level.energy_lost = now.lost;
    level.least_force = now.least_force;
    return level;
}

// Whether the force may have been smaller on the way from the accepted state to this one. Bodies
// that separate let go of points, which raises the force: it is not below that of the accepted
// state if all points are held.
bool AdhesivePixels::may_pull_harder() {
    const double apart = now.separation - accepted.separation;
    if (!(apart > 0)) return false;
    const std::vector<std::int32_t> within = reach;
    restore(accepted);
    select_edges(false);
    const double fall = pixel * edges->stiffness(kFallError) * apart;
    restore(now);
    reach = within;
    return accepted.force - fall < below(now.least_force);
}

// Without a range: divides the step from the accepted state to this level, if its work by the
// trapezoidal rule is more than the change of the energy, until it is not, or is so short that it
// is a jump, before which no smaller force is possible. Where Simpson's rule shows that it loses
// none, the state at its end is the right one, unless the forces have a minimum in it that is not
// known yet. If a part does not converge, `level` is that of the part.
void AdhesivePixels::divide_edges(Level& level, double way) {
    const auto parts = [&](auto&& add) {
        const std::int32_t iterations = level.iterations;
        const std::int64_t products = level.products;
        add();
        level.iterations += iterations;
        level.products += products;
    };
    const double Z = now.separation, down = accepted.separation - Z,
                 gained = now.energy - accepted.energy,
                 work = 0.5 * (accepted.force + now.force) * down,
                 most = negligible(accepted, now) + kWorkError * std::abs(work);
    // The energy tells the mean force, and so the force in the middle.
    const double middle = 1.5 * gained / down - 0.25 * (accepted.force + now.force),
                 unknown = 0.5 * std::abs(down * (now.force - accepted.force));
    const bool whole = std::abs(down) > 0.75 * way, shortest = std::abs(down) <= kShortest * way,
               loses = std::abs(work - gained) > most,
               dips = down < 0 &&
                      least_of_parabola(accepted.force, middle, now.force) < below(now.least_force);
    // On the whole way a loss may be as large as the error of the rule by chance.
    const bool smooth = !loses && (!whole || unknown <= most) && (!dips || shortest);
    if (!level.converged) return;
    if (smooth) {
        now.lost += work - gained;
        level.energy_lost = now.lost;
        return;
    }
    const bool jump = loses && (std::abs(down) <= kShortestOfEdges * way || unknown <= most);
    if (jump && (shortest || !may_pull_harder())) {
        now.lost += std::max(work - gained, 0.0);
        level.energy_lost = now.lost;
        level.jumps += count_jumps(accepted, now);
        return;
    }
    const Past end = now;
    parts([&] { level = step(0.5 * (accepted.separation + Z)); });
    if (!level.converged) return;
    const double better = (accepted.force + 4 * now.force + end.force) * down / 6,
                 least = std::min(now.least_force, end.force);
    if (std::abs(better - gained) <= most &&
        !(least_of_parabola(accepted.force, now.force, end.force) < below(least))) {
        parts([&] { level = step(Z, &end); });
        now.least_force = level.least_force = least;
        now.lost += better - gained;
        level.energy_lost = now.lost;
        return;
    }
    divide_edges(level, way);
    if (!level.converged) return;
    accepted = now;
    accepted.jumps = level.jumps;
    parts([&] { level = step(Z); });
    divide_edges(level, way);
}

Level AdhesivePixels::follow_edges(double Z) {
    Level level = step(Z);
    const Past before = accepted;
    try {
        divide_edges(level, std::abs(Z - accepted.separation));
    } catch (...) {
        accepted = before;
        throw;
    }
    accepted = before;
    return level.converged ? level : step(Z);  // in one step it converges
}

// A trial starts from the last trial, so that it may find another equilibrium than the one which
// the path of the bodies reaches.
Level AdhesivePixels::solve(double Z, bool trial) {
    const std::optional<Past> last = std::exchange(tried, std::nullopt);
    tracked.clear();
    if (!trial && accepted.separation < kInfinity && Z != accepted.separation)
        return edges ? follow_edges(Z) : follow_range(Z);
    Level level = step(Z, trial && last ? &*last : nullptr);
    level.provisional = trial;
    if (trial && level.converged) tried = now;
    return level;
}

// Number of connected sets of points that began or ceased to attract between two states: 1, or that
// of the sets of at least kFewest points if this is larger.
std::int32_t AdhesivePixels::count_jumps(const Past& from, const Past& to) const {
    std::vector<std::int32_t> changed;
    std::ranges::set_symmetric_difference(from.attracting, to.attracting,
                                          std::back_inserter(changed));
    std::vector<Pixel> where;
    for (const std::int32_t k : changed) where.push_back(pixel_at(k));
    std::vector<int> set;
    const int sets = connected_sets(where, set, flats ? heights.nx : 0, flats ? heights.ny : 0);
    std::vector<std::size_t> points(at(sets));
    for (const int of : set) ++points[at(of)];
    const auto large = std::ranges::count_if(points, [](std::size_t n) { return n >= kFewest; });
    return std::max(1, std::int32_t(large));
}

void AdhesivePixels::restore(const Past& past) {
    std::ranges::fill(share, 0.0);
    for (const auto k : indices(past.attracting)) share[at(past.attracting[k])] = past.share[k];
}

// Stores the pressures of the last level, the accepted one.
void AdhesivePixels::keep() {
    tried.reset();
    p_before.resize(gap.size());
    for (const auto i : indices(gap)) p_before[i] = pressure(i);
}

// Moves the tip on a straight line (the shortest one on a surface that repeats) at the accepted
// separation, in pieces that the state follows.
// If its path is lost, or after another exception, tip and accepted state are as before.
void AdhesivePixels::move(double x0, double y0) {
    const Indenter from = indenter;
    const Past before = accepted;
    const std::vector<double> pressures = p_before;
    const Period& period = from.repeats.finite() ? from.repeats : from.period;
    const Vec2 way{period.nearest_x(x0 - from.x0), period.nearest_y(y0 - from.y0)};
    const double length = std::hypot(way.x, way.y);
    // If no point comes within reach of the attraction on the way, nothing is to be followed.
    const double nearest = accepted.separation - z0 - margin - bulged;
    const auto highest = [&] {
        double z = -kInfinity;
        for (const int j : indices(heights.ny))
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
        indenter = from;
        accepted = before;
        p_before = pressures;
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
    if (accepted.attracting.empty() && !(top > accepted.separation - z0 - margin - bulged)) return;
    for (const auto i : indices(before))
        if (std::isfinite(before[i]) != std::isfinite(clearance[i]) &&
            std::max(before[i], clearance[i]) > accepted.separation - z0 - margin - bulged)
            bad_input(
                "a body with an edge cannot be moved while points attract near its edge: "
                "pull it off first");
    Level level = step(accepted.separation);
    if (!level.converged)
        throw Error(Failure::not_converged,
                    "the path of the attracting points to the new position of the tip is lost; the "
                    "tip stays where it was");
    double twice = 0;
    for (const auto i : indices(before))
        if (const double p = p_before[i] + pressure(i); p != 0)
            twice += p * (clearance[i] - before[i]);
    if (const double lost = 0.5 * pixel * twice - (now.energy - accepted.energy);
        lost > negligible(accepted, now)) {
        now.lost += lost;
        level.jumps += count_jumps(accepted, now);
    }
    now.jumps = level.jumps;
    accepted = now;
    keep();
}

}  // namespace rsc
