#include "surface/synthesis.hpp"

#include "base/dispatch.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "surface/height_distribution.hpp"
#include "surface/modes.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

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

// Four numbers, and their storage at places aligned to 16 bytes. A map of more than kCached heights
// is better written past the cache, which would read it first.
constexpr std::size_t kCached = 1200 * 1200;
using Four [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;
struct ToCache {
    static void store(double* to, const Four& v) { reinterpret_cast<Four&>(*to) = v; }
    static void end() {}
};
#if defined(__SSE2__)
struct PastCache {
    static void store(double* to, const Four& v) {
        _mm_stream_pd(to, __m128d{v[0], v[1]});
        _mm_stream_pd(to + 2, __m128d{v[2], v[3]});
    }
    static void end() { _mm_sfence(); }
};
#else
using PastCache = ToCache;
#endif

// Copies rows of n numbers, `stride` apart, to the first `rows` places of n rows of `to`.
template <class Target>
RSC_ALWAYS_INLINE void transpose_body(const double* from, std::ptrdiff_t stride, int rows, int n,
                                      double* to, std::ptrdiff_t distance) {
    const int rows4 = rows - rows % 4, n4 = n - n % 4;
    for (int i = 0; i < n4; i += 4) {
        double* const out = to + i * distance;
        if constexpr (std::is_same_v<Target, ToCache>) {
            // The distance is too large for the hardware prefetcher.
            const double* const soon = to + std::min(i + 4, n - 4) * distance;
            for (int k = 0; k < 4; ++k)
                for (int r = 0; r < rows; r += 8) __builtin_prefetch(soon + k * distance + r, 1);
        }
        for (int r = 0; r < rows4; r += 4) {
            const double* const in = from + r * stride + i;
            const Four &a = reinterpret_cast<const Four&>(in[0]),
                       &b = reinterpret_cast<const Four&>(in[stride]);
            const Four &c = reinterpret_cast<const Four&>(in[2 * stride]),
                       &d = reinterpret_cast<const Four&>(in[3 * stride]);
            const Four ab0 = __builtin_shufflevector(a, b, 0, 4, 2, 6),
                       ab1 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
            const Four cd0 = __builtin_shufflevector(c, d, 0, 4, 2, 6),
                       cd1 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
            double* const place = out + r;
            Target::store(place, __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5));
            Target::store(place + distance, __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5));
            Target::store(place + 2 * distance, __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7));
            Target::store(place + 3 * distance, __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7));
        }
    }
    for (int r = 0; r < rows; ++r)
        for (int i = r < rows4 ? n4 : 0; i < n; ++i) to[i * distance + r] = from[r * stride + i];
    Target::end();
}
RSC_DISPATCH(transpose_to_cache, transpose_body<ToCache>,
             (const double* from, std::ptrdiff_t stride, int rows, int n, double* to,
              std::ptrdiff_t distance),
             (from, stride, rows, n, to, distance))
RSC_DISPATCH(transpose_past_cache, transpose_body<PastCache>,
             (const double* from, std::ptrdiff_t stride, int rows, int n, double* to,
              std::ptrdiff_t distance),
             (from, stride, rows, n, to, distance))

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

RowSource::RowSource(const Spectrum& wanted, int n, Normalise normalise, std::int64_t seed,
                     std::int64_t realization, int threads, double difference_step)
    : n_(n), L_(wanted.L), exchanged_(made_as_transpose(wanted)) {
    validate(wanted);
    if (n < 2 || n % 2 != 0)
        throw Error(Failure::bad_input,
                    "surface: n must be even and at least 2, not " + std::to_string(n));
    if (!(difference_step > 0)) difference_step = L_ / n;
    const Spectrum spectrum = exchanged_ ? transposed(wanted) : wanted;
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
    column_stride_ =
        (n + 3) / 4 * 4 + 4;  // multiples of 64 bytes, and columns not a power of two apart
    row_stride_ = (n + 2 + 7) / 8 * 8 + 8;
    // For these sizes FFTW's complex transform takes less time than two real ones. The bits of
    // isotropic surfaces are kept.
    pairs_ = spectrum.aspect != 1 && n >= 64 && n <= 2048 && (n & (n - 1)) == 0;
    columns_data_.reset(allocate_doubles(
        2 * static_cast<std::size_t>(columns_) * static_cast<std::size_t>(column_stride_),
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
        // Real and imaginary parts are exchanged: FFTW knows only forward transforms of separate
        // parts.
        if (pairs_) {
            const fftw_iodim all{n_, 1, 1};
            double* const to = row + 2 * row_distance(n_);
            row_plan_.reset(fftw_plan_guru_split_dft(1, &all, 0, nullptr, row + row_distance(n_),
                                                     row, to + row_distance(n_), to,
                                                     FFTW_ESTIMATE));
        } else {
            row_plan_.reset(fftw_plan_dft_c2r_1d(n_, fftw(row), row + row_stride_, FFTW_ESTIMATE));
        }
    }
    if (!column_plan || !row_plan_)
        throw Error(Failure::internal, "surface: FFTW made no plan for n = " + std::to_string(n_));
    return column_plan;
}

void RowSource::draw(const Spectrum& spectrum, Normalise normalise, std::int64_t seed,
                     std::int64_t realization, int threads, double difference_step) {
    const NoiseKey key{seed, realization};
    auto* const store = reinterpret_cast<std::complex<double>*>(columns_data_.get());
    const auto doubles = static_cast<std::size_t>(2 * column_stride_);
    std::vector<Buffer> drawn(static_cast<std::size_t>(threads));
    for (auto& buffer : drawn)
        buffer.reset(allocate_doubles(doubles, "a column of a synthetic surface"));
    const Buffer row(allocate_doubles(4 * static_cast<std::size_t>(row_stride_),
                                      "a row of a synthetic surface"));
    const FftwPlan column_plan = make_plans(drawn[0].get(), row.get(), store);
    auto& plan = *column_plan;

    // The sums go by column and are added in order, whichever thread drew them.
    const Band limits = band(spectrum);
    std::vector<ModeSums> sums(static_cast<std::size_t>(limits.highest_kx) + 1);
    // A column is complete when it is drawn.
    const bool at_once = spectrum.gaussian();
    const Differences differences(std::max(limits.highest_kx, limits.highest_ky),
                                  difference_step / spectrum.L);
    parallel_for(limits.highest_kx + 1, 1, threads, [&](int kx, std::size_t worker) {
        stopping_point();
        auto* const column = reinterpret_cast<std::complex<double>*>(drawn[worker].get());
        auto* const stored = store + kx * column_stride_;
        sums[static_cast<std::size_t>(kx)] =
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
    const double step = 2.0 * std::numbers::pi / spectrum.L;
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
    : coefficients_(allocate_doubles(static_cast<std::size_t>((kBlock + 4) * source.row_stride_),
                                     "rows of a synthetic surface")) {}

// Rows j ... j + count - 1, count at most kBlock, by transforms of row 2i + sqrt(-1) row 2i + 1.
// parts: kBlock + 4 rows.
void RowSource::make_pairs(int j, int count, double* out, std::ptrdiff_t stride,
                           double* parts) const {
    const auto* const store = reinterpret_cast<const std::complex<double>*>(columns_data_.get());
    const std::ptrdiff_t apart = row_distance(n_);  // of the parts
    const int first = j - j % 2, rows = (j + count + 1) / 2 * 2 - first;
    const double factor = factor_;
    for (int kx = 0; kx < columns_; ++kx) {
        const auto* const from =
            reinterpret_cast<const double*>(store + kx * column_stride_ + first);
        prefetch(from + std::min(kAhead, columns_ - 1 - kx) * 2 * column_stride_, 2 * rows);
        // the coefficients of a row are its own mirror image here
        const bool real = kx == 0 || 2 * kx == n_;
        double *to = parts + kx, *mirror = parts + (real ? kx : n_ - kx);
        for (int r = 0; r < rows; r += 2, to += 2 * apart, mirror += 2 * apart) {
            const double a = factor * from[2 * r], b = real ? 0 : factor * from[2 * r + 1];
            const double c = factor * from[2 * r + 2], d = real ? 0 : factor * from[2 * r + 3];
            to[0] = a - d;
            to[apart] = b + c;
            mirror[0] = a + d;
            mirror[apart] = c - b;
        }
    }
    double* const spare = parts + rows * apart;  // for a row that is not wanted
    for (int r = 0; r < rows; r += 2) {
        double *const re = parts + r * apart, *const im = re + apart;
        if (const int none = n_ + 1 - 2 * columns_; none > 0) {
            std::fill_n(re + columns_, none, 0.0);
            std::fill_n(im + columns_, none, 0.0);
        }
        const int at = first + r - j;  // row of `out`
        const bool direct = at >= 0 && at + 1 < count && stride == apart;
        double* const to = direct ? out + at * stride : spare;
        fftw_execute_split_dft(row_plan_.get(), im, re, to + apart, to);
        if (direct) continue;
        if (at >= 0) std::copy_n(to, n_, out + at * stride);
        if (at + 1 < count) std::copy_n(to + apart, n_, out + (at + 1) * stride);
    }
}

// The same rows by a real transform of each.
void RowSource::make_rows(int j, int count, double* out, std::ptrdiff_t stride,
                          double* coefficients) const {
    const auto* const store = reinterpret_cast<const std::complex<double>*>(columns_data_.get());
    const double factor = factor_;
    for (int kx = 0; kx < columns_; ++kx) {
        const auto* const from = reinterpret_cast<const double*>(store + kx * column_stride_ + j);
        prefetch(from + std::min(kAhead, columns_ - 1 - kx) * 2 * column_stride_, 2 * count);
        double* const to = coefficients + 2 * kx;
        for (int r = 0; r < count; ++r) {
            to[r * row_stride_] = factor * from[2 * r];
            to[r * row_stride_ + 1] = factor * from[2 * r + 1];
        }
    }
    for (int r = 0; r < count; ++r) {
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
        (this->*(pairs_ ? &RowSource::make_pairs : &RowSource::make_rows))(
            j, block, out, stride, scratch.coefficients_.get());
        j += block;
        count -= block;
        out += block * stride;
    }
}

HeightMap RowSource::all(int threads, const Wanted& wanted) const {
    constexpr int piece = 64;  // a page of memory is taken if one of its pieces is wanted
    const bool direct = !exchanged_ && !wanted;
    HeightMap map = empty_map(L_, n_, !exchanged_ && wanted);
    // So many rows at once that what they write to a row of an exchanged surface is whole lines of
    // the cache.
    const int wide = direct ? 4 * kBlock : 2 * kBlock;
    const std::ptrdiff_t stride = map.stride;
    std::vector<Scratch> scratch;
    std::vector<Buffer> block;
    for (int t = 0; t < std::max(threads, 1); ++t) {
        scratch.emplace_back(*this);
        if (!direct)
            block.emplace_back(allocate_doubles(static_cast<std::size_t>(wide * stride),
                                                "rows of a synthetic surface"));
    }
    parallel_for((n_ + wide - 1) / wide, 1, std::max(threads, 1), [&](int b, std::size_t worker) {
        stopping_point();
        const int first = b * wide, count = std::min(wide, n_ - first);
        double* const made = direct ? map.row(first) : block[worker].get();
        rows(first, count, made, stride, scratch[worker]);
        if (!exchanged_ && wanted)
            for (int r = 0; r < count; ++r)
                for (int i = 0; i < n_; i += piece) {
                    const double* const z = made + r * stride + i;
                    if (const int points = std::min(piece, n_ - i); wanted(first + r, i, points, z))
                        std::copy_n(z, points, map.row(first + r) + i);
                }
        else if (exchanged_)
            (static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_) > kCached
                 ? transpose_past_cache
                 : transpose_to_cache)(made, stride, count, n_, map.row(0) + first, stride);
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
