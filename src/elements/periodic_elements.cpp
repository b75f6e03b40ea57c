#include "elements/periodic_elements.hpp"

#include "base/error.hpp"
#include "base/format.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

constexpr int kThreads = 400000;  // number of pixels above which threads are used
constexpr std::size_t kFew = 8;   // products are split if one of this many pixels is in the set
// Largest number of conjugate-gradient steps in a round, and the reduction of the preconditioned
// residual that ends a round earlier.
constexpr int kSteps = 8;
constexpr double kReduction = 0.1;
// Rounds after which the energy is monitored in every round; most sets converge in about ten.
constexpr int kQuick = 15;
// Error below which the residual of a round is computed in double precision.
constexpr double kSingle = 1e-5;
// Shortest side for which a coarser grid is used.
constexpr int kShortest = 32;
// Tolerance of solutions on coarser grids, which are only starting points.
constexpr double kCoarseError = 1e-4;
constexpr int kBlock = 8;  // side of the blocks in which clipped pressures are made up for
constexpr double kRounding = 1e-12;  // rounding error of separations, in rms heights

}  // namespace

// Mean of a function of the heights.
template <class F>
double PeriodicElements::mean_of(F&& f) const {
    const double means = sum_in_order(heights_.ny, kRows, threads(), [&](int j) {
        double row = 0;
        for (int i = 0; i < heights_.nx; ++i) row += f(heights_.z[j * heights_.stride + i]);
        return row / heights_.nx;
    });
    return means / heights_.ny;
}

double PeriodicElements::mean_height() const {
    return mean_of([](double z) { return z; });
}

PeriodicElements::PeriodicElements(const PeriodicHeights& heights, const Substrate& substrate,
                                   double highest)
    : BoundedSolver(highest, {kSteps, kReduction, kQuick, true}),
      heights_(heights),
      substrate_(substrate),
      highest_pressure_(highest),
      aspect_(heights.ny > 1 ? heights.dy / heights.dx : kEndless),
      inner_(heights.nx, heights.ny, 1, aspect_, share_of_modes(substrate_, heights_.dx),
             &transformed_),
      plane_(heights.nx, heights.ny) {
    mean_ = zero_ = mean_height();
    std::vector<double> farthest(at(heights_.ny), 0.0);
    parallel_for(heights_.ny, kRows, threads(), [&](int j) {
        for (int i = 0; i < heights_.nx; ++i)
            farthest[at(j)] =
                std::max(farthest[at(j)], std::abs(heights_.z[j * heights_.stride + i] - mean_));
    });
    const double largest = std::ranges::max(farthest);
    if (!(largest > 0))
        throw Error(Failure::bad_input, "the surface is flat: two smooth flats touch everywhere");
    rms_ = largest * std::sqrt(mean_of([&](double z) {
               return (z - mean_) / largest * ((z - mean_) / largest);
           }));
    scale_ = 1 / rms_;
    pressure_unit_ = substrate.modulus() * (rms_ / heights.dx);
    highest_ = highest / pressure_unit_;
    prepare();
}

PeriodicElements::PeriodicElements(const PeriodicElements& finer,
                                   const std::vector<double>& heights)
    : BoundedSolver(finer.highest_, {kSteps, kReduction, kQuick, true}),
      heights_{finer.heights_.nx / 2, (finer.heights_.ny + 1) / 2,
               2 * finer.heights_.dx, 2 * finer.heights_.dy,
               heights.data(),        finer.heights_.nx / 2},
      substrate_(finer.substrate_),
      highest_pressure_(finer.highest_pressure_),
      unit_(2 * finer.unit_),
      aspect_(finer.aspect_),
      inner_(heights_.nx, heights_.ny, 1, aspect_, share_of_modes(substrate_, heights_.dx),
             &transformed_),
      plane_(heights_.nx, heights_.ny) {
    diagonal_ = finer.diagonal_;
    prepare();
}

void PeriodicElements::prepare() {
    const Share share = share_of_modes(substrate_, heights_.dx);
    rows_.assign(at(heights_.ny) + 1, 0);
    prepare_inverse();
    if (SplitPixels::suits(heights_.nx, heights_.ny, aspect_, share))
        split_ = std::make_unique<SplitPixels>(heights_.nx, heights_.ny, aspect_, share);
}

void PeriodicElements::prepare_inverse() {
    inverse_of_ = diagonal_;
    const Share share = with_diagonal(share_of_modes(substrate_, heights_.dx), diagonal_ / unit_);
    inverse_ = inverse_stencil(aspect_, share);
    far_ = std::make_unique<BlockCorrection>(heights_.nx, heights_.ny, aspect_, inverse_, share);
}

void PeriodicElements::set_diagonal(double diagonal) {
    diagonal_ = diagonal / (rms_ / pressure_unit_);
    closing_.reset();
}

int PeriodicElements::threads() const { return heights_.nx >= kThreads / heights_.ny ? 0 : 1; }

PeriodicPixels<double>& PeriodicElements::fine() {
    if (!fine_)
        fine_ = std::make_unique<PeriodicPixels<double>>(heights_.nx, heights_.ny, 1, aspect_,
                                                         share_of_modes(substrate_, heights_.dx),
                                                         &transformed_);
    return *fine_;
}

std::vector<double> PeriodicElements::coarse_heights() const {
    const int nx = heights_.nx / 2, ny = (heights_.ny + 1) / 2;
    std::vector<double> heights = zeros_on_huge_pages<double>(at(nx) * at(ny));
    parallel_for(ny, kRows, threads(), [&](int j) {
        const int low = 2 * j, high = std::min(low + 1, heights_.ny - 1);
        for (int i = 0; i < nx; ++i)
            heights[at(j) * at(nx) + at(i)] =
                0.25 * (height(low, 2 * i) + height(low, 2 * i + 1) + height(high, 2 * i) +
                        height(high, 2 * i + 1));
    });
    return heights;
}

void PeriodicElements::start(const PeriodicElements& coarse) {
    const auto pressed = coarse.pressed_by_row();
    for (int j = 0; j < heights_.ny; ++j)
        rows_[at(j) + 1] = rows_[at(j)] + 2 * (pressed[at(j / 2) + 1] - pressed[at(j / 2)]);
    column_.resize(rows_.back());
    p_.resize(rows_.back());
    z_.resize(rows_.back());
    parallel_for(heights_.ny, kRows, threads(), [&](int j) {
        std::size_t next = rows_[at(j)];
        for (std::size_t k = coarse.rows_[at(j / 2)]; k < coarse.rows_[at(j / 2) + 1]; ++k) {
            if (!(coarse.p_[k] > 0)) continue;
            for (int i : {2 * coarse.column_[k], 2 * coarse.column_[k] + 1}) {
                column_[next] = i;
                p_[next] = coarse.p_[k];
                z_[next++] = height(j, i);
            }
        }
    });
}

// The numbers of pixels under pressure in the rows before each.
std::vector<std::size_t> PeriodicElements::pressed_by_row() const {
    std::vector<std::size_t> before(at(heights_.ny) + 1, 0);
    parallel_for(heights_.ny, kRows, threads(), [&](int j) {
        for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k)
            before[at(j) + 1] += p_[k] > 0 ? 1 : 0;
    });
    std::partial_sum(before.begin(), before.end(), before.begin());
    return before;
}

void PeriodicElements::start(Given given) {
    column_.clear();
    p_.clear();
    z_.clear();
    for (int j = 0; j < heights_.ny; ++j) {
        rows_[at(j)] = p_.size();
        for (int i = 0; i < heights_.nx; ++i) {
            const double overlap = given.is_pressure ? 1 : height(j, i) - given.value;
            if (!(overlap > 0)) continue;
            column_.push_back(i);
            z_.push_back(height(j, i));
            p_.push_back(given.is_pressure ? given.value : std::sqrt(overlap));
        }
    }
    rows_.back() = p_.size();
    if (given.is_pressure || p_.empty()) return;
    // Scales the pressures to the smallest energy.
    given_sum_.reset();
    Z0_ = given.value;
    evaluate(false);
    double overlap = 0, energy = 0;
    for (std::size_t k = 0; k < p_.size(); ++k) {
        const double g0 = p_[k] * p_[k];
        overlap += p_[k] * g0;
        energy += p_[k] * (w_[k] + g0);
    }
    for (double& p : p_) p = std::min(p * overlap / energy, highest_);
}

bool PeriodicElements::bare() const {
    return std::none_of(p_.begin(), p_.end(), [](double p) { return p > 0; });
}

std::vector<Pixel> PeriodicElements::set() const {
    std::vector<Pixel> pixels;
    for (int j = 0; j < heights_.ny; ++j)
        for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k)
            pixels.push_back({column_[k], j});
    return pixels;
}

template <class Real, class T>
void PeriodicElements::multiply_by(PeriodicPixels<Real>& pixels, const Array<T>& x, Array<T>& Kx) {
    ++products_;
    Kx.resize(x.size());
    pixels.apply(
        [&](int j, Real* row) {
            std::fill_n(row, heights_.nx, Real(0));
            for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k)
                row[column_[k]] = static_cast<Real>(x[k]);
        },
        [&](int j, const Real* row) {
            for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k)
                Kx[k] = static_cast<T>(unit_ * static_cast<double>(row[column_[k]]));
        });
}

void PeriodicElements::multiply(const Array<double>& x, Array<double>& Kx, bool exact) {
    exact_ = exact;
    if (exact)
        multiply_by(fine(), x, Kx);
    else
        multiply_by(inner_, x, Kx);
}

// Also collects the penetrating pixels for renew().
double PeriodicElements::outside() {
    outside_.resize(at(heights_.ny));
    return sum_in_order(heights_.ny, kRows, threads(), [&](int j) {
        const float* const inner = exact_ ? nullptr : inner_.row(j);
        const double* const exact = exact_ ? fine_->row(j) : nullptr;
        std::vector<Penetration>& found = outside_[at(j)];
        found.clear();
        double part = 0;
        int i = 0;
        for (std::size_t k = rows_[at(j)]; k <= rows_[at(j) + 1]; ++k, ++i) {
            const int upto = k < rows_[at(j) + 1] ? column_[k] : heights_.nx;
            for (; i < upto; ++i) {
                const double w =
                    unit_ * (exact ? exact[i] : static_cast<double>(inner[i])) - height(j, i) + Z0_;
                if (w < 0) {
                    part += w * w;
                    found.push_back({i, w});
                }
            }
        }
        return part;
    });
}

// What clipping adds to a block of pixels is taken from the others there, in proportion, so that
// the mean pressure of the block remains, and with it the long waves of the deflection. Otherwise
// every change of the set disturbs the waves that take most products, the more of them the wider
// their range. The products hardly depend on the side of the blocks (4 to 32 pixels).
void PeriodicElements::clip() {
    const int blocks = (heights_.nx + kBlock - 1) / kBlock;
    parallel_for((heights_.ny + kBlock - 1) / kBlock, 1, threads(), [&](int J) {
        // Of each block: what was added, and the pressures between the bounds.
        std::vector<double> added(at(blocks), 0.0), room(at(blocks), 0.0);
        const std::size_t first = rows_[at(J * kBlock)],
                          end = rows_[at(std::min((J + 1) * kBlock, heights_.ny))];
        for (std::size_t k = first; k < end; ++k) {
            const std::size_t b = at(column_[k] / kBlock);
            const double inside = std::clamp(p_[k], 0.0, highest_);
            added[b] += inside - p_[k];
            room[b] += inside < highest_ ? inside : 0.0;
            p_[k] = inside;
        }
        for (const auto b : indices(room))
            room[b] = added[b] > 0 && added[b] < room[b] ? 1 - added[b] / room[b] : 1.0;
        for (std::size_t k = first; k < end; ++k)
            if (p_[k] < highest_) p_[k] *= room[at(column_[k] / kBlock)];
    });
}

// Renews the set: pixels under pressure, and penetrating pixels without pressure. Those outside the
// set were collected by outside().
void PeriodicElements::renew() {
    const auto belongs = [&](std::size_t k) { return w_[k] < 0 || p_[k] > 0; };
    std::vector<std::size_t> rows(at(heights_.ny) + 1, 0);
    parallel_for(heights_.ny, kRows, threads(), [&](int j) {
        rows[at(j) + 1] = outside_[at(j)].size();
        for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k) rows[at(j) + 1] += belongs(k);
    });
    for (int j = 0; j < heights_.ny; ++j) rows[at(j) + 1] += rows[at(j)];
    next_column_.resize(rows.back());
    for (auto* v : {&before_p_, &before_w_}) v->resize(rows.back());
    parallel_for(heights_.ny, kRows, threads(), [&](int j) {
        std::size_t next = rows[at(j)];
        const auto add = [&](std::int32_t i, double p, double w) {
            next_column_[next] = i;
            before_p_[next] = p;
            before_w_[next++] = w;
        };
        auto other = outside_[at(j)].begin();
        const auto end = outside_[at(j)].end();
        for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k) {
            for (; other != end && other->column < column_[k]; ++other)
                add(other->column, 0, other->w);
            if (belongs(k)) add(column_[k], p_[k], w_[k]);
        }
        for (; other != end; ++other) add(other->column, 0, other->w);
    });
    rows_ = std::move(rows);
    column_.swap(next_column_);
    p_.swap(before_p_);
    w_.swap(before_w_);
    z_.resize(p_.size());
    parallel_for(heights_.ny, kRows, threads(), [&](int j) {
        for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k) z_[k] = height(j, column_[k]);
    });
}

// Products inside a round need not be accurate, because the next round starts from an accurate one.
void PeriodicElements::multiply_roughly(const Array<float>& x, Array<float>& Kx) {
    if (!split_ || x.size() > at(heights_.nx) * at(heights_.ny) / kFew)
        return multiply_by(inner_, x, Kx);
    split_->multiply(plane_, {rows_, column_}, x, Kx, threads());
    each([&](std::size_t k) { Kx[k] *= static_cast<float>(unit_); });
}

// y = K^-1, truncated to some pixels and with a correction for the farther ones, times r over the
// free pixels.
void PeriodicElements::precondition(const Array<float>& r, Array<float>& y) {
    plane_.convolve(inverse_, {rows_, column_}, r.data(), y.data(), threads());
    correct(r, y);
}

void PeriodicElements::precondition_ones(Array<float>& y) {
    residual_.assign(free_.begin(), free_.end());
    y = ones_;
    correct(residual_, y);
}

// Corrects y, the truncated K^-1 times r.
void PeriodicElements::correct(const Array<float>& r, Array<float>& y) {
    if (far_is_set_) far_->subtract({rows_, column_}, r.data(), y.data(), threads());
    const double product = sum_with<double>([&](double& part, std::size_t k) {
        if (!free_[k]) y[k] = 0;
        part += static_cast<double>(r[k]) * static_cast<double>(y[k]);
    });
    if (!far_is_set_ || product > 0) return;
    far_is_set_ = false;  // the correction is not proved to be positive definite
    precondition(r, y);
}

void PeriodicElements::freed() {
    if (inverse_of_ != diagonal_) prepare_inverse();
    far_is_set_ = far_->exists();
    residual_.assign(free_.begin(), free_.end());
    ones_.resize(free_.size());
    plane_.convolve(inverse_, {rows_, column_}, residual_.data(), ones_.data(), threads());
    if (far_is_set_) far_->set({rows_, column_}, ones_, residual_, threads());
}

bool PeriodicElements::judge_exactly(bool exact, double residual, int) {
    return exact || residual < kSingle;
}

ElementsOutcome PeriodicElements::solve(Given given, double tolerance, int most_iterations,
                                        bool finest) {
    bool started = false;
    const bool closed = finest && given.is_pressure && given.value >= closing_pressure();
    const bool row = heights_.ny == 1;
    if (!closed && heights_.nx % 2 == 0 && (row || heights_.ny % 2 == 0) &&
        std::min(heights_.nx, row ? heights_.nx : heights_.ny) >= 2 * kShortest) {
        // The memory of the coarser grid is free again before this one is solved.
        const std::vector<double> heights = coarse_heights();
        const auto coarse = std::unique_ptr<PeriodicElements>(new PeriodicElements(*this, heights));
        coarse->solve(given, kCoarseError, most_iterations, false);
        start(*coarse);
        started = !bare();
    }
    if (!started) start(given);
    const long before = products_;
    given_sum_.reset();
    if (given.is_pressure)
        given_sum_ = given.value * points();
    else
        Z0_ = given.value;
    ElementsOutcome outcome =
        closed ? flatten(tolerance) : iterate(tolerance, most_iterations, finest);
    outcome.products = products_ - before;
    if (!finest) return outcome;
    const auto pressed = pressed_by_row();
    pixels_.resize(pressed.back());
    pressures_.resize(pressed.back());
    parallel_for(heights_.ny, kRows, threads(), [&](int j) {
        std::size_t next = pressed[at(j)];
        for (std::size_t k = rows_[at(j)]; k < rows_[at(j) + 1]; ++k) {
            if (!(p_[k] > 0)) continue;
            pixels_[next] = {column_[k], j};
            pressures_[next++] = p_[k] >= highest_ ? highest_pressure_ : p_[k] * pressure_unit_;
        }
    });
    return outcome;
}

template <class F>
void PeriodicElements::flattening(F&& take) {
    fine().apply(
        [&](int j, double* row) {
            for (int i = 0; i < heights_.nx; ++i) row[i] = height(j, i);
        },
        [&](int j, const double* row) { take(j, row); }, PeriodicPixels<double>::Answer::pressure);
}

double PeriodicElements::closing_pressure() {
    if (closing_) return *closing_;
    if (diagonal_ > 0 || highest_ < kInfinity) return kInfinity;
    std::vector<double> least(at(heights_.ny));
    flattening([&](int j, const double* row) {
        least[at(j)] = *std::min_element(row, row + heights_.nx);
    });
    closing_ = 0 - *std::min_element(least.begin(), least.end()) / unit_;
    return *closing_;
}

// In full contact the pressures are the mean one and those that flatten the surface.
ElementsOutcome PeriodicElements::flatten(double tolerance) {
    flattening([&](int j, const double* row) {
        for (int i = 0; i < heights_.nx; ++i)
            p_[rows_[at(j)] + at(i)] = std::max(p_[rows_[at(j)] + at(i)] + row[i] / unit_, 0.0);
    });
    ElementsOutcome outcome;
    evaluate(true);
    outcome.residual = error();
    outcome.certificate = certificate();
    outcome.converged = outcome.residual <= tolerance;
    return outcome;
}

std::vector<std::pair<Pixel, double>> PeriodicElements::press_out() {
    const std::vector<Pixel> all = set();
    std::vector<std::pair<Pixel, double>> lowered;
    for (const auto& [k, depth] : BoundedSolver::press_out())
        lowered.emplace_back(all[at(k)], depth * rms_);
    return lowered;
}

ElementsOutcome PeriodicElements::press(double mean_pressure, double tolerance,
                                        int most_iterations) {
    return solve({true, mean_pressure / pressure_unit_}, tolerance, most_iterations, true);
}

ElementsOutcome PeriodicElements::approach(double Z0, double tolerance, int most_iterations) {
    if (!(Z0 > closed()))
        throw Error(Failure::bad_input,
                    format("a separation of %.9g is below that of full contact, %.9g", Z0,
                           std::abs(mean_) > kRounding * rms_ ? mean_ : 0.0));
    return solve({false, (Z0 - zero_) / rms_}, tolerance, most_iterations, true);
}

double PeriodicElements::closed() const {
    return highest_ < kInfinity || diagonal_ > 0 ? -kInfinity : mean_ + kRounding * rms_;
}

std::vector<double> PeriodicElements::deflections(const std::vector<Pixel>& pixels,
                                                  const std::vector<double>& p) {
    const std::size_t nx = at(heights_.nx);
    std::vector<double> plane(nx * at(heights_.ny), 0.0);
    for (std::size_t k = 0; k < p.size(); ++k)
        plane[at(pixels[k].y) * nx + at(pixels[k].x)] = p[k] / pressure_unit_;
    fine().apply([&](int j, double* row) { std::copy_n(plane.data() + at(j) * nx, nx, row); },
                 [&](int j, const double* row) {
                     for (std::size_t i = 0; i < nx; ++i)
                         plane[at(j) * nx + i] = unit_ * row[i] * rms_;
                 });
    return plane;
}

double PeriodicElements::stiffness(bool back) {
    // The answer's error is of second order in these.
    constexpr double tolerance = 5e-4, reduction = 2e-2;
    constexpr int rounds = 20, steps = 60;
    return BoundedSolver::stiffness(back, tolerance, rounds, steps, reduction) / points() *
           (pressure_unit_ / rms_);
}

void PeriodicElements::keep(ArchiveWriter& to) const {
    const BoundedSolver<float>& solved = *this;
    archive(to, solved);
    to(column_);
}

void PeriodicElements::recall(ArchiveReader& from) {
    BoundedSolver<float>& solved = *this;
    archive(from, solved);
    from(column_);
    const auto inside = [&](std::int32_t i) { return i >= 0 && i < heights_.nx; };
    if (!fits(column_.size()) || rows_.size() != at(heights_.ny) + 1 ||
        !std::ranges::all_of(column_, inside))
        bad_input("the state does not belong to a contact of this surface");
}

double PeriodicElements::energy() const {
    return BoundedSolver::energy() / points() * (pressure_unit_ * rms_);
}

}  // namespace rsc
