#include "rough/synthesis.hpp"

#include "error.hpp"
#include "rough/modes.hpp"
#include "rough/parallel.hpp"
#include "rough/reshape.hpp"

namespace rsc {
namespace {

fftw_complex* fftw(std::complex<double>* p) { return reinterpret_cast<fftw_complex*>(p); }
fftw_complex* fftw(double* p) { return reinterpret_cast<fftw_complex*>(p); }

using Buffer = std::unique_ptr<double[], HeightMap::Free>;

HeightMap empty_map(double L, int n) {
    HeightMap map;
    map.allocate(n, n, (n + 7) / 8 * 8 + 8);  // rows aligned to 64 bytes, and not a power of two apart
    map.dx = map.dy = L / n;
    map.periodic = true;
    return map;
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

RowSource::RowSource(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed, std::int64_t realization, int threads,
                     double difference_step) {
    validate(spectrum);
    if (n < 2 || n % 2 != 0) throw Error(Failure::bad_input, "surface: n must be even and at least 2, not " + std::to_string(n));
    n_ = n;
    if (!(difference_step > 0)) difference_step = spectrum.L / n;
    threads = std::max(threads, 1);
    if (made_as_transpose(spectrum)) {
        transpose(spectrum, normalise, seed, realization, threads, difference_step);
        return;
    }
    const Band limits = band(spectrum);
    columns_ = limits.highest_kx + 1;
    // Only the real part of a mode at n/2 is visible on the grid, so only the Gaussian modes (n/2, 0) and (0, n/2) are allowed there.
    const bool tilted = limits.stretched.xy != 0 || !spectrum.gaussian();
    if (const int most = std::max(limits.highest_kx, limits.highest_ky); most > n / 2 || (tilted && most == n / 2))
        throw Error(Failure::bad_input, "surface: n = " + std::to_string(n) + " points cannot represent waves of L/lambda = " +
                                            std::to_string(most) + ": n must be at least " + std::to_string(2 * most + (tilted ? 2 : 0)));
    column_stride_ = (n + 3) / 4 * 4 + 4;  // multiples of 64 bytes, and columns not a power of two apart
    row_stride_ = (n + 2 + 7) / 8 * 8 + 8;
    columns_data_.reset(allocate_doubles(2 * static_cast<std::size_t>(columns_) * static_cast<std::size_t>(column_stride_),
                                         "the modes of a synthetic surface"));
    draw(spectrum, normalise, seed, realization, threads, difference_step);
}

void RowSource::transpose(const Spectrum& spectrum, Normalise normalise, std::int64_t seed, std::int64_t realization, int threads,
                          double difference_step) {
    RowSource other(transposed(spectrum), n_, normalise, seed, realization, threads, difference_step);
    sampled_ = other.sampled_;
    differences_ = other.differences_;
    sampled_.tensor = other.sampled_.tensor.transposed();
    whole_ = empty_map(spectrum.L, n_);
    std::vector<Scratch> scratch;
    std::vector<Buffer> block;
    // So many rows at once that what they write to a row of the other surface is whole lines of the cache.
    constexpr int wide = 2 * kBlock;
    const std::ptrdiff_t stride = (n_ + 7) / 8 * 8 + 8;
    for (int t = 0; t < threads; ++t) {
        scratch.emplace_back(other);
        block.emplace_back(allocate_doubles(static_cast<std::size_t>(wide * stride), "rows of a synthetic surface"));
    }
    const int blocks = (n_ + wide - 1) / wide;
    parallel_for(blocks, 1, threads, [&](int b, std::size_t worker) {
        stopping_point();
        double* const rows = block[worker].get();
        const int first = b * wide, count = std::min(wide, n_ - first);
        other.rows(first, count, rows, stride, scratch[worker]);
        for (int i = 0; i < n_; i += 2) {  // pairs of pairs: n is even
            double *const to = whole_.row(i) + first, *const next = to + whole_.stride;
            // The stride is too large for the hardware prefetcher.
            const double* const soon = whole_.row(std::min(i + 8, n_ - 2)) + first;
            for (int r = 0; r < count; r += 8) __builtin_prefetch(soon + r, 1), __builtin_prefetch(soon + whole_.stride + r, 1);
            for (int r = 0; r < count; r += 2) {
                const double *const from = rows + r * stride + i, *const below = from + stride;
                const double a = from[0], b = below[0], c = from[1], d = below[1];
                to[r] = a, to[r + 1] = b, next[r] = c, next[r + 1] = d;
            }
        }
    });
}

void RowSource::draw(const Spectrum& spectrum, Normalise normalise, std::int64_t seed, std::int64_t realization, int threads,
                     double difference_step) {
    const NoiseKey key{seed, realization};
    auto* const store = reinterpret_cast<std::complex<double>*>(columns_data_.get());
    const auto doubles = static_cast<std::size_t>(2 * column_stride_);
    std::vector<Buffer> drawn(static_cast<std::size_t>(threads));
    for (auto& buffer : drawn) buffer.reset(allocate_doubles(doubles, "a column of a synthetic surface"));
    Buffer row(allocate_doubles(2 * static_cast<std::size_t>(row_stride_), "a row of a synthetic surface"));
    FftwPlan column_plan;
    {
        const auto lock = fftw_planning();
        column_plan.reset(fftw_plan_dft_1d(n_, fftw(drawn[0].get()), fftw(store), FFTW_BACKWARD, FFTW_ESTIMATE));
        row_plan_.reset(fftw_plan_dft_c2r_1d(n_, fftw(row.get()), row.get() + row_stride_, FFTW_ESTIMATE));
    }
    if (!column_plan || !row_plan_) throw Error(Failure::internal, "surface: FFTW made no plan for n = " + std::to_string(n_));

    // The sums go by column and are added in order, whichever thread drew them.
    std::vector<ModeSums> sums(static_cast<std::size_t>(columns_));
    auto& plan = *column_plan;
    const Band limits = band(spectrum);
    const Differences differences(std::max(limits.highest_kx, limits.highest_ky), difference_step / spectrum.L);
    parallel_for(columns_, 1, threads, [&](int kx, std::size_t worker) {
        stopping_point();
        auto* const column = reinterpret_cast<std::complex<double>*>(drawn[worker].get());
        auto* const stored = store + kx * column_stride_;
        sums[static_cast<std::size_t>(kx)] = draw_column(spectrum, key, kx, n_, differences, spectrum.gaussian() ? column : stored);
        if (spectrum.gaussian()) fftw_execute_dft(&plan, fftw(column), fftw(stored));
    });
    HeightShape shape;
    if (!spectrum.gaussian()) {
        shape = reshape_heights(spectrum, store, column_stride_, n_);
        parallel_for(columns_, 1, threads, [&](int kx, std::size_t worker) {
            stopping_point();
            auto* const column = reinterpret_cast<std::complex<double>*>(drawn[worker].get());
            std::copy_n(store + kx * column_stride_, n_, column);
            fftw_execute_dft(&plan, fftw(column), fftw(store + kx * column_stride_));
        });
    }
    ModeSums total;
    for (const ModeSums& s : sums) total.add(s);
    const double mean_square = normalise == Normalise::sample ? total.grid : total.expected;
    factor_ = spectrum.sigma / std::sqrt(mean_square);
    const double step = 2.0 * std::numbers::pi / spectrum.L;
    const double f2 = factor_ * factor_, k2 = step * step;
    const double f2k2 = f2 * k2, f2k4 = f2 * k2 * k2;
    const MomentTensor& t = total.tensor;
    sampled_ = {f2 * total.m0,
                f2 * k2 * total.m2,
                f2 * k2 * k2 * total.m4,
                {f2k2 * t.m20, f2k2 * t.m11, f2k2 * t.m02, f2k4 * t.m40, f2k4 * t.m31, f2k4 * t.m22, f2k4 * t.m13, f2k4 * t.m04},
                shape};
    const double h2 = difference_step * difference_step;
    differences_ = {f2 * total.grid, f2 * total.m2_differences / h2, f2 * total.m4_differences / (h2 * h2), {}, {}};
}

RowSource::Scratch::Scratch(const RowSource& source)
    : coefficients_(allocate_doubles(static_cast<std::size_t>(kBlock * source.row_stride_), "rows of a synthetic surface")) {}

void RowSource::rows(int j, int count, double* out, std::ptrdiff_t stride, Scratch& scratch) const {
    const auto* const store = reinterpret_cast<const std::complex<double>*>(columns_data_.get());
    double* const coefficients = scratch.coefficients_.get();
    const double factor = factor_;
    auto& plan = *row_plan_;
    while (count > 0) {
        j = (j % n_ + n_) % n_;
        const int block = std::min({count, kBlock, n_ - j});
        for (int kx = 0; kx < columns_; ++kx) {
            const auto* const from = reinterpret_cast<const double*>(store + kx * column_stride_ + j);
            double* const to = coefficients + 2 * kx;
            for (int r = 0; r < block; ++r) {
                to[r * row_stride_] = factor * from[2 * r];
                to[r * row_stride_ + 1] = factor * from[2 * r + 1];
            }
        }
        for (int r = 0; r < block; ++r) {
            double* const row = coefficients + r * row_stride_;
            std::fill(row + 2 * columns_, row + n_ + 2, 0.0);  // no modes here; the previous transform has overwritten the zeros
            fftw_execute_dft_c2r(&plan, fftw(row), out + r * stride);
        }
        j += block;
        count -= block;
        out += block * stride;
    }
}

HeightMap synthesize(const Spectrum& spectrum, int n, Normalise normalise, std::int64_t seed, std::int64_t realization, Moments* sampled,
                     int threads) {
    threads = std::max(threads, 1);
    RowSource source(spectrum, n, normalise, seed, realization, threads);
    if (sampled) *sampled = source.sampled();
    if (source.whole()) return source.take();
    HeightMap map = empty_map(spectrum.L, n);
    std::vector<RowSource::Scratch> scratch;
    for (int t = 0; t < threads; ++t) scratch.emplace_back(source);
    constexpr int few = 64;  // rows of a piece
    parallel_for((n + few - 1) / few, 1, threads, [&](int piece, std::size_t worker) {
        stopping_point();
        const int j = piece * few;
        source.rows(j, std::min(few, n - j), map.row(j), map.stride, scratch[worker]);
    });
    return map;
}

}  // namespace rsc
