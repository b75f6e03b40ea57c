#include "surface/synthesis.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "surface/height_distribution.hpp"
#include "surface/modes.hpp"

namespace rsc {
namespace {

fftw_complex* fftw(std::complex<double>* p) { return reinterpret_cast<fftw_complex*>(p); }
fftw_complex* fftw(double* p) { return reinterpret_cast<fftw_complex*>(p); }

using Buffer = std::unique_ptr<double[], HeightMap::Free>;

// Distance of rows: aligned to 64 bytes, and not a power of two apart.
std::ptrdiff_t row_distance(int n) { return (n + 7) / 8 * 8 + 8; }

HeightMap empty_map(double L, int n, bool zeros) {
    HeightMap map;
    map.allocate(n, n, row_distance(n), zeros);
    map.dx = map.dy = L / n;
    map.periodic = true;
    return map;
}

// Copies rows of n numbers, `stride` apart, to the first `rows` places of n rows of `to`, in square
// tiles, whose lines remain in the cache.
void transpose(const double* from, std::ptrdiff_t stride, int rows, int n, double* to) {
    constexpr int tile = 8;
    for (int i0 = 0; i0 < n; i0 += tile)
        for (int r0 = 0; r0 < rows; r0 += tile)
            for (int i = i0; i < std::min(i0 + tile, n); ++i)
                for (int r = r0; r < std::min(r0 + tile, rows); ++r)
                    to[i * stride + r] = from[r * stride + i];
}

// Columns are too far apart for the hardware prefetcher: what a row takes from a column is
// requested kAhead columns before.
constexpr int kAhead = 6;
void prefetch(const double* p, int count) {
    for (int i = 0; i < count; i += 8) __builtin_prefetch(p + i);
}

}  // namespace

bool made_as_transpose(const Spectrum& spectrum) {
    const double angle = spectrum.direction - 180 * std::floor(spectrum.direction / 180);
    return spectrum.aspect != 1 && angle > 45 && angle < 135;
}

Spectrum transposed(const Spectrum& spectrum) {
    Spectrum mirrored = spectrum;
    mirrored.direction = 90 - spectrum.direction;
    return mirrored;
}

RowSource::RowSource(const Spectrum& requested, int n, Normalise normalise, std::int64_t seed,
                     std::int64_t realization, int threads, double difference_step)
    : n_(n), L_(requested.L), exchanged_(made_as_transpose(requested)) {
    validate(requested);
    if (n < 2 || n % 2 != 0)
        throw Error(Failure::bad_input,
                    "surface: n must be even and at least 2, not " + std::to_string(n));
    if (!(difference_step > 0)) difference_step = L_ / n;
    const Spectrum spectrum = exchanged_ ? transposed(requested) : requested;
    const Band limits = band(spectrum);
    columns_ = limits.highest_kx + 1;
    // Only the real part of a mode at n/2 is visible on the grid, so only the Gaussian modes (n/2,
    // 0) and (0, n/2) are allowed there.
    const bool tilted = limits.stretched.xy != 0 || !spectrum.gaussian();
    if (const int most = std::max(limits.highest_kx, limits.highest_ky);
        most > n / 2 || (tilted && most == n / 2))
        throw Error(Failure::bad_input,
                    "surface: n = " + std::to_string(n) +
                        " points cannot represent waves of L/lambda = " + std::to_string(most) +
                        ": n must be at least " + std::to_string(2 * most + (tilted ? 2 : 0)));
    // multiples of 64 bytes, and columns not a power of two apart
    column_stride_ = (n + 3) / 4 * 4 + 4;
    row_stride_ = (n + 2 + 7) / 8 * 8 + 8;
    columns_data_.reset(allocate_doubles(2 * at(columns_) * at(column_stride_),
                                         "the modes of a synthetic surface"));
    draw(spectrum, normalise, seed, realization, std::max(threads, 1), difference_step);
    if (exchanged_) sampled_.tensor = sampled_.tensor.transposed();
}

// The transform of a column, from `column` to `stored`. Also sets that of a row.
FftwPlan RowSource::make_plans(double* column, double* row, std::complex<double>* stored) {
    FftwPlan column_plan;
    {
        const auto lock = fftw_planning();
        column_plan.reset(
            fftw_plan_dft_1d(n_, fftw(column), fftw(stored), FFTW_BACKWARD, FFTW_ESTIMATE));
        row_plan_.reset(fftw_plan_dft_c2r_1d(n_, fftw(row), row + row_stride_, FFTW_ESTIMATE));
    }
    if (!column_plan || !row_plan_)
        throw Error(Failure::internal, "surface: FFTW made no plan for n = " + std::to_string(n_));
    return column_plan;
}

void RowSource::draw(const Spectrum& spectrum, Normalise normalise, std::int64_t seed,
                     std::int64_t realization, int threads, double difference_step) {
    const NoiseKey key{seed, realization};
    auto* const store = reinterpret_cast<std::complex<double>*>(columns_data_.get());
    const auto doubles = at(2 * column_stride_);
    std::vector<Buffer> drawn(at(threads));
    for (auto& buffer : drawn)
        buffer.reset(allocate_doubles(doubles, "a column of a synthetic surface"));
    const Buffer row(allocate_doubles(2 * at(row_stride_), "a row of a synthetic surface"));
    const FftwPlan column_plan = make_plans(drawn[0].get(), row.get(), store);
    auto& plan = *column_plan;

    // The sums go by column and are added in order, whichever thread drew them.
    const Band limits = band(spectrum);
    std::vector<ModeSums> sums(at(limits.highest_kx) + 1);
    // A column is complete when it is drawn.
    const bool at_once = spectrum.gaussian();
    const Differences differences(std::max(limits.highest_kx, limits.highest_ky),
                                  difference_step / spectrum.L);
    parallel_for(limits.highest_kx + 1, 1, threads, [&](int kx, std::size_t worker) {
        stopping_point();
        auto* const column = reinterpret_cast<std::complex<double>*>(drawn[worker].get());
        auto* const stored = store + kx * column_stride_;
        sums[at(kx)] =
            draw_column(spectrum, key, kx, n_, differences, spectrum.gaussian() ? column : stored);
        if (at_once) fftw_execute_dft(&plan, fftw(column), fftw(stored));
    });
    HeightShape shape;
    if (!spectrum.gaussian()) shape = reshape_heights(spectrum, store, column_stride_, n_);
    if (!at_once) {
        parallel_for(columns_, 1, threads, [&](int kx, std::size_t worker) {
            stopping_point();
            auto* const column = reinterpret_cast<std::complex<double>*>(drawn[worker].get());
            std::copy_n(store + kx * column_stride_, n_, column);
            fftw_execute_dft(&plan, fftw(column), fftw(store + kx * column_stride_));
        });
    }
    ModeSums total;
    for (const ModeSums& s : sums) total.add(s);
    scale_moments(spectrum, normalise, total, shape, difference_step);
}

// Sets the factor of the heights and their moments.
void RowSource::scale_moments(const Spectrum& spectrum, Normalise normalise, const ModeSums& total,
                              const HeightShape& shape, double difference_step) {
    const double mean_square = normalise == Normalise::sample ? total.grid : total.expected;
    factor_ = spectrum.sigma / std::sqrt(mean_square);
    const double step = 2.0 * pi / spectrum.L;
    const double f2 = factor_ * factor_, k2 = step * step;
    const double f2k2 = f2 * k2, f2k4 = f2 * k2 * k2;
    const MomentTensor& t = total.tensor;
    sampled_ = {f2 * total.m0,
                f2 * k2 * total.m2,
                f2 * k2 * k2 * total.m4,
                {f2k2 * t.m20, f2k2 * t.m11, f2k2 * t.m02, f2k4 * t.m40, f2k4 * t.m31, f2k4 * t.m22,
                 f2k4 * t.m13, f2k4 * t.m04},
                shape};
    const double h2 = difference_step * difference_step;
    differences_ = {f2 * total.grid,
                    f2 * total.m2_differences / h2,
                    f2 * total.m4_differences / (h2 * h2),
                    {},
                    {}};
}

RowSource::Scratch::Scratch(const RowSource& source)
    : coefficients_(
          allocate_doubles(at(kBlock * source.row_stride_), "rows of a synthetic surface")) {}

// Rows j ... j + count - 1, count at most kBlock.
void RowSource::make_rows(int j, int count, double* out, std::ptrdiff_t stride,
                          double* coefficients) const {
    const auto* const store = reinterpret_cast<const std::complex<double>*>(columns_data_.get());
    const double factor = factor_;
    for (const int kx : indices(columns_)) {
        const auto* const from = reinterpret_cast<const double*>(store + kx * column_stride_ + j);
        prefetch(from + std::min(kAhead, columns_ - 1 - kx) * 2 * column_stride_, 2 * count);
        double* const to = coefficients + 2 * kx;
        for (const int r : indices(count)) {
            to[r * row_stride_] = factor * from[2 * r];
            to[r * row_stride_ + 1] = factor * from[2 * r + 1];
        }
    }
    for (const int r : indices(count)) {
        double* const row = coefficients + r * row_stride_;
        std::fill(row + 2 * columns_, row + n_ + 2,
                  0.0);  // no modes here; the previous transform has overwritten the zeros
        fftw_execute_dft_c2r(row_plan_.get(), fftw(row), out + r * stride);
    }
}

void RowSource::rows(int j, int count, double* out, std::ptrdiff_t stride, Scratch& scratch) const {
    while (count > 0) {
        j = wrapped(j, n_);
        const int block = std::min({count, kBlock, n_ - j});
        make_rows(j, block, out, stride, scratch.coefficients_.get());
        j += block;
        count -= block;
        out += block * stride;
    }
}

HeightMap RowSource::all(int threads, const Filter& filter) const {
    constexpr int piece = 64;  // a page of memory is taken if one of its pieces is requested
    const bool direct = !exchanged_ && !filter;
    HeightMap map = empty_map(L_, n_, !exchanged_ && filter);
    // So many rows at once that what they write to a row of an exchanged surface is whole lines of
    // the cache.
    const int wide = direct ? 4 * kBlock : 2 * kBlock;
    const std::ptrdiff_t stride = map.stride;
    std::vector<Scratch> scratch;
    std::vector<Buffer> block;
    for (int t = 0; t < std::max(threads, 1); ++t) {
        scratch.emplace_back(*this);
        if (!direct)
            block.emplace_back(allocate_doubles(at(wide * stride), "rows of a synthetic surface"));
    }
    parallel_for((n_ + wide - 1) / wide, 1, std::max(threads, 1), [&](int b, std::size_t worker) {
        stopping_point();
        const int first = b * wide, count = std::min(wide, n_ - first);
        double* const made = direct ? map.row(first) : block[worker].get();
        rows(first, count, made, stride, scratch[worker]);
        if (!exchanged_ && filter)
            for (const int r : indices(count))
                for (int i = 0; i < n_; i += piece) {
                    const double* const z = made + r * stride + i;
                    if (const int points = std::min(piece, n_ - i); filter(first + r, i, points, z))
                        std::copy_n(z, points, map.row(first + r) + i);
                }
        else if (exchanged_)
            transpose(made, stride, count, n_, map.row(0) + first);
    });
    return map;
}

HeightMap synthesize(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed,
                     std::int64_t realization, Moments* sampled, int threads) {
    const RowSource source(spectrum, n, normalise, seed, realization, threads);
    if (sampled) *sampled = source.sampled();
    return source.all(threads);
}

}  // namespace rsc
