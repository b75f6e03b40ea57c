#include "contact/adhesive_elements.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include "contact/pixel_spots.hpp"
#include "contact/solver/elements.hpp"
#include "contact/solver/periodic_elements.hpp"
#include "contact/validity.hpp"
#include "error.hpp"
#include "format.hpp"
#include "rough/parallel.hpp"

namespace rsc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kCoarsest = 0.5;  // smallest ratio of z0 to the side of a pixel
constexpr double kResolved = 2;    // smallest ratio of a level within the range of validity
// Expected error of N, relative to the force of the traction s0 on all points that attract, times z0/h: edges are resolved to
// a pixel only. Errors of separate contacts cancel on average (measured: test/README).
constexpr double kEdgeError = 0.13;
constexpr double kJump = 0.1;         // least dissipated energy of a jump, relative to w times its area
constexpr double kFewest = 8;         // and least number of its points
constexpr double kInnerError = 1e-3;  // error of products in iterations
// Number of renewals after which pixels no longer leave the attracting set, so that the iteration ends; and largest number.
constexpr int kQuick = 200, kMost = 2000;
constexpr std::size_t kKept = 5;  // numbers before the points in memory()

std::size_t at(int k) { return static_cast<std::size_t>(k); }

// State left by accepted levels.
struct Past {
    double separation = kInfinity, force = 0, work = 0, least_force = 0, lost = 0;
    std::vector<std::int32_t> attracting;  // increasing
};

struct State {
    const HeightMap& heights;
    Indenter indenter;
    SolverOptions options;
    double s0, z0, pixel;
    HeightMap raised;                         // periodic flats: heights for the solver
    std::unique_ptr<PeriodicElements> flats;  // between flats
    std::unique_ptr<PixelProducts> products, field;
    std::optional<ElementsSolver> spots;

    // For all points of the map: clearance under the indenter, pressure + s0, and whether the point attracts.
    std::vector<double> clearance, q;
    std::vector<char> on;
    double top = -kInfinity;
    // Of the accepted level: gaps and pressures of all points; gaps of points out of reach are those without deformation.
    std::vector<double> gap_before, p_before;
    // Points within reach, row by row, with their elevation by the attraction and their gaps.
    std::vector<std::int32_t> reach;
    std::vector<double> lift, gap;
    double margin = 0;  // largest height by which points may be raised

    Past accepted, now;
    double energy = 0;

    State(const HeightMap& heights_, const Indenter& indenter_, const SolverOptions& options_)
        : heights(heights_),
          indenter(indenter_),
          options(options_),
          s0(options.adhesion.work / options.adhesion.range),
          z0(options.adhesion.range),
          pixel(heights.dx * heights.dy) {
        const auto refuse = [](const std::string& what) { throw Error(Failure::bad_input, "solids%adhesion: " + what); };
        if (!(z0 > 0)) refuse("boundary elements require solids%adhesion_range > 0 (JKR is the limit of 0)");
        if (std::isfinite(options.hardness.H0)) refuse("not available yet with solids%hardness");
        if (!options.relaxation.none()) refuse("not available yet with solids%relaxation_share");
        if (resolution() < kCoarsest)
            refuse(format(
                "solids%%adhesion_range = %.6g is %.2g of a pixel's side; boundary elements require at least 0.5, and 2 is recommended", z0,
                resolution()));
        const Substrate body = substrate_of(indenter);
        if (indenter.period.finite()) {
            raised = heights.copy();
            place();
            flats = std::make_unique<PeriodicElements>(Relief{raised.nx, raised.ny, raised.dx, raised.dy, raised.data.get(), raised.stride},
                                                       body, kInfinity);
        } else {
            if (body.smooth()) refuse("not available yet for boundary elements on a free surface with layers");
            products = make_tree_products(body, heights.dx, heights.dy, kInnerError, 0.1 * options.tolerance);
            field = make_tree_products(body, heights.dx, heights.dy, kInnerError, 0.1 * options.tolerance);
            spots.emplace(*products, kInfinity);
            place();
        }
    }

    double resolution() const { return z0 / std::max(heights.dx, heights.dy); }
    Pixel at_point(std::int32_t k) const { return {k % heights.nx, k / heights.nx}; }
    void place();
    void gather(double Z);
    bool renew(double Z, Level& level);
    bool press(double Z, Level& level);
    std::int32_t count_jumps(const std::vector<double>& p) const;
    void keep();
    std::vector<double> deflections(const std::vector<double>& p);
    Level solve(double Z);
};

// Initialises for the present position of the tip, without attracting points.
void State::place() {
    const std::size_t n = at(heights.nx) * at(heights.ny);
    clearance.resize(n);
    q.assign(n, 0.0), on.assign(n, 0);
    for (int j = 0; j < heights.ny; ++j)
        for (int i = 0; i < heights.nx; ++i) {
            const double z = indenter.clearance(heights.x0 + i * heights.dx, heights.y0 + j * heights.dy, heights(i, j));
            clearance[at(j) * at(heights.nx) + at(i)] = z;
            if (raised.data) raised.row(j)[i] = z;
        }
    top = *std::max_element(clearance.begin(), clearance.end());
}

// Selects the points whose gap can be below z0 if points are raised by at most the margin; for periodic flats all points.
void State::gather(double Z) {
    reach.clear();
    for (std::size_t k = 0; k < clearance.size(); ++k) {
        if (flats || on[k] || clearance[k] > Z - z0 - margin)
            reach.push_back(static_cast<std::int32_t>(k));
        else
            q[k] = 0;
    }
    std::vector<Pixel> pixels;
    for (const std::int32_t k : reach) pixels.push_back(at_point(k));
    if (field && !pixels.empty()) field->set_pixels(pixels);
}

// K p at the points within reach.
std::vector<double> State::deflections(const std::vector<double>& p) {
    std::vector<double> u(p.size());
    if (p.empty()) return u;
    if (!flats) {
        field->apply(p.data(), u.data(), PixelProducts::Accuracy::full);
        return u;
    }
    std::vector<Pixel> where;
    std::vector<double> some;
    for (std::size_t k = 0; k < p.size(); ++k)
        if (p[k] != 0) where.push_back(at_point(reach[k])), some.push_back(p[k]);
    return flats->deflections(where, some);
}

// Solves for q with fixed attracting points. Returns false if it does not converge.
bool State::press(double Z, Level& level) {
    ElementsOutcome outcome;
    if (flats) {
        for (std::size_t k = 0; k < reach.size(); ++k) {
            const Pixel at_k = at_point(reach[k]);
            raised.row(at_k.y)[at_k.x] = clearance[k] + lift[k];
        }
        flats->heights_changed();
        outcome = flats->approach(Z, options.tolerance, options.max_iterations);
        std::fill(q.begin(), q.end(), 0.0);
        for (std::size_t k = 0; k < flats->pixels().size(); ++k)
            q[at(flats->pixels()[k].y) * at(heights.nx) + at(flats->pixels()[k].x)] = flats->pressures()[k];
    } else {
        std::vector<Pixel> pixels;
        std::vector<double> g0, p;
        for (std::size_t k = 0; k < reach.size(); ++k) {
            double& here = q[at(reach[k])];
            const double g = clearance[at(reach[k])] - Z + lift[k];
            if (g > 0) pixels.push_back(at_point(reach[k])), g0.push_back(g), p.push_back(here);
            here = 0;
        }
        outcome = spots->solve(pixels, g0, options.tolerance, options.max_iterations, p);
        for (std::size_t k = 0; k < p.size(); ++k) q[at(pixels[k].y) * at(heights.nx) + at(pixels[k].x)] = p[k];
    }
    level.iterations += outcome.iterations;
    level.products += outcome.products + 2;
    level.residual = outcome.residual;
    return outcome.converged;
}

// Finds the state at Z by renewing the attracting points, starting from the present ones. Returns false if it does not converge.
bool State::renew(double Z, Level& level) {
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
        for (std::size_t k = 0; k < reach.size(); ++k) p[k] = q[at(reach[k])];
        gap = deflections(p);
        long changed = 0;
        for (std::size_t k = 0; k < reach.size(); ++k) {
            gap[k] -= lift[k] + clearance[at(reach[k])] - Z;
            char& attracts = on[at(reach[k])];
            const char next = gap[k] < z0 || (round > kQuick && attracts);
            changed += next != attracts;
            attracts = next;
        }
        if (changed == 0) return true;
    }
    return false;
}

Level State::solve(double Z) {
    now = accepted;
    std::fill(on.begin(), on.end(), char(0));
    for (const std::int32_t k : accepted.attracting) on[at(k)] = 1;
    Level level;
    level.separation = Z;
    level.method = Method::automatic;
    const bool converged = renew(Z, level);
    if (!converged) gap.assign(reach.size(), 0.0);
    level.candidates = static_cast<std::int32_t>(reach.size());
    now.separation = Z;
    now.attracting.clear();
    std::vector<Pixel> touching;
    std::vector<double> pressures, p(reach.size());
    double twice = 0, attraction = 0, tension = 0;
    long cohesive = 0;
    for (std::size_t k = 0; k < reach.size() && converged; ++k) {
        const std::int32_t i = reach[k];
        p[k] = q[at(i)] - (on[at(i)] ? s0 : 0.0);
        twice += p[k] * (gap[k] + clearance[at(i)] - Z);
        if (q[at(i)] > 0) touching.push_back(at_point(i)), pressures.push_back(p[k]);
        if (!on[at(i)]) continue;
        now.attracting.push_back(i);
        attraction += s0 * (z0 - gap[k]);
        if (!(q[at(i)] > 0)) tension += s0, ++cohesive, level.pixels.cohesive.push_back(i);
    }
    add_pixels(level, heights, indenter, kInfinity, touching, std::move(pressures), s0);
    level.pixels.tension = -s0;
    level.force -= pixel * tension;
    level.cohesive_area = pixel * static_cast<double>(cohesive);
    level.cohesive_resolution = resolution();
    if (converged && level.force != 0)
        level.force_error_expected = kEdgeError / resolution() * s0 * (level.area + level.cohesive_area) /
                                     (std::sqrt(std::max(level.contacts, 1)) * std::abs(level.force));
    energy = pixel * (0.5 * twice - attraction);
    if (accepted.separation < kInfinity)
        now.work += 0.5 * (accepted.force + level.force) * (accepted.separation - Z);
    else
        now.work = energy;
    now.force = level.force;
    now.least_force = std::min(now.least_force, level.force);
    level.least_force = now.least_force;
    level.energy_lost = now.lost = now.work - energy;
    if (converged) level.jumps = count_jumps(p);
    if (flats)
        level.nominal_area = heights.Lx() * heights.Ly();
    else
        judge_edges(level, indenter, options);
    if (resolution() < kResolved && !now.attracting.empty()) level.status = graver(level.status, LevelStatus::out_of_validity);
    if (!converged) level.status = LevelStatus::not_converged;
    return level;
}

// Number of connected sets of points that began or ceased to attract since the accepted level and dissipated energy by it. Between two states
// point k dissipates -(p + p')(w' - w)/2 - (psi' - psi) a unit area, where psi = -s0 (z0 - w) if it attracts and 0 otherwise: with
// trapezoidal work these add up exactly to energy_lost, because deflections are linear in the pressures. A point that crosses z0 smoothly
// dissipates at most half of s0 times the change of its gap, in the middle of a step nothing. Sets of fewer points, or of less dissipation per
// area than kJump w, are not counted: edges advance and recede from pixel to pixel in small jumps.
std::int32_t State::count_jumps(const std::vector<double>& p) const {
    if (!(accepted.separation < kInfinity)) return 0;
    std::vector<std::int32_t> changed;
    std::set_symmetric_difference(accepted.attracting.begin(), accepted.attracting.end(), now.attracting.begin(), now.attracting.end(),
                                  std::back_inserter(changed));
    if (changed.empty() || reach.empty()) return 0;
    std::vector<Pixel> where;
    std::vector<double> dissipated;
    std::size_t k = 0;
    const auto psi = [&](double w) { return -s0 * std::max(z0 - w, 0.0); };
    for (const std::int32_t i : changed) {
        while (k + 1 < reach.size() && reach[k] < i) ++k;
        const bool reached = reach[k] == i;
        const double w = gap_before[at(i)], w_now = reached ? gap[k] : now.separation - clearance[at(i)];
        where.push_back(at_point(i));
        dissipated.push_back(-0.5 * (p_before[at(i)] + (reached ? p[k] : 0.0)) * (w_now - w) - (psi(w_now) - psi(w)));
    }
    std::vector<int> set;
    const int sets = connected_sets(where, set, flats ? heights.nx : 0, flats ? heights.ny : 0);
    std::vector<double> sum(at(sets)), points(at(sets));
    for (std::size_t c = 0; c < where.size(); ++c) sum[at(set[c])] += dissipated[c], points[at(set[c])] += 1;
    const double least = kJump * options.adhesion.work;
    std::int32_t jumps = 0;
    for (std::size_t c = 0; c < sum.size(); ++c) jumps += points[c] >= kFewest && sum[c] > least * points[c];
    return jumps;
}

// Stores gaps and pressures of the last level, the accepted one.
void State::keep() {
    gap_before.resize(clearance.size()), p_before.assign(clearance.size(), 0.0);
    for (std::size_t k = 0; k < clearance.size(); ++k) gap_before[k] = now.separation - clearance[k];
    for (std::size_t k = 0; k < reach.size(); ++k) {
        const std::size_t i = at(reach[k]);
        gap_before[i] = gap[k];
        p_before[i] = q[i] - (on[i] ? s0 : 0.0);
    }
}

class AdhesiveElements final : public Contact {
public:
    AdhesiveElements(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options)
        : state_(heights, indenter, options) {}

    double stiffness() override {
        if (std::none_of(state_.q.begin(), state_.q.end(), [](double q) { return q > 0; })) return 0;
        return state_.flats ? -state_.heights.Lx() * state_.heights.Ly() * state_.flats->stiffness(false)
                            : -state_.pixel * state_.spots->stiffness(1e-9, false);
    }
    double energy() const override { return state_.energy; }
    double first_touch() const override { return state_.top; }
    const Indenter& indenter() const override { return state_.indenter; }
    bool path_dependent() const override { return true; }
    bool pulls() const override { return true; }

    void move_tip(double x0, double y0) override {
        if (!std::isfinite(x0) || !std::isfinite(y0)) throw Error(Failure::bad_input, "the tip's position must be finite");
        if (!state_.accepted.attracting.empty())
            throw Error(Failure::bad_input, "solids%adhesion: the tip is moved while the surface attracts, which is not available yet");
        // On a surface that repeats whole periods do not count; the contact ends at the border.
        const auto inside = [](double x, double first, double period) {
            return std::isfinite(period) ? x - period * std::floor((x - first) / period) : x;
        };
        Indenter& tip = state_.indenter;
        tip.x0 = inside(x0, state_.heights.x0, tip.repeats.x), tip.y0 = inside(y0, state_.heights.y0, tip.repeats.y);
        state_.place();
    }

    std::vector<double> memory() const override {
        const Past& past = state_.accepted;
        if (past.separation == kInfinity) return {};
        std::vector<double> numbers = {past.separation, past.force, past.work, past.least_force, past.lost};
        numbers.insert(numbers.end(), past.attracting.begin(), past.attracting.end());
        return numbers;
    }

    void recall(const std::vector<double>& memory, const Level* level) override {
        Past past;
        bool sound = memory.empty() || memory.size() >= kKept;
        for (std::size_t k = 0; k < memory.size() && sound; ++k)
            sound = std::isfinite(memory[k]) && (k < kKept || (memory[k] >= 0 && memory[k] < static_cast<double>(state_.clearance.size())));
        if (!sound) throw Error(Failure::bad_input, "this is not the state of a contact of this surface");
        if (!memory.empty()) past = {memory[0], memory[1], memory[2], memory[3], memory[4], {}};
        for (std::size_t k = kKept; k < memory.size(); ++k) past.attracting.push_back(static_cast<std::int32_t>(memory[k]));
        forget_levels();
        state_.accepted = std::move(past);
        if ((level || state_.accepted.separation < kInfinity) &&
            solve(level ? level->separation : state_.accepted.separation).status == LevelStatus::not_converged)
            throw Error(Failure::bad_input, "the state of the contact cannot be reached again: the solver does not converge");
        state_.keep();
    }

protected:
    void forget_levels() override {
        state_.accepted = {};
        std::fill(state_.q.begin(), state_.q.end(), 0.0);
    }
    Level solve(double Z0) override { return state_.solve(Z0); }
    std::optional<Level> solve_under(double N) override {
        std::int32_t iterations = 0;
        std::int64_t products = 0;
        Level level;
        const auto look = [&](double Z) {
            level = state_.solve(Z);
            iterations += level.iterations, products += level.products;
            return level.status == LevelStatus::not_converged ? std::numeric_limits<double>::quiet_NaN() : level.force - N;
        };
        const auto precise = [&](double miss) {
            return std::abs(miss) <= tolerance() * std::max(std::abs(N), 1e-3 * state_.s0 * state_.pixel);
        };
        double Z = state_.accepted.separation < kInfinity ? state_.accepted.separation : state_.top + state_.z0, miss = look(Z);
        const double way = miss < 0 ? -1 : 1;
        double before = Z, before_miss = miss, least = level.force, least_at = Z, step = 0.25 * state_.z0;
        constexpr int most = 400;
        bool found = precise(miss);
        for (int i = 0; i < most && !found && miss * before_miss > 0; ++i) {
            if (way > 0 && state_.now.attracting.empty()) break;  // no attraction is left
            before = Z, before_miss = miss;
            Z = std::max(Z + way * step, std::nextafter(closed(), kInfinity));
            step *= 1.4;
            miss = look(Z);
            if (level.status != LevelStatus::not_converged && level.force < least) least = level.force, least_at = Z;
            found = precise(miss);
        }
        if (!found && miss * before_miss < 0) {
            std::uintmax_t steps = 100;
            const auto exact = [&](double z) {
                const double m = look(z);
                return precise(m) ? 0.0 : m;
            };
            const bool rising = Z > before;
            const auto [low, high] =
                boost::math::tools::toms748_solve(exact, rising ? before : Z, rising ? Z : before, rising ? before_miss : miss,
                                                  rising ? miss : before_miss, boost::math::tools::eps_tolerance<double>(50), steps);
            found = precise(look(0.5 * (low + high)));
        }
        if (!found) {
            (void)look(least_at);
            if (level.status != LevelStatus::not_converged) level.fallback = Fallback::held;
            level.status = LevelStatus::not_converged;
        }
        level.iterations = iterations, level.products = products;
        return level;
    }
    void accept(Level&) override {
        state_.accepted = state_.now;
        state_.keep();
    }
    double tolerance() const override { return state_.options.tolerance; }

    double closed() const override { return state_.flats ? state_.flats->closed() : -kInfinity; }

    double force_at_most(double) override { return 0; }
    std::optional<double> likely_separation() const override { return std::nullopt; }
    std::size_t levels_since_move() const override { return 0; }

private:
    State state_;
};

}  // namespace

std::unique_ptr<Contact> make_adhesive_elements(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options) {
    return std::make_unique<AdhesiveElements>(heights, indenter, options);
}

}  // namespace rsc
