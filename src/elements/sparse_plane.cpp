#include "elements/sparse_plane.hpp"

#include "base/dispatch.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"

namespace rsc {
namespace {

constexpr int kRows = 8;  // that a thread takes at a time
constexpr int kWide = 8;  // pixels computed together

using Eight = Unaligned<float, kWide>;

// Values at kWide pixels from the pixel of the middle row at from[0]. A tap multiplies the sum of
// the four pixels at its offsets.
RSC_ALWAYS_INLINE void convolve_body(int reach, int beside, const float* taps,
                                     const float* const* rows, std::ptrdiff_t at, float* y) {
    const float* const here = rows[beside] + at;
    Eight::Vector sum = taps[0] * Eight::at(here).v;
    for (int a = 1; a <= reach; ++a)
        sum += taps[a] * (Eight::at(here - a).v + Eight::at(here + a).v);
    for (int b = 1; b <= beside; ++b) {
        const float *const below = rows[beside - b] + at, *const above = rows[beside + b] + at,
                           *const tap = taps + b * (reach + 1);
        Eight::Vector row = tap[0] * (Eight::at(below).v + Eight::at(above).v);
        for (int a = 1; a <= reach; ++a)
            row += tap[a] * ((Eight::at(below - a).v + Eight::at(below + a).v) +
                             (Eight::at(above - a).v + Eight::at(above + a).v));
        sum += row;
    }
    __builtin_memcpy(y, &sum, sizeof sum);
}
RSC_DISPATCH(convolve_eight, convolve_body,
             (int reach, int beside, const float* taps, const float* const* rows, std::ptrdiff_t at,
              float* y),
             (reach, beside, taps, rows, at, y))

// Cubic B-spline at the four nodes around a place t of the way from the second to the third.
constexpr std::array<float, 4> spline(double t) {
    const double u = 1 - t;
    return {
        static_cast<float>(u * u * u / 6), static_cast<float>((4 - 6 * t * t + 3 * t * t * t) / 6),
        static_cast<float>((4 - 6 * u * u + 3 * u * u * u) / 6), static_cast<float>(t * t * t / 6)};
}

constexpr int kFactor = 4;      // sides of a coarse pixel over those of a pixel
constexpr double kSplit = 1.5;  // s [pixels]
constexpr int kNear = 7;        // reach of the near part: erfc(7/3) = 1e-3

constexpr std::array<std::array<float, 4>, kFactor> kSplines = {spline(0), spline(0.25),
                                                                spline(0.5), spline(0.75)};

// 1/(square of the transform of the B-spline), averaged over directions, at a wavenumber times the
// side of the coarse pixel.
double sharpened(double k) {
    const double x2 = 0.25 * k * k;
    return std::exp(8 * (x2 / 6 + 0.75 * x2 * x2 / 180));
}

}  // namespace

PixelStencil::PixelStencil(int reach, int rows, const std::function<double(double, double)>& mode,
                           const std::function<double(int)>& window)
    : reach_(reach), rows_(rows) {
    if (std::max(reach, rows) > SparsePlane::kMostReach)
        throw Error(Failure::internal, "stencil: reach");
    // Sums over the modes of a period of 128 pixels, separable in the two directions.
    constexpr int modes = 64;
    taps_.assign(at((rows + 1) * (reach + 1)), 0.0f);
    std::vector<double> cosine(at((std::max(reach, rows) + 1) * modes)),
        half(at((reach + 1) * modes), 0.0);
    for (int a = 0; a <= std::max(reach, rows); ++a)
        for (int i = 0; i < modes; ++i)
            cosine[at(a * modes + i)] = std::cos(a * pi * (i + 0.5) / modes) / modes;
    for (int j = 0; j < modes; ++j)
        for (int i = 0; i < modes; ++i) {
            const double value = mode(pi * (i + 0.5) / modes, pi * (j + 0.5) / modes);
            for (int a = 0; a <= reach; ++a)
                half[at(a * modes + j)] += value * cosine[at(a * modes + i)];
        }
    for (int b = 0; b <= rows; ++b)
        for (int a = 0; a <= reach; ++a) {
            double value = 0;
            for (int j = 0; j < modes; ++j)
                value += half[at(a * modes + j)] * cosine[at(b * modes + j)];
            taps_[at(b * (reach + 1) + a)] = static_cast<float>(value * window(a) * window(b));
        }
}

double PixelStencil::transform(double k) const {
    double all = 0;
    for (int b = 0; b <= rows_; ++b)
        for (int a = 0; a <= reach_; ++a)
            all += (a > 0 ? 2 * std::cos(k * a) : 1.0) * (b > 0 ? 2.0 : 1.0) *
                   static_cast<double>(taps_[at(b * (reach_ + 1) + a)]);
    return all;
}

std::function<double(double)> share_of_modes(const Substrate& substrate, double dx) {
    if (!substrate.smooth()) return {};
    return [substrate, dx](double k) { return substrate.smooth()->share(k / dx); };
}

std::function<double(double)> with_diagonal(const std::function<double(double)>& share,
                                            double diagonal) {
    if (diagonal == 0) return share;
    return [share, diagonal](double k) { return (share ? share(k) : 0.0) + 0.5 * diagonal * k; };
}

PixelStencil inverse_stencil(double aspect, const std::function<double(double)>& share) {
    const bool row = aspect >= kEndless;
    const int reach = row ? 15 : 6;
    return PixelStencil(
        reach, row ? 0 : reach,
        [&](double kx, double ky) {
            const double k = std::hypot(kx, ky / aspect);
            return 0.5 * k / (share ? 1 + share(k) : 1);
        },
        // For layers much softer than the substrate only a window with a non-negative transform
        // keeps the stencil positive semidefinite; for a half-space a flatter one does, and is
        // closer to K^-1.
        [&](int a) {
            const double t = std::abs(a) / (reach + 1.0);
            return share ? 1 - t : 1 - t * t;
        });
}

SparsePlane::SparsePlane(int nx, int ny)
    : nx_(nx), ny_(ny), stride_(at(nx + 2 * kMargin + 7) / 8 * 8) {}

// Writes value(k) for the pixels k of row j, and repeats them in the margins.
template <class F>
void SparsePlane::place(float* row, int j, const PixelSet& set, F&& value) const {
    for (std::size_t k = set.rows[at(j)]; k < set.rows[at(j) + 1]; ++k) {
        const int i = set.column[k];
        const float v = value(k);
        row[i] = v;
        for (int left = i - nx_; left >= -kMargin; left -= nx_) row[left] = v;
        for (int right = i + nx_; right < nx_ + kMargin; right += nx_) row[right] = v;
    }
}

// Works on bands of rows, each of which is copied together with the rows within reach, so that the
// values remain in the cache.
void SparsePlane::convolve(const PixelStencil& stencil, const PixelSet& set, const float* x,
                           float* y, int threads) {
    while (bands_.size() < most_threads(threads))
        bands_.emplace_back(stride_ * at(kBand + 2 * kMostReach), 0.0f);
    const int reach = stencil.rows_;
    parallel_for((ny_ + kBand - 1) / kBand, 1, threads, [&](int band, std::size_t worker) {
        const int first = band * kBand, end = std::min(first + kBand, ny_);
        if (set.rows[at(first)] == set.rows[at(end)]) return;
        const auto row = [&](int j) {
            return bands_[worker].data() + at(j - first + reach) * stride_ + kMargin;
        };
        const auto of_plane = [&](int j) { return (j % ny_ + ny_) % ny_; };
        for (int j = first - reach; j < end + reach; ++j)
            place(row(j), of_plane(j), set, [&](std::size_t k) { return x[k]; });
        for (int j = first; j < end; ++j) {
            const float* rows[2 * kMostReach + 1];
            for (int b = -reach; b <= reach; ++b) rows[b + reach] = row(j + b);
            for (std::size_t k = set.rows[at(j)]; k < set.rows[at(j) + 1];) {
                const int from = set.column[k];
                float values[kWide];
                convolve_eight(stencil.reach_, reach, stencil.taps_.data(), rows, from, values);
                for (; k < set.rows[at(j) + 1] && set.column[k] < from + kWide; ++k)
                    y[k] = values[set.column[k] - from];
            }
        }
        for (int j = first - reach; j < end + reach; ++j)
            place(row(j), of_plane(j), set, [](std::size_t) { return 0.0f; });
    });
}

bool SplitPixels::suits(int nx, int ny, double aspect, const Share& share) {
    // The error is relative to the largest modes, and must stay below the smallest for K to remain
    // positive definite.
    constexpr double most = 8;
    const bool even = !share || 1 + share(2 * pi / std::max(nx, ny)) < most;
    return even && nx % kFactor == 0 && ny % kFactor == 0 && std::min(nx, ny) >= 128 &&
           aspect > 0.8 && aspect < 1.25;
}

SplitPixels::SplitPixels(int nx, int ny, double aspect, const Share& share)
    : nx_(nx),
      ny_(ny),
      coarse_(nx / kFactor, ny / kFactor, 1, aspect,
              [&](double k) {
                  return std::erfc(k * kSplit / kFactor) * sharpened(k) *
                             (share ? 1 + share(k / kFactor) : 1) -
                         1;
              }),
      near_(
          kNear, kNear,
          [&](double kx, double ky) {
              const double k = std::hypot(kx, ky / aspect);
              return 2 / k * std::erf(k * kSplit) * (share ? 1 + share(k) : 1);
          },
          [](int) { return 1.0; }) {}

void SplitPixels::multiply(SparsePlane& plane, const PixelSet& set, const Array<float>& x,
                           Array<float>& Kx, int threads) {
    const int mx = nx_ / kFactor, my = ny_ / kFactor;
    Kx.resize(x.size());
    plane.convolve(near_, set, x.data(), Kx.data(), threads);
    const double total = sum_in_order(ny_, kRows, threads, [&](int j) {
        return std::accumulate(x.begin() + std::ptrdiff_t(set.rows[at(j)]),
                               x.begin() + std::ptrdiff_t(set.rows[at(j) + 1]), 0.0);
    });
    // The near part of a uniform pressure, which deflects nothing.
    const double uniform =
        near_.transform(0) * total / (static_cast<double>(nx_) * static_cast<double>(ny_));
    // The pixels of each row are spread along x, then the rows along y.
    spread(set, x, threads);
    const std::size_t length = at(mx) + 3;
    const auto load = [&](int J, float* row) {
        std::fill_n(row, mx, 0.0f);
        for (int t = 0; t < 4; ++t)
            for (int m = 0; m < kFactor; ++m) {
                const float along_y = kSplines[at(m)][at(t)] / (kFactor * kFactor);
                const float* const line =
                    lines_.data() + at(((J + 1 - t + my) % my) * kFactor + m) * length + 1;
                for (int i = 0; i < mx; ++i) row[i] += along_y * line[i];
            }
    };
    coarse_.apply(load, [](int, const float*) {});
    gather(set, static_cast<float>(uniform), Kx, threads);
}

// Spreads x along the rows of the plane.
void SplitPixels::spread(const PixelSet& set, const Array<float>& x, int threads) {
    const int mx = nx_ / kFactor;
    const std::size_t length = at(mx) + 3;
    lines_.resize(length * at(ny_));
    parallel_for(ny_, kRows, threads, [&](int j) {
        float* const line = lines_.data() + at(j) * length;
        std::fill_n(line, length, 0.0f);
        std::array<float, 4> sum = {};
        int last = 0;
        const auto store = [&] {
            for (std::size_t u = 0; u < 4; ++u) line[at(last) + u] += sum[u];
            sum = {};
        };
        for (std::size_t k = set.rows[at(j)]; k < set.rows[at(j) + 1]; ++k) {
            const int q = set.column[k] / kFactor;
            if (q != last) {
                store();
                last = q;
            }
            const std::array<float, 4>& along_x = kSplines[at(set.column[k] % kFactor)];
            for (std::size_t u = 0; u < 4; ++u) sum[u] += x[k] * along_x[u];
        }
        store();
        line[at(mx)] += line[0];
        line[1] += line[at(mx) + 1];
        line[2] += line[at(mx) + 2];
    });
}

// Adds the coarse plane at the pixels to the near part, Kx.
void SplitPixels::gather(const PixelSet& set, float uniform, Array<float>& Kx, int threads) {
    const int mx = nx_ / kFactor, my = ny_ / kFactor;
    parallel_for(ny_, kRows, threads, [&](int j) {
        if (set.rows[at(j)] == set.rows[at(j) + 1]) return;
        const std::array<float, 4>& along_y = kSplines[at(j % kFactor)];
        const float* rows[4];
        for (int t = 0; t < 4; ++t) rows[t] = coarse_.row((j / kFactor - 1 + t + my) % my);
        thread_local std::vector<float> line;
        line.resize(at(mx) + 3);
        for (int i = 0; i < mx; ++i)
            line[at(i) + 1] = along_y[0] * rows[0][i] + along_y[1] * rows[1][i] +
                              along_y[2] * rows[2][i] + along_y[3] * rows[3][i];
        line[0] = line[at(mx)];
        line[at(mx) + 1] = line[1];
        line[at(mx) + 2] = line[2];
        for (std::size_t k = set.rows[at(j)]; k < set.rows[at(j) + 1]; ++k) {
            const std::array<float, 4>& along_x = kSplines[at(set.column[k] % kFactor)];
            const float* const from = line.data() + set.column[k] / kFactor;
            float far = 0;
            for (int u = 0; u < 4; ++u) far += along_x[at(u)] * from[u];
            Kx[k] += kFactor * far - uniform;
        }
    });
}

}  // namespace rsc
