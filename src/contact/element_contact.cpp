#include "contact/element_contact.hpp"

#include "contact/adhesive_elements.hpp"
#include "contact/cut_map.hpp"
#include "contact/load_memory.hpp"
#include "contact/periodic_element_contact.hpp"
#include "contact/pixel_spots.hpp"
#include "contact/pressed_out.hpp"
#include "contact/solver/elements.hpp"
#include "contact/validity.hpp"
#include "error.hpp"

namespace rsc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kInnerError = 1e-3;  // error of products in iterations
constexpr double kMostTimes = 30;     // largest ratio to the last force for a start from its pressures
constexpr double kMargin = 0.3;       // pixels are selected lower by this share of the step to the expected separation
constexpr int kBlock = 16;            // side of the blocks whose highest points are stored [pixels]

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

struct ElementContact::Impl : CutMap {
    const HeightMap& heights;
    Indenter indenter;
    SolverOptions options;
    double bulge;
    std::unique_ptr<PixelProducts> products;
    ElementsSolver solver;
    int blocks_x, blocks_y;
    std::vector<double> block_top;  // highest z of each block
    double top = -kInfinity;        // highest point under the indenter

    // Pixels with g0 > 0 at the current level, row by row, and the solution.
    std::vector<Pixel> pixels;
    std::vector<double> g0, p;

    // Pixels under pressure at earlier levels, the last level first.
    struct Past {
        double separation;
        std::vector<Pixel> pixels;
        std::vector<double> p;
    };
    std::deque<Past> past;
    std::size_t since_move = 0;

    PressedOut pressed;
    bool accepted = false;  // the last level is accepted: the contact is elastic until loaded further

    // Relaxing bodies: p is then the pressures times scale().
    std::optional<LoadMemory> loads;
    std::unique_ptr<PixelProducts> loads_products;  // separate, since those of the solver keep its set of pixels
    // Deflection by earlier loads of the pixels that could touch at `lowered_at` or above, in this step; NaN: unknown.
    double lowered_at = kUnknown;
    std::vector<Pixel> lowered_pixels;
    std::vector<double> lowered;

    double scale() const { return loads ? loads->compliance() : 1.0; }
    std::vector<double> deflections(const std::vector<Pixel>& where, const std::vector<std::int32_t>& places, const std::vector<double>& q);
    void take_off_rest(double Z0);

    Impl(const HeightMap& heights_, const Indenter& indenter_, const SolverOptions& options_)
        : CutMap(heights_),
          heights(heights_),
          indenter(indenter_),
          options(options_),
          bulge(substrate_of(indenter_).bulge()),
          products(make_tree_products(substrate_of(indenter_), heights_.dx, heights_.dy, kInnerError, 0.1 * options_.tolerance)),
          solver(*products, options_.hardness.H0),
          blocks_x((heights_.nx + kBlock - 1) / kBlock),
          blocks_y((heights_.ny + kBlock - 1) / kBlock),
          pressed(heights_.nx, heights_.ny) {
        cut_open(indenter, kBlock);
        if (!options.relaxation.none()) loads.emplace(Creep(options.relaxation));
        block_top.assign(at(blocks_x) * at(blocks_y), -kInfinity);
        for (int j = 0; j < heights.ny; ++j) {
            double* tops = block_top.data() + at(j / kBlock) * at(blocks_x);
            for (int i = 0; i < heights.nx; ++i) tops[i / kBlock] = std::max(tops[i / kBlock], heights(i, j));
        }
        find_top();
    }

    double height(int i, int j) const {
        const int c = column(i), r = row(j);
        return indenter.clearance(x(i), y(j), heights(c, r) - pressed(c, r));
    }

    // Upper bound of the clearances of a block: its highest point (without plastic residual) under the lowest part of the face above it.
    double bound(int bi, int bj) const {
        const Box block{x(pixel_x(bi * kBlock)) - indenter.x0, x(pixel_x(std::min((bi + 1) * kBlock, heights.nx) - 1)) - indenter.x0,
                        y(pixel_y(bj * kBlock)) - indenter.y0, y(pixel_y(std::min((bj + 1) * kBlock, heights.ny) - 1)) - indenter.y0};
        return block_top[at(bj) * at(blocks_x) + at(bi)] - indenter.shape->lowest(block);
    }

    void find_top();
    void select(double Z0);
    void predict(double Z0);
    void remember(double Z0);
    Level report(double Z0, const ElementsOutcome& outcome) const;
};

void ElementContact::Impl::find_top() {
    top = -kInfinity;
    for (int bj = 0; bj < blocks_y; ++bj)
        for (int bi = 0; bi < blocks_x; ++bi) {
            if (!(bound(bi, bj) > top)) continue;
            for (int j = bj * kBlock; j < std::min((bj + 1) * kBlock, heights.ny); ++j)
                for (int i = bi * kBlock; i < std::min((bi + 1) * kBlock, heights.nx); ++i)
                    top = std::max(top, height(pixel_x(i), pixel_y(j)));
        }
}

// Selects the pixels with g0 > 0; no others can touch, because K > 0 only lowers the surface.
void ElementContact::Impl::select(double Z0) {
    pixels.clear();
    g0.clear();
    std::vector<int> high;
    for (int b = 0; b < blocks_y; ++b) {
        const int bj = (b + turn_y / kBlock) % blocks_y;
        high.clear();
        for (int a = 0; a < blocks_x; ++a) {
            const int bi = (a + turn_x / kBlock) % blocks_x;
            if (bound(bi, bj) > Z0) high.push_back(bi);
        }
        if (high.empty()) continue;
        for (int r = bj * kBlock; r < std::min((bj + 1) * kBlock, heights.ny); ++r)
            for (int bi : high)
                for (int c = bi * kBlock; c < std::min((bi + 1) * kBlock, heights.nx); ++c) {
                    const Pixel pixel{pixel_x(c), pixel_y(r)};
                    const double g = height(pixel.x, pixel.y) - Z0;
                    if (!(g > 0)) continue;
                    pixels.push_back(pixel);
                    g0.push_back(g);
                }
    }
}

// K q at the pixels `where`, for pressures q on the points of the load memory.
std::vector<double> ElementContact::Impl::deflections(const std::vector<Pixel>& where, const std::vector<std::int32_t>& places,
                                                      const std::vector<double>& q) {
    if (!loads_products)
        loads_products = make_tree_products(substrate_of(indenter), heights.dx, heights.dy, kInnerError, 0.1 * options.tolerance);
    const auto before = [](const Pixel& a, const Pixel& b) { return a.y < b.y || (a.y == b.y && a.x < b.x); };
    std::vector<Pixel> all = where;
    for (const std::int32_t loaded : places) all.push_back(pixel_at(loaded));
    std::sort(all.begin(), all.end(), before);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    const auto of = [&](const Pixel& pixel) {
        return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), pixel, before) - all.begin());
    };
    std::vector<double> source(all.size(), 0.0), w(all.size()), wanted;
    if (all.empty()) return wanted;
    for (std::size_t k = 0; k < places.size(); ++k) source[of(pixel_at(places[k]))] = q[k];
    loads_products->set_pixels(all);
    loads_products->apply(source.data(), w.data(), PixelProducts::Accuracy::full);
    for (const Pixel& pixel : where) wanted.push_back(w[of(pixel)]);
    return wanted;
}

// Subtracts the deflection by earlier loads from g0 and drops pixels that can no longer touch.
void ElementContact::Impl::take_off_rest(double Z0) {
    if (loads->places().empty()) return;
    if (!(Z0 >= lowered_at)) {
        lowered_at = Z0;
        lowered_pixels = pixels;
        lowered = deflections(pixels, loads->places(), loads->rest());
    }
    std::size_t kept = 0, j = 0;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        while (!(lowered_pixels[j] == pixels[k])) ++j;
        const double g = g0[k] - lowered[j];
        if (!(g > 0)) continue;
        pixels[kept] = pixels[k];
        g0[kept++] = g;
    }
    pixels.resize(kept), g0.resize(kept);
}

// Predicts the pressures from the last level, or by extrapolation through the last two if they are close; zero without earlier levels.
void ElementContact::Impl::predict(double Z0) {
    p.assign(pixels.size(), 0.0);
    double weight[2] = {1, 0};
    if (past.size() > 1) {
        const double gap = past[0].separation - past[1].separation, t = (Z0 - past[0].separation) / gap;
        if (gap != 0 && std::abs(t) <= 2) weight[0] = 1 + t, weight[1] = -t;
    }
    const auto before = [](const Pixel& a, const Pixel& b) { return a.y < b.y || (a.y == b.y && a.x < b.x); };
    for (std::size_t a = 0; a < past.size() && a < 2; ++a) {
        if (weight[a] == 0) continue;
        std::size_t k = 0;
        for (std::size_t l = 0; l < past[a].pixels.size(); ++l) {
            while (k < pixels.size() && before(pixels[k], past[a].pixels[l])) ++k;
            if (k < pixels.size() && pixels[k] == past[a].pixels[l]) p[k] += weight[a] * past[a].p[l];
        }
    }
    for (double& v : p) v = std::max(v, 0.0);
}

Level ElementContact::Impl::report(double Z0, const ElementsOutcome& outcome) const {
    Level level;
    level.separation = Z0;
    level.candidates = static_cast<std::int32_t>(pixels.size());
    level.iterations = outcome.iterations;
    level.products = outcome.products;
    level.residual = outcome.residual;
    level.method = Method::automatic;
    if (!outcome.converged) level.status = LevelStatus::not_converged;

    std::vector<Pixel> touching;
    std::vector<double> pressure;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        if (!(p[k] > 0)) continue;
        touching.push_back(pixels[k]);
        pressure.push_back(p[k] / scale());
    }
    add_pixels(level, frame, indenter, options.hardness.H0, touching, std::move(pressure));
    number_by_map(level);
    judge_edges(level, indenter, options);
    return level;
}

ElementContact::ElementContact(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options)
    : impl_(std::make_unique<Impl>(require_elements(heights, indenter, options), indenter, options)) {}
ElementContact::~ElementContact() = default;
ElementContact::ElementContact(ElementContact&&) noexcept = default;

Level ElementContact::solve(double Z0) {
    Impl& my = *impl_;
    my.select(Z0);
    if (my.loads) my.take_off_rest(Z0);
    my.predict(Z0);
    const ElementsOutcome outcome = my.solver.solve(my.pixels, my.g0, my.options.tolerance, my.options.max_iterations, my.p);
    my.remember(Z0);
    return my.report(Z0, outcome);
}

// Solves with the sum of the pressures given and Z0 as an additional unknown (Polonsky and Keer). Pixels are selected at a Z0 below the
// expected one, which follows from a power law of N with the exponent of the last two levels. Without earlier levels rough solutions at
// separations come first.
std::optional<Level> ElementContact::solve_under(double N) {
    Impl& my = *impl_;
    if (path_dependent() || my.bulge > 0) return std::nullopt;
    const double pixel = my.heights.dx * my.heights.dy;
    const auto force = [pixel](const Impl::Past& level) { return pixel * std::accumulate(level.p.begin(), level.p.end(), 0.0); };
    const auto far = [&] {
        if (my.past.empty()) return true;
        const double last = force(my.past[0]);
        return !(my.top > my.past[0].separation) || !(last > N / kMostTimes) || !(last < N * kMostTimes);
    };
    struct Levels {  // trials are no levels: restored at the end, also after an exception
        Impl& my;
        decltype(my.past) past = my.past;
        std::size_t since_move = my.since_move;
        bool restored = false;
        void restore() {
            if (!std::exchange(restored, true)) my.past = std::move(past), my.since_move = since_move;
        }
        ~Levels() { restore(); }
    } levels{my};
    const bool cold = far();
    if (cold) my.past.clear();
    ElementsOutcome outcome;
    const auto solved = [&](double tolerance, int iterations, std::optional<double> sum) {
        const ElementsOutcome now = my.solver.solve(my.pixels, my.g0, tolerance, iterations, my.p, sum);
        outcome = {now.converged, outcome.iterations + now.iterations, outcome.products + now.products, now.residual};
    };
    if (cold) {  // a rough solution near N
        constexpr double rough = 0.1, most_above = 2, most_below = 3, widest = 3;
        constexpr int rounds = 5, searches = 20;
        double depth = std::numeric_limits<double>::epsilon() * std::max(std::abs(my.top), std::numeric_limits<double>::min());
        while (force_at_most(depth) < N) depth *= 2;
        for (int i = 0;; ++i) {
            my.select(my.top - depth);
            my.predict(my.top - depth);
            solved(rough, rounds, std::nullopt);
            my.remember(my.top - depth);
            const double ratio = N / force(my.past[0]);
            if (ratio < most_below && ratio > 1 / most_above) break;
            if (i == searches) return std::nullopt;
            depth *= std::clamp(std::pow(ratio, 1 / 1.5), 1 / widest, widest);
        }
        my.past.resize(1);
    }
    if (far()) return std::nullopt;
    const double N0 = force(my.past[0]), depth = my.top - my.past[0].separation;
    double power = 1.5;  // of a sphere; larger for rough surfaces, 1 in full contact
    if (my.past.size() > 1) {
        const double grown = std::log(force(my.past[1]) / N0) / std::log((my.top - my.past[1].separation) / depth);
        if (grown >= 1) power = grown;
    }
    double expected = my.top - depth * std::pow(N / N0, 1 / power),
           lowest = expected - kMargin * std::abs(expected - my.past[0].separation);
    if (cold) lowest = expected - kMargin * (my.top - expected);
    constexpr int trials = 4;
    for (int i = 0; i < trials; ++i) {
        my.select(lowest);
        my.predict(expected);
        if (std::none_of(my.p.begin(), my.p.end(), [](double p) { return p > 0; })) return std::nullopt;
        solved(my.options.tolerance, my.options.max_iterations, N / pixel);
        if (!outcome.converged) return std::nullopt;
        const double rise = my.solver.rise();
        if (rise < 0) {  // points are missing; the next trial starts from this one
            expected = lowest + rise;
            lowest = expected - kMargin * std::abs(rise);
            my.remember(expected);
            my.past.resize(1);
            continue;
        }
        std::size_t kept = 0;  // drops candidates below Z0
        for (std::size_t k = 0; k < my.pixels.size(); ++k) {
            if (!(my.g0[k] > rise)) continue;
            my.pixels[kept] = my.pixels[k], my.g0[kept] = my.g0[k] - rise, my.p[kept++] = my.p[k];
        }
        my.pixels.resize(kept), my.g0.resize(kept), my.p.resize(kept);
        levels.restore();
        my.remember(lowest + rise);
        return my.report(lowest + rise, outcome);
    }
    return std::nullopt;
}

// Stores the last solution as a starting point for later levels.
void ElementContact::Impl::remember(double Z0) {
    Past now{Z0, {}, {}};
    for (std::size_t k = 0; k < p.size(); ++k) {
        if (!(p[k] > 0)) continue;
        now.pixels.push_back(pixels[k]);
        now.p.push_back(p[k]);
    }
    past.push_front(std::move(now));
    if (past.size() > 2) past.pop_back();
    since_move = std::min<std::size_t>(since_move + 1, 2);
    accepted = false;
}

void ElementContact::accept(Level& level) {
    Impl& my = *impl_;
    my.accepted = true;
    if (my.loads) {
        std::vector<std::pair<std::int32_t, double>> loaded;
        for (std::size_t k = 0; k < my.p.size(); ++k)
            if (my.p[k] > 0) loaded.emplace_back(my.place(my.pixels[k]), my.p[k] / my.scale());
        std::sort(loaded.begin(), loaded.end());
        std::vector<std::int32_t> where;
        std::vector<double> p;
        for (const auto& [place, pressure] : loaded) where.push_back(place), p.push_back(pressure);
        my.loads->accept(where, p, [&](const std::vector<double>& q) {
            std::vector<Pixel> places;
            for (const std::int32_t i : my.loads->places()) places.push_back(my.pixel_at(i));
            return my.deflections(places, my.loads->places(), q);
        });
        level.energy_lost = my.heights.dx * my.heights.dy * my.loads->lost();
        return;
    }
    if (!path_dependent()) return;
    std::vector<Pixel> pixels;
    std::vector<double> depth;
    my.solver.press_out(pixels, depth);
    for (std::size_t k = 0; k < pixels.size(); ++k) my.pressed.add(my.column(pixels[k].x), my.row(pixels[k].y), depth[k]);
    if (!pixels.empty()) my.find_top();
    level.plastic_work = my.options.hardness.H0 * my.heights.dx * my.heights.dy * my.pressed.sum();
}

bool ElementContact::path_dependent() const { return relaxes() || std::isfinite(impl_->options.hardness.H0); }

bool ElementContact::relaxes() const { return impl_->loads.has_value(); }

void ElementContact::step(double dt) {
    impl_->loads->step(dt);
    impl_->lowered_at = kUnknown;
}

// Triples of column, row and residual depth of a yielded point; for relaxing bodies the time, followed by the loads.
std::vector<double> ElementContact::memory() const {
    std::vector<double> triples;
    if (relaxes()) {
        triples.push_back(accepted_time());
        impl_->loads->write(triples);
        return triples;
    }
    for (const auto& [i, j, depth] : impl_->pressed.points()) triples.insert(triples.end(), {double(i), double(j), depth});
    return triples;
}

void ElementContact::recall(const std::vector<double>& memory, const Level* level) {
    Impl& my = *impl_;
    if (relaxes()) {
        recall_loads(*my.loads, memory, my.heights);
        recall_time(memory[0]);
        step(0);
    } else {
        my.pressed = pressed_out_of(my.heights, memory);
        my.find_top();
    }
    forget_levels();
    if (!level) return;
    Impl::Past past{level->separation, {}, level->pixels.pressure};
    for (const std::int32_t index : level->pixels.index) past.pixels.push_back({index % my.heights.nx, index / my.heights.nx});
    my.past.push_front(std::move(past));
    (void)solve(level->separation);
    my.accepted = true;
}

ResidualProfile ElementContact::residual_profile() const {
    const Impl& my = *impl_;
    ResidualProfile profile{{}, {}, {}, my.heights.dx, my.heights.dy};
    for (const auto& [i, j, depth] : my.pressed.points()) {
        profile.x.push_back(my.x(my.pixel_x(i)));
        profile.y.push_back(my.y(my.pixel_y(j)));
        profile.depth.push_back(depth);
    }
    return profile;
}

double ElementContact::stiffness() {
    const double pixel = impl_->heights.dx * impl_->heights.dy;
    const double slope = 0.0 - pixel * impl_->solver.stiffness(1e-9, impl_->accepted);
    return slope / (1 + shift() * slope);
}

double ElementContact::slope() { return Contact::slope() / impl_->scale(); }

// The part of p'Kp/2 due to the shift is not part of the energy of the bodies.
double ElementContact::energy() const {
    const Impl& my = *impl_;
    const double pixel = my.heights.dx * my.heights.dy;
    if (my.loads) return pixel * my.loads->stored();
    double N = 0;
    for (double p : my.p) N += pixel * p;
    return pixel * my.solver.energy() - 0.5 * shift() * N * N;
}

double ElementContact::shift() const { return impl_->bulge; }

void ElementContact::move_tip(double x0, double y0) {
    if (!std::isfinite(x0) || !std::isfinite(y0)) throw Error(Failure::bad_input, "the tip's position must be finite");
    Impl& my = *impl_;
    my.indenter.move(x0, y0);
    if (my.past.size() > 1) my.past.resize(1);
    my.since_move = 0;
    const int turn_x = my.turn_x, turn_y = my.turn_y;
    my.cut_open(my.indenter, kBlock);
    if (my.turn_x != turn_x || my.turn_y != turn_y) my.past.clear(), my.lowered_at = kUnknown;
    my.find_top();
}

double ElementContact::first_touch() const { return impl_->top; }
void ElementContact::forget_levels() {
    impl_->past.clear();
    impl_->since_move = 0;
}

const Indenter& ElementContact::indenter() const { return impl_->indenter; }
double ElementContact::tolerance() const { return impl_->options.tolerance; }

double ElementContact::force_at_most(double depth) {
    const Impl& my = *impl_;
    const double half = 0.5 * std::max(my.heights.Lx(), my.heights.Ly()), E = my.indenter.E_star;
    const double punch = 2 * E * half * depth;
    const auto smooth = my.indenter.shape->smooth(E);
    return smooth ? std::min(punch, smooth->force(depth)) : punch;
}

std::optional<double> ElementContact::likely_separation() const {
    if (impl_->past.empty() || impl_->past[0].pixels.empty() || !(impl_->past[0].separation < impl_->top)) return std::nullopt;
    return impl_->past[0].separation;
}

std::size_t ElementContact::levels_since_move() const { return impl_->since_move; }

std::unique_ptr<Contact> make_element_contact(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options) {
    if (options.adhesion.work > 0) return make_adhesive_elements(require_elements(heights, indenter, options), indenter, options);
    if (indenter.period.finite()) return std::make_unique<PeriodicElementContact>(heights, indenter, options);
    return std::make_unique<ElementContact>(heights, indenter, options);
}

}  // namespace rsc
