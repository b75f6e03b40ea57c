#include "surface/modes.hpp"

#include <Random123/philox.h>

#include "base/dispatch.hpp"
#include "base/vector_math.hpp"

namespace rsc {
namespace {

constexpr int kNoiseBatch = 32;

// Noise of kNoiseBatch consecutive modes, in three loops that vectorise. Philox is written out over
// the batch, because Random123 processes one counter at a time; constants and results are those of
// Random123.
RSC_ALWAYS_INLINE void noise_batch(const NoiseKey& key, std::int32_t kx, std::int32_t ky_first,
                                   double* re, double* im) {
    const auto seed = static_cast<std::uint64_t>(key.seed);
    const auto realization = static_cast<std::uint64_t>(key.realization);
    const auto k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32);
    const auto r0 = static_cast<std::uint32_t>(realization),
               r1 = static_cast<std::uint32_t>(realization >> 32);
    alignas(64) std::uint32_t w0[kNoiseBatch], w1[kNoiseBatch], w2[kNoiseBatch], w3[kNoiseBatch];
    for (const int i : indices(kNoiseBatch)) {
        std::uint32_t c0 = static_cast<std::uint32_t>(kx);
        std::uint32_t c1 = static_cast<std::uint32_t>(ky_first) + static_cast<std::uint32_t>(i);
        std::uint32_t c2 = r0, c3 = r1;
#pragma GCC unroll 10
        for (std::uint32_t round = 0; round < 10; ++round) {
            const std::uint64_t p0 = static_cast<std::uint64_t>(PHILOX_M4x32_0) * c0;
            const std::uint64_t p1 = static_cast<std::uint64_t>(PHILOX_M4x32_1) * c2;
            c0 = static_cast<std::uint32_t>(p1 >> 32) ^ c1 ^ (k0 + round * PHILOX_W32_0);
            c1 = static_cast<std::uint32_t>(p1);
            c2 = static_cast<std::uint32_t>(p0 >> 32) ^ c3 ^ (k1 + round * PHILOX_W32_1);
            c3 = static_cast<std::uint32_t>(p0);
        }
        w0[i] = c0;
        w1[i] = c1;
        w2[i] = c2;
        w3[i] = c3;
    }
    alignas(64) double radius[kNoiseBatch];
    for (const int i : indices(kNoiseBatch)) {
        // 52 random bits with the exponent of 1 form a uniform number in [1, 2).
        const std::uint64_t b1 =
            w0[i] | (static_cast<std::uint64_t>(w1[i] & 0xfffffu) << 32) | 0x3ff0000000000000ULL;
        const std::uint64_t b2 =
            w2[i] | (static_cast<std::uint64_t>(w3[i] & 0xfffffu) << 32) | 0x3ff0000000000000ULL;
        const double u1 = 2.0 - std::bit_cast<double>(b1);  // (0, 1]
        const double u2 = std::bit_cast<double>(b2) - 1.0;  // [0, 1)
        // Box-Muller transform with -ln u1 in place of -2 ln u1, so that each component has
        // variance 1/2.
        radius[i] = -vector_math::log_positive(u1);
        vector_math::cos_sin_turns(u2, re[i], im[i]);
    }
    vector_math::square_roots(radius, kNoiseBatch);
    for (const int i : indices(kNoiseBatch)) {
        re[i] *= radius[i];
        im[i] *= radius[i];
    }
}

RSC_ALWAYS_INLINE void column_noise_body(const NoiseKey& key, std::int32_t kx,
                                         std::int32_t ky_first, int count, double* re, double* im) {
    int done = 0;
    for (; done + kNoiseBatch <= count; done += kNoiseBatch)
        noise_batch(key, kx, ky_first + done, re + done, im + done);
    if (done < count) {
        alignas(64) double last_re[kNoiseBatch], last_im[kNoiseBatch];
        noise_batch(key, kx, ky_first + done, last_re, last_im);
        std::copy_n(last_re, count - done, re + done);
        std::copy_n(last_im, count - done, im + done);
    }
}

RSC_DISPATCH(column_noise_for, column_noise_body,
             (const NoiseKey& key, std::int32_t kx, std::int32_t ky_first, int count, double* re,
              double* im),
             (key, kx, ky_first, count, re, im))

}  // namespace

std::complex<double> mode_noise(const NoiseKey& key, std::int32_t kx, std::int32_t ky) {
    double re, im;
    column_noise(key, kx, ky, 1, &re, &im);
    return {re, im};
}

void column_noise(const NoiseKey& key, std::int32_t kx, std::int32_t ky_first, int count,
                  double* re, double* im) {
    column_noise_for(key, kx, ky_first, count, re, im);
}

namespace {

constexpr int kBatch = Differences::kBatch;
constexpr int kLanes = 8;  // partial sums, fixed so that the sum has the same bits on every machine

// Relative amplitudes sqrt(Phi/Phi0) of the power law at (kx, ky_first + i), i < count; (0, 0) must
// not be among them. Here and below, count is a multiple of kLanes.
RSC_ALWAYS_INLINE void power_law_body(const Spectrum& s, const Stretch& stretched, int kx,
                                      int ky_first, int count, double* amplitude) {
    const double x2 = stretched.xx * kx * kx, xy = 2 * stretched.xy * kx, yy = stretched.yy;
    const double log_ql2 = vector_math::log_positive(s.L_lambda_l * s.L_lambda_l);
    const double exponent = -0.5 * (1.0 + s.hurst);
    for (const int i : indices(count)) {
        const double y = double(ky_first + i);
        amplitude[i] = vector_math::exp_moderate(
            exponent * (vector_math::log_positive(x2 + y * (xy + yy * y)) - log_ql2));
    }
}

struct Lanes {
    double e[kLanes] = {}, y1[kLanes] = {}, y2[kLanes] = {}, y3[kLanes] = {}, y4[kLanes] = {},
           a[kLanes] = {};
    double d2[kLanes] = {},
           d4[kLanes] = {};  // sums with the squared finite differences in place of ky^2
};

// Adds up the energies of a batch of coefficients and their moments in ky, lane by lane.
RSC_ALWAYS_INLINE void add_energies_body(const double* amplitude, const double* re,
                                         const double* im, const double* difference, int ky_first,
                                         int count, Lanes& total) {
    Lanes sums = total;
    for (int i = 0; i < count; i += kLanes)
        for (const int l : indices(kLanes)) {
            const int k = i + l;
            const double y = double(ky_first + k);
            const double y2 = y * y;
            const double square = amplitude[k] * amplitude[k];
            const double e = square * (re[k] * re[k] + im[k] * im[k]);
            sums.e[l] += e;
            sums.y1[l] += e * y;
            sums.y2[l] += e * y2;
            sums.y3[l] += e * y * y2;
            sums.y4[l] += e * (y2 * y2);
            sums.a[l] += square;
            const double d2 = difference[k];
            sums.d2[l] += e * d2;
            sums.d4[l] += e * (d2 * d2);
        }
    total = sums;
}

RSC_DISPATCH(power_law, power_law_body,
             (const Spectrum& s, const Stretch& stretched, int kx, int ky_first, int count,
              double* amplitude),
             (s, stretched, kx, ky_first, count, amplitude))
RSC_DISPATCH(add_energies, add_energies_body,
             (const double* amplitude, const double* re, const double* im, const double* difference,
              int ky_first, int count, Lanes& total),
             (amplitude, re, im, difference, ky_first, count, total))

double sum(const double* lanes) {
    double total = 0;
    for (const int l : indices(kLanes)) total += lanes[l];
    return total;
}

// Draws the modes (kx, first..last) into coefficient[0..last-first].
void draw_run(const Spectrum& spectrum, const Band& limits, const NoiseKey& key,
              const Differences& differences, int kx, int first, int last,
              std::complex<double>* coefficient, Lanes& lanes) {
    alignas(64) double amplitude[kBatch], re[kBatch] = {}, im[kBatch] = {};
    for (int ky = first; ky <= last; ky += kBatch) {
        const int count = std::min(kBatch, last - ky + 1),
                  whole = (count + kLanes - 1) / kLanes * kLanes;
        if (spectrum.table)
            for (const int i : indices(count))
                amplitude[i] = std::sqrt(relative_psd(spectrum, kx, ky + i));
        else
            power_law(spectrum, limits.stretched, kx, ky, whole, amplitude);
        std::fill(amplitude + count, amplitude + whole, 0.0);
        if (!spectrum.table && kx * double(kx) < limits.stretched.yy * limits.lowest_q2)
            for (const int i : indices(count))
                if (limits.stretched(kx, ky + i) < limits.lowest_q2)
                    amplitude[i] = spectrum.plateau ? 1.0 : 0.0;
        column_noise(key, kx, ky, count, re, im);
        add_energies(amplitude, re, im, differences.from(ky), ky, whole, lanes);
        for (const int i : indices(count))
            coefficient[i] = {amplitude[i] * re[i], amplitude[i] * im[i]};
        coefficient += count;
    }
}

}  // namespace

void ModeSums::add(const ModeSums& other) {
    expected += other.expected;
    m0 += other.m0;
    tensor.m20 += other.tensor.m20;
    tensor.m11 += other.tensor.m11;
    tensor.m02 += other.tensor.m02;
    tensor.m40 += other.tensor.m40;
    tensor.m31 += other.tensor.m31;
    tensor.m22 += other.tensor.m22;
    tensor.m13 += other.tensor.m13;
    tensor.m04 += other.tensor.m04;
    m2 += other.m2;
    m4 += other.m4;
    m2_differences += other.m2_differences;
    m4_differences += other.m4_differences;
    grid += other.grid;
}

Differences::Differences(int most, double h) : most_(most), square_(at(2 * most + 1 + kBatch)) {
    for (int k = -most; k <= most; ++k) {
        const double s = 2.0 * std::sin(pi * k * h);
        square_[at(k + most)] = s * s;
    }
}

ModeSums draw_column(const Spectrum& spectrum, const NoiseKey& key, int kx, int n,
                     const Differences& differences, std::complex<double>* column) {
    const Band limits = band(spectrum);
    const auto [bottom, top] = limits.column(kx);
    std::fill(column, column + n, std::complex<double>());
    Lanes lanes;
    const int first = std::max(kx > 0 ? 0 : 1, bottom);
    draw_run(spectrum, limits, key, differences, kx, first, top, column + first, lanes);
    // of the mode (0, n/2), if present
    const double nyquist_energy = 2.0 * std::norm(column[n / 2]);
    if (kx > 0) {
        draw_run(spectrum, limits, key, differences, kx, bottom, std::min(top, -1),
                 column + n + bottom, lanes);
    } else {
        // The column kx = 0 contains its own mirror image. The mode at n/2 and its mirror image
        // share one element.
        for (int ky = 1; ky < std::min(top + 1, n / 2); ++ky)
            column[n - ky] = std::conj(column[ky]);
        column[n / 2] += std::conj(column[n / 2]);
    }
    const double x2 = double(kx) * kx;
    const bool isotropic = !spectrum.directional();
    const double x = kx, e = sum(lanes.e);
    const double y1 = sum(lanes.y1), y2 = sum(lanes.y2);
    const double y3 = sum(lanes.y3), y4 = sum(lanes.y4);
    ModeSums sums;
    sums.expected = 2.0 * sum(lanes.a);
    sums.m0 = 2.0 * e;
    sums.m2 = x2 * e + y2;
    sums.tensor = {2 * x2 * e,      2 * x * y1,  2 * y2,     2 * x2 * x2 * e,
                   2 * x2 * x * y1, 2 * x2 * y2, 2 * x * y3, 2 * y4};
    sums.m4 = isotropic ? 2.0 * (x2 * x2 * e + y4 + 3.0 * x2 * y2) / 3.0 : sums.tensor.m4();
    sums.grid = sums.m0;
    const double dx2 = *differences.from(kx), d2 = sum(lanes.d2), d4 = sum(lanes.d4);
    sums.m2_differences = dx2 * e + d2;
    sums.m4_differences = isotropic ? 2.0 * (dx2 * dx2 * e + d4 + 3.0 * dx2 * d2) / 3.0
                                    : 0.75 * (dx2 * dx2 * e + d4 + 2 * dx2 * d2);
    // At grid points only the real part of a mode at the Nyquist limit is visible.
    const auto correct = [&](double more, double k2) {
        sums.grid += more;
        sums.m2_differences += 0.5 * more * k2;
        sums.m4_differences += more * k2 * k2 * (isotropic ? 1.0 / 3.0 : 3.0 / 8.0);
    };
    if (kx == 0)
        correct(std::norm(column[n / 2]) - nyquist_energy,
                *differences.from(std::min(n / 2, limits.highest_ky)));
    if (kx == n / 2) {
        column[0] += std::conj(column[0]);
        correct(std::norm(column[0]) - sums.m0, dx2);
        sums.grid = std::norm(column[0]);  // the only mode in the column
    }
    return sums;
}

}  // namespace rsc
