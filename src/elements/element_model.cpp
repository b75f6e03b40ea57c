#include "elements/element_model.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "contact/force_search.hpp"
#include "elements/elements.hpp"
#include "elements/pixel_model.hpp"
#include "elements/pixel_spots.hpp"

namespace rsc {
namespace {

constexpr double kInnerError = 1e-3;  // error of products in iterations
constexpr double kMostTimes = 30;  // largest ratio to the last force for a start from its pressures
// pixels are selected lower by this share of the step to the expected separation
constexpr double kMargin = 0.3;
constexpr double kColdMargin = 0.05;  // and of the expected depth, if no level is known
constexpr int kBlock = 16;            // side of the blocks whose highest points are stored [pixels]
constexpr int kPiece = 4096;          // pixels that a thread takes at a time
constexpr std::size_t kThreads = 16384;  // pixels from which on threads are used

bool before(const Pixel& a, const Pixel& b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

class ElementModel final : public PixelModel {
public:
    ElementModel(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options,
                 ElementPhysics physics)
        : PixelModel(heights, indenter, options, std::move(physics)),
          body_(substrate_of(indenter)),
          products_(
              make_products(body_, indenter.period, heights, kInnerError, 0.1 * options.tolerance)),
          solver_(*products_, highest_),
          blocks_x_((heights.nx + kBlock - 1) / kBlock),
          blocks_y_((heights.ny + kBlock - 1) / kBlock) {
        cut_open(indenter_, kBlock);
        block_top_.assign(at(blocks_x_) * at(blocks_y_), -kInfinity);
        parallel_for(blocks_y_, 1, 0, [&](int b) {
            double* tops = block_top_.data() + at(b) * at(blocks_x_);
            for (int j = b * kBlock; j < std::min((b + 1) * kBlock, heights.ny); ++j)
                for (int i = 0; i < heights.nx; ++i)
                    tops[i / kBlock] = std::max(tops[i / kBlock], heights(i, j));
        });
        find_top();
    }

    double stiffness(Slope) override {
        // The error of the answer is of second order in the tolerance.
        constexpr double tolerance = 1e-5;
        const double slope = solver_.stiffness(tolerance, accepted_);
        // that of the end of a step, or of a sudden change after it
        return 0.0 - pixel_area() * slope / (accepted_ ? 1.0 : scale());
    }

    // p'Kp/2 is evaluated as g0'p - p'Kp/2, which is equal at the solution.
    double energy() const override {
        return pixel_area() * (loads_ ? loads_->stored() : solver_.energy());
    }

    void move_tip(double x0, double y0) override {
        indenter_.move(x0, y0);
        if (past_.size() > 1) past_.resize(1);
        const int before_x = turn_x, before_y = turn_y;
        cut_open(indenter_, kBlock);
        if (turn_x != before_x || turn_y != before_y) {
            past_.clear();
            lowered_at_ = kNotComputed;
        }
        find_top();
    }

    Level solve(double Z0, bool trial) override;
    std::optional<Level> solve_under(double N) override;
    // Bound by the smooth indenter, if known, and by a flat punch as wide as the surface; rough
    // surfaces need at least this depth.
    double force_at_most(double depth) override {
        const double E = indenter_.E_star,
                     punch = E * std::max(heights_.Lx(), heights_.Ly()) * depth;
        const auto smooth = indenter_.shape->smooth(E);
        return smooth ? std::min(punch, smooth->force(depth)) : punch;
    }
    ContactRange contact_range() const override { return {.first_touch = top_}; }
    double shift() const override { return products_->shift(); }
    void keep(ArchiveWriter& to) const override {
        to(past_, accepted_);
        solver_.keep(to);
    }
    void recall(ArchiveReader& from) override {
        from(past_, accepted_);
        solver_.recall(from, heights_.nx, heights_.ny);
        for (const Past& past : past_)
            if (past.p.size() != past.pixels.size() ||
                !within(past.pixels, heights_.nx, heights_.ny))
                bad_input("the state does not belong to a contact of this surface");
    }

protected:
    void forget_solutions() override { past_.clear(); }
    void step_changed() override {
        lowered_at_ = kNotComputed;
        solver_.set_diagonal(rate());
    }
    void settle() override { solver_.settle(); }
    std::vector<std::pair<Pixel, double>> press_out() override { return solver_.press_out(); }
    void residual_changed() override { find_top(); }
    void start_from(double z, const Level& level) override {
        Past past{z, {}, level.pixels.pressure};
        for (const std::int32_t index : level.pixels.index)
            past.pixels.push_back({index % heights_.nx, index / heights_.nx});
        keep(std::move(past));
    }
    std::vector<double> deflections(const std::vector<Pixel>& where,
                                    const std::vector<double>& q) override;

private:
    // Pixels under pressure at earlier levels, the last level first.
    struct Past {
        double separation = 0;
        std::vector<Pixel> pixels = {};
        std::vector<double> p = {};
        template <class Archive, class Self>
        static void archive(Archive& a, Self& my) {
            a(my.separation, my.pixels, my.p);
        }
    };
    void keep(Past last) {
        past_.push_front(std::move(last));
        if (past_.size() > 2) past_.pop_back();
    }

    double clearance(int i, int j) const {
        return indenter_.clearance(x(i), y(j), height(column(i), row(j)));
    }
    void find_top();
    void select(double Z0);
    void predict(double Z0);
    void remember(double Z0);
    double force(const Past& level) const {
        return pixel_area() * std::accumulate(level.p.begin(), level.p.end(), 0.0);
    }
    double power_of_depth(double otherwise) const;
    double lowering_in_step() const;
    void solve_more(double tolerance, int iterations, std::optional<double> sum,
                    ElementsOutcome& all);
    bool solve_roughly(double N, double& power, ElementsOutcome& all);
    void take_off_rest(double Z0);
    // Lowers candidate k by fall(k), and drops those that can then not touch.
    template <class F>
    void lower(F&& fall) {
        std::size_t remaining = 0;
        for (std::size_t k = 0; k < pixels_.size(); ++k) {
            const double g = g0_[k] - fall(k);
            if (!(g > 0)) continue;
            pixels_[remaining] = pixels_[k];
            p_[remaining] = p_[k];
            g0_[remaining++] = g;
        }
        pixels_.resize(remaining);
        p_.resize(remaining);
        g0_.resize(remaining);
    }
    Level report(double Z0, const ElementsOutcome& outcome);

    Substrate body_;
    std::unique_ptr<PixelProducts> products_;
    ElementsSolver solver_;
    int blocks_x_, blocks_y_;
    // Highest z of each block, and upper bounds of its clearances.
    std::vector<double> block_top_, bound_;

    // Pixels with g0 > 0 at the current level, row by row, and the solution: pressures times
    // scale().
    std::vector<Pixel> pixels_;
    std::vector<double> g0_, p_;
    std::deque<Past> past_;

    // Of relaxing bodies; separate, because those of the solver keep its set of pixels.
    std::unique_ptr<PixelProducts> loads_products_;
    // Deflection by earlier loads of the pixels that could touch at `lowered_at_` or above, in this
    // step; NaN: unknown.
    double lowered_at_ = kNotComputed;
    std::vector<Pixel> lowered_pixels_;
    std::vector<double> lowered_;
};

void ElementModel::find_top() {
    bound_.resize(block_top_.size());
    parallel_for(blocks_y_, 4, 0, [&](int bj) {
        for (int bi = 0; bi < blocks_x_; ++bi) {
            // The highest point (without plastic residual) under the lowest part of the face above
            // the block.
            const Box block{
                x(pixel_x(bi * kBlock)) - indenter_.x0,
                x(pixel_x(std::min((bi + 1) * kBlock, heights_.nx) - 1)) - indenter_.x0,
                y(pixel_y(bj * kBlock)) - indenter_.y0,
                y(pixel_y(std::min((bj + 1) * kBlock, heights_.ny) - 1)) - indenter_.y0};
            const std::size_t b = at(bj) * at(blocks_x_) + at(bi);
            bound_[b] = block_top_[b] - indenter_.shape->lowest(block);
        }
    });
    double top = -kInfinity;
    for (int bj = 0; bj < blocks_y_; ++bj)
        for (int bi = 0; bi < blocks_x_; ++bi) {
            if (!(bound_[at(bj) * at(blocks_x_) + at(bi)] > top)) continue;
            for (int j = bj * kBlock; j < std::min((bj + 1) * kBlock, heights_.ny); ++j)
                for (int i = bi * kBlock; i < std::min((bi + 1) * kBlock, heights_.nx); ++i)
                    top = std::max(top, clearance(pixel_x(i), pixel_y(j)));
        }
    set_top(top);
}

// Selects the pixels with g0 > 0; no others can touch, because K > 0 only lowers the surface.
void ElementModel::select(double Z0) {
    struct Found {
        std::vector<Pixel> pixels;
        std::vector<double> g0;
    };
    std::vector<Found> found(at(blocks_y_));  // by row of blocks
    parallel_for(blocks_y_, 4, 0, [&](int b) {
        const int bj = (b + turn_y / kBlock) % blocks_y_;
        std::vector<int> high;
        for (int a = 0; a < blocks_x_; ++a) {
            const int bi = (a + turn_x / kBlock) % blocks_x_;
            if (bound_[at(bj) * at(blocks_x_) + at(bi)] > Z0) high.push_back(bi);
        }
        if (high.empty()) return;
        for (int r = bj * kBlock; r < std::min((bj + 1) * kBlock, heights_.ny); ++r)
            for (int bi : high) {
                const int first = bi * kBlock, n = std::min(kBlock, heights_.nx - first),
                          j = pixel_y(r);
                double dx[kBlock], face[kBlock], dy = 0;
                for (int c = 0; c < n; ++c) {
                    const Vec2 d = indenter_.from_tip(x(pixel_x(first + c)), y(j));
                    dx[c] = d.x;
                    dy = d.y;
                }
                indenter_.shape->heights(n, dx, dy, face);
                for (int c = 0; c < n; ++c) {
                    const double g = height(first + c, r) - face[c] - Z0;
                    if (g > 0) {
                        found[at(b)].pixels.push_back({pixel_x(first + c), j});
                        found[at(b)].g0.push_back(g);
                    }
                }
            }
    });
    std::vector<std::size_t> begin(found.size() + 1, 0);
    for (std::size_t b = 0; b < found.size(); ++b) begin[b + 1] = begin[b] + found[b].g0.size();
    pixels_.resize(begin.back());
    g0_.resize(begin.back());
    parallel_for(found.size(), 16, begin.back() > kThreads ? 0 : 1, [&](std::size_t b) {
        std::copy(found[b].pixels.begin(), found[b].pixels.end(), pixels_.data() + begin[b]);
        std::copy(found[b].g0.begin(), found[b].g0.end(), g0_.data() + begin[b]);
    });
}

std::vector<double> ElementModel::deflections(const std::vector<Pixel>& where,
                                              const std::vector<double>& q) {
    if (!loads_products_)
        loads_products_ =
            make_products(body_, indenter_.period, heights_, kInnerError, 0.1 * options_.tolerance);
    const std::vector<Pixel> loaded = loaded_pixels();
    std::vector<Pixel> all = where;
    all.insert(all.end(), loaded.begin(), loaded.end());
    std::sort(all.begin(), all.end(), before);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    const auto of = [&](const Pixel& pixel) {
        return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), pixel, before) -
                                        all.begin());
    };
    std::vector<double> source(all.size(), 0.0), w(all.size()), deflection;
    if (all.empty()) return deflection;
    for (std::size_t k = 0; k < loaded.size(); ++k) source[of(loaded[k])] = q[k];
    loads_products_->set_pixels(all);
    loads_products_->apply(source.data(), w.data(), PixelProducts::Accuracy::full);
    for (const Pixel& pixel : where) deflection.push_back(w[of(pixel)]);
    return deflection;
}

// Subtracts the deflection by earlier loads.
void ElementModel::take_off_rest(double Z0) {
    if (loads_->places().empty()) return;
    if (!(Z0 >= lowered_at_)) {
        lowered_at_ = Z0;
        lowered_pixels_ = pixels_;
        lowered_ = deflections(pixels_, loads_->rest());
    }
    p_.resize(pixels_.size());
    std::size_t j = 0;
    lower([&](std::size_t k) {
        while (!(lowered_pixels_[j] == pixels_[k])) ++j;
        return lowered_[j];
    });
}

// Predicts the pressures from the last level, or by extrapolation through the last two if they are
// close; zero without earlier levels.
void ElementModel::predict(double Z0) {
    p_.assign(pixels_.size(), 0.0);
    double weight[2] = {1, 0};
    if (past_.size() > 1) {
        const double gap = past_[0].separation - past_[1].separation,
                     t = (Z0 - past_[0].separation) / gap;
        if (gap != 0 && std::abs(t) <= 2) {
            weight[0] = 1 + t;
            weight[1] = -t;
        }
    }
    parallel_for(
        (pixels_.size() + kPiece - 1) / kPiece, 1, pixels_.size() > kThreads ? 0 : 1,
        [&](std::size_t piece) {
            const std::size_t begin = piece * kPiece,
                              end = std::min(begin + kPiece, pixels_.size());
            for (std::size_t a = 0; a < past_.size() && a < 2; ++a) {
                if (weight[a] == 0) continue;
                const std::vector<Pixel>& past = past_[a].pixels;
                auto l = std::lower_bound(past.begin(), past.end(), pixels_[begin], before);
                for (std::size_t k = begin; k < end; ++k) {
                    while (l != past.end() && before(*l, pixels_[k])) ++l;
                    if (l != past.end() && *l == pixels_[k])
                        p_[k] += weight[a] * past_[a].p[static_cast<std::size_t>(l - past.begin())];
                }
            }
            for (std::size_t k = begin; k < end; ++k) p_[k] = std::max(p_[k], 0.0);
        });
}

// Level of the last solution, which has been remembered.
Level ElementModel::report(double Z0, const ElementsOutcome& outcome) {
    return PixelModel::report(Z0, outcome, pixels_.size(), past_[0].pixels, past_[0].p);
}

Level ElementModel::solve(double Z0, bool) {
    select(Z0);
    if (loads_) take_off_rest(Z0);
    predict(Z0);
    const ElementsOutcome outcome =
        solver_.solve(pixels_, g0_, options_.tolerance, options_.max_iterations, p_);
    remember(Z0);
    return report(Z0, outcome);
}

// The exponent of N as a power of the depth, from the last two levels; `otherwise`, if it is not
// known.
double ElementModel::power_of_depth(double otherwise) const {
    if (past_.size() < 2) return otherwise;
    const double grown = std::log(force(past_[1]) / force(past_[0])) /
                         std::log((top_ - past_[1].separation) / (top_ - past_[0].separation));
    return grown >= 1 ? grown : otherwise;
}

// Depth of lowering in this step, expected from the mean of the last pressures, weighted by
// themselves.
double ElementModel::lowering_in_step() const {
    if (!(rate() > 0)) return 0;
    const std::vector<double>& p = past_[0].p;
    return rate() * std::inner_product(p.begin(), p.end(), p.begin(), 0.0) /
           std::accumulate(p.begin(), p.end(), 0.0);
}

void ElementModel::solve_more(double tolerance, int iterations, std::optional<double> sum,
                              ElementsOutcome& all) {
    const ElementsOutcome now = solver_.solve(pixels_, g0_, tolerance, iterations, p_, sum);
    all = {now.converged, all.iterations + now.iterations, all.products + now.products,
           now.residual, now.certificate};
}

// Rough solutions at separations until one has a force near N; false if none has.
bool ElementModel::solve_roughly(double N, double& power, ElementsOutcome& all) {
    constexpr double rough = 0.1, most_above = 2, most_below = 3, widest = 3, steep = 4;
    constexpr int rounds = 5, searches = 21;
    past_.clear();
    const auto evaluate = [&](double z, Bracket& bracket, int) {
        select(z);
        predict(z);
        solve_more(rough, rounds, std::nullopt, all);
        remember(z);
        const double ratio = N / force(past_[0]);
        // Candidates deeper than needed cost more than another trial.
        power = power_of_depth(ratio > 1 ? steep : power);
        if (ratio < most_below && ratio > 1 / most_above) return bracket.close(z);
        (ratio > 1 ? bracket.high : bracket.low) = z;
        const double change = std::pow(ratio, 1 / (ratio > 1 ? std::max(power, steep) : power));
        return top_ - (top_ - z) * std::clamp(change, 1 / widest, widest);
    };
    const SearchEnd end =
        search_force(top_ - least_depth(*this, N), {-kInfinity, top_}, searches, evaluate);
    past_.resize(1);
    return end == SearchEnd::closed;
}

// Solves with the sum of the pressures given and Z0 as an additional unknown (Polonsky and Keer).
// Pixels are selected at a Z0 below the expected one, which follows from a power law of N with the
// exponent of the last two levels. Without earlier levels rough solutions at separations come
// first.
std::optional<Level> ElementModel::solve_under(double N) {
    if (loads_ || limited()) return std::nullopt;
    const auto far = [&] {
        if (past_.empty()) return true;
        const double last = force(past_[0]);
        return !(top_ > past_[0].separation) || !(last > N / kMostTimes) ||
               !(last < N * kMostTimes);
    };
    struct Levels {  // trials are no levels: restored at the end, also after an exception
        ElementModel& my;
        decltype(my.past_) past = my.past_;
        bool restored = false;
        void restore() {
            if (!std::exchange(restored, true)) my.past_ = std::move(past);
        }
        ~Levels() { restore(); }
    } levels{*this};
    ElementsOutcome outcome;
    double power = 1.5;  // of a sphere; larger for rough surfaces, 1 in full contact
    const bool cold = far();
    if (cold && (!solve_roughly(N, power, outcome) || far())) return std::nullopt;
    power = power_of_depth(power);
    const double depth = top_ - past_[0].separation;
    double expected = top_ - depth * std::pow(N / force(past_[0]), 1 / power) - lowering_in_step(),
           lowest = expected - kMargin * std::abs(expected - past_[0].separation);
    if (cold) lowest -= kColdMargin * (top_ - expected);
    constexpr int trials = 4;
    for (int i = 0; i < trials; ++i) {
        select(lowest);
        predict(expected);
        if (std::none_of(p_.begin(), p_.end(), [](double p) { return p > 0; })) return std::nullopt;
        solve_more(options_.tolerance, options_.max_iterations, N / pixel_area(), outcome);
        if (!outcome.converged) return std::nullopt;
        const double rise = solver_.rise();
        if (rise < 0) {  // points are missing; the next trial starts from this one
            expected = lowest + rise;
            lowest = expected - kMargin * std::abs(rise);
            remember(expected);
            past_.resize(1);
            continue;
        }
        lower([rise](std::size_t) { return rise; });
        levels.restore();
        remember(lowest + rise);
        return report(lowest + rise, outcome);
    }
    return std::nullopt;
}

// Stores the last solution as a starting point for later levels.
void ElementModel::remember(double Z0) {
    std::vector<int> pressed;
    find_all(
        p_.size(), kPiece, p_.size() > kThreads ? 0 : 1, [&](std::size_t k) { return p_[k] > 0; },
        pressed);
    Past now{Z0, std::vector<Pixel>(pressed.size()), std::vector<double>(pressed.size())};
    for (std::size_t l = 0; l < pressed.size(); ++l) {
        now.pixels[l] = pixels_[at(pressed[l])];
        now.p[l] = p_[at(pressed[l])];
    }
    keep(std::move(now));
    accepted_ = false;
}

}  // namespace

std::unique_ptr<Model> make_elements(const HeightMap& heights, const Indenter& indenter,
                                     const SolverOptions& options, ElementPhysics physics) {
    if (indenter.period.finite())
        return make_periodic_elements(heights, indenter, options, std::move(physics));
    return std::make_unique<ElementModel>(heights, indenter, options, std::move(physics));
}

}  // namespace rsc
