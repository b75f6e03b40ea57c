#include "contact/element_contact.hpp"

#include "contact/adhesive_elements.hpp"
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
constexpr double kInnerError = 1e-3;  // of the products that iterations are made of
constexpr double kMostTimes = 30;     // of the last force, for a start from its pressures
constexpr double kMargin = 0.3;       // by which pixels are chosen lower than the step to the separation expected
constexpr int kBlock = 16;            // pixels of a side of the blocks whose highest points are kept

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

struct ElementContact::Impl {
    const HeightMap& heights;
    Indenter indenter;
    SolverOptions options;
    double bulge;
    std::unique_ptr<PixelProducts> products;
    ElementsSolver solver;
    int blocks_x, blocks_y;
    std::vector<double> block_top;  // highest z of each block
    double top = -kInfinity;        // highest point under the indenter

    // Pixels with g0 > 0 of the level at hand, row by row, and the answer.
    std::vector<Pixel> pixels;
    std::vector<double> g0, p;

    // Pixels under pressure at earlier levels, the last one first.
    struct Past {
        double separation;
        std::vector<Pixel> pixels;
        std::vector<double> p;
    };
    std::deque<Past> past;
    std::size_t since_move = 0;

    PressedOut pressed;
    bool accepted = false;  // the last level: from then on the contact is elastic until pressed further

    // Of a body that relaxes. p is then the pressures times scale().
    std::optional<LoadMemory> loads;
    std::unique_ptr<PixelProducts> loads_products;  // the solver's own keep its set of pixels
    // How far earlier loads lower the pixels that could touch at `lowered_at` or higher, in this step; NaN: not known for any.
    double lowered_at = kUnknown;
    std::vector<Pixel> lowered_pixels;
    std::vector<double> lowered;

    double scale() const { return loads ? loads->compliance() : 1.0; }
    std::int32_t place(const Pixel& pixel) const { return static_cast<std::int32_t>(pixel.y * heights.nx + pixel.x); }
    std::vector<double> deflections(std::vector<Pixel> where, const std::vector<std::int32_t>& places, const std::vector<double>& q);
    void take_off_rest(double Z0);

    Impl(const HeightMap& heights_, const Indenter& indenter_, const SolverOptions& options_)
        : heights(heights_),
          indenter(indenter_),
          options(options_),
          bulge(substrate_of(indenter_).bulge()),
          products(make_tree_products(substrate_of(indenter_), heights_.dx, heights_.dy, kInnerError, 0.1 * options_.tolerance)),
          solver(*products, options_.hardness.H0),
          blocks_x((heights_.nx + kBlock - 1) / kBlock),
          blocks_y((heights_.ny + kBlock - 1) / kBlock),
          pressed(heights_.nx, heights_.ny) {
        if (!options.relaxation.none()) loads.emplace(Creep(options.relaxation));
        block_top.assign(at(blocks_x) * at(blocks_y), -kInfinity);
        for (int j = 0; j < heights.ny; ++j) {
            const double* row = heights.row(j);
            double* tops = block_top.data() + at(j / kBlock) * at(blocks_x);
            for (int i = 0; i < heights.nx; ++i) tops[i / kBlock] = std::max(tops[i / kBlock], row[i]);
        }
        find_top();
    }

    double x(int i) const { return heights.x0 + i * heights.dx; }
    double y(int j) const { return heights.y0 + j * heights.dy; }
    double height(int i, int j) const { return indenter.clearance(x(i), y(j), heights(i, j) - pressed(i, j)); }

    // No point of the block is higher under the indenter: its highest one, before anything was pressed out, under the lowest part of the
    // face above the block.
    double bound(int bi, int bj) const {
        const Box block{x(bi * kBlock) - indenter.x0, x(std::min((bi + 1) * kBlock, heights.nx) - 1) - indenter.x0,
                        y(bj * kBlock) - indenter.y0, y(std::min((bj + 1) * kBlock, heights.ny) - 1) - indenter.y0};
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
                for (int i = bi * kBlock; i < std::min((bi + 1) * kBlock, heights.nx); ++i) top = std::max(top, height(i, j));
        }
}

// Pixels with g0 > 0: K > 0 only lowers the surface, so nothing else can touch.
void ElementContact::Impl::select(double Z0) {
    pixels.clear();
    g0.clear();
    std::vector<int> high;
    for (int bj = 0; bj < blocks_y; ++bj) {
        high.clear();
        for (int bi = 0; bi < blocks_x; ++bi) {
            if (bound(bi, bj) > Z0) high.push_back(bi);
        }
        if (high.empty()) continue;
        for (int j = bj * kBlock; j < std::min((bj + 1) * kBlock, heights.ny); ++j)
            for (int bi : high)
                for (int i = bi * kBlock; i < std::min((bi + 1) * kBlock, heights.nx); ++i) {
                    const double g = height(i, j) - Z0;
                    if (!(g > 0)) continue;
                    pixels.push_back({i, j});
                    g0.push_back(g);
                }
    }
}

// K q at the pixels `where`, row by row, of pressures q on the places of the memory.
std::vector<double> ElementContact::Impl::deflections(std::vector<Pixel> where, const std::vector<std::int32_t>& places,
                                                      const std::vector<double>& q) {
    if (!loads_products)
        loads_products = make_tree_products(substrate_of(indenter), heights.dx, heights.dy, kInnerError, 0.1 * options.tolerance);
    std::vector<Pixel> all;
    std::vector<double> source, w;
    std::size_t k = 0;
    for (std::size_t i = 0; i < places.size() || k < where.size();) {
        const std::int32_t next = k < where.size() ? place(where[k]) : std::numeric_limits<std::int32_t>::max();
        const bool carries = i < places.size() && places[i] <= next;
        const std::int32_t now = carries ? places[i] : next;
        all.push_back({now % heights.nx, now / heights.nx});
        source.push_back(carries ? q[i++] : 0.0);
        k += now == next;
    }
    w.resize(all.size());
    if (all.empty()) return w;
    loads_products->set_pixels(all);
    loads_products->apply(source.data(), w.data(), PixelProducts::Accuracy::full);
    std::vector<double> wanted;
    std::size_t j = 0;
    for (const Pixel& pixel : where) {
        while (!(all[j] == pixel)) ++j;
        wanted.push_back(w[j]);
    }
    return wanted;
}

// The deflection that earlier loads have left is taken off g0; what is left of it nowhere cannot touch.
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

// Pressures of the last level, or extrapolated through the last two where they lie near enough; all zero without any.
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
    add_pixels(level, heights, indenter, options.hardness.H0, touching, std::move(pressure));
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

// The force is the sum of the pressures, and Z0 one unknown more of the same solution (Polonsky and Keer). Pixels are chosen at a Z0 that lies
// lower than the one expected: N grows with a power of the depth that the last two levels tell.
std::optional<Level> ElementContact::solve_under(double N) {
    Impl& my = *impl_;
    if (path_dependent() || my.bulge > 0 || my.past.empty()) return std::nullopt;
    const double pixel = my.heights.dx * my.heights.dy;
    const auto force = [pixel](const Impl::Past& level) { return pixel * std::accumulate(level.p.begin(), level.p.end(), 0.0); };
    const double N0 = force(my.past[0]), depth = my.top - my.past[0].separation;
    if (!(depth > 0) || !(N0 > N / kMostTimes) || !(N0 < N * kMostTimes)) return std::nullopt;
    double power = 1.5;  // of a sphere; rough ones have more
    if (my.past.size() > 1) {
        const double grown = std::log(force(my.past[1]) / N0) / std::log((my.top - my.past[1].separation) / depth);
        if (grown > power) power = grown;
    }
    double expected = my.top - depth * std::pow(N / N0, 1 / power),
           lowest = expected - kMargin * std::abs(expected - my.past[0].separation);
    constexpr int trials = 4;
    for (int i = 0; i < trials; ++i) {
        my.select(lowest);
        my.predict(expected);
        if (std::none_of(my.p.begin(), my.p.end(), [](double p) { return p > 0; })) return std::nullopt;
        const ElementsOutcome outcome = my.solver.solve(my.pixels, my.g0, my.options.tolerance, my.options.max_iterations, my.p, N / pixel);
        if (!outcome.converged) return std::nullopt;
        const double rise = my.solver.rise();
        if (rise < 0) {
            expected = lowest + rise;
            lowest = expected - kMargin * std::abs(rise);
            continue;
        }
        std::size_t kept = 0;  // what lies below Z0 only was a candidate
        for (std::size_t k = 0; k < my.pixels.size(); ++k) {
            if (!(my.g0[k] > rise)) continue;
            my.pixels[kept] = my.pixels[k], my.g0[kept] = my.g0[k] - rise, my.p[kept++] = my.p[k];
        }
        my.pixels.resize(kept), my.g0.resize(kept), my.p.resize(kept);
        my.remember(lowest + rise);
        return my.report(lowest + rise, outcome);
    }
    return std::nullopt;
}

// The level just solved, for the start of later ones.
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
        std::vector<std::int32_t> where;
        std::vector<double> p;
        for (std::size_t k = 0; k < my.p.size(); ++k)
            if (my.p[k] > 0) where.push_back(my.place(my.pixels[k])), p.push_back(my.p[k] / my.scale());
        my.loads->accept(where, p, [&](const std::vector<double>& q) {
            std::vector<Pixel> places;
            for (const std::int32_t i : my.loads->places()) places.push_back({i % my.heights.nx, i / my.heights.nx});
            return my.deflections(std::move(places), my.loads->places(), q);
        });
        level.energy_lost = my.heights.dx * my.heights.dy * my.loads->lost();
        return;
    }
    if (!path_dependent()) return;
    std::vector<Pixel> pixels;
    std::vector<double> depth;
    my.solver.press_out(pixels, depth);
    for (std::size_t k = 0; k < pixels.size(); ++k) my.pressed.add(pixels[k].x, pixels[k].y, depth[k]);
    if (!pixels.empty()) my.find_top();
    level.plastic_work = my.options.hardness.H0 * my.heights.dx * my.heights.dy * my.pressed.sum();
}

bool ElementContact::path_dependent() const { return relaxes() || std::isfinite(impl_->options.hardness.H0); }

bool ElementContact::relaxes() const { return impl_->loads.has_value(); }

void ElementContact::step(double dt) {
    impl_->loads->step(dt);
    impl_->lowered_at = kUnknown;
}

// Triples: column and row of a point that was pressed out, how far; of a body that relaxes its loads, behind the time.
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
        profile.x.push_back(my.x(i));
        profile.y.push_back(my.y(j));
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

// The part of p'Kp/2 that comes from the shift is no energy of the bodies.
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
    my.indenter.x0 = x0;
    my.indenter.y0 = y0;
    if (my.past.size() > 1) my.past.resize(1);
    my.since_move = 0;
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
    if (options.adhesion.work > 0) return std::make_unique<AdhesiveElements>(heights, indenter, options);
    if (indenter.period.finite()) return std::make_unique<PeriodicElementContact>(heights, indenter, options);
    return std::make_unique<ElementContact>(heights, indenter, options);
}

}  // namespace rsc
