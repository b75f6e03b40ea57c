#include "rough/modes.hpp"

#include <algorithm>
#include <cmath>

#include "rough/dispatch.hpp"
#include "rough/vector_math.hpp"

namespace rsc {
namespace {

constexpr int kBatch = 256;
constexpr int kLanes = 8;  // partial sums, fixed so that the sum has the same bits on every machine

// Relative amplitudes sqrt(Phi/Phi0) of the modes (kx, ky), ky = ky_first ... + kBatch - 1, all below the upper cutoff.
RSC_ALWAYS_INLINE void amplitudes_body(const Spectrum& s, double lowest_q2, int kx, int ky_first, double* amplitude) {
    const double x2 = static_cast<double>(kx) * kx;
    const double log_ql2 = vector_math::log_positive(s.L_lambda_l * s.L_lambda_l);
    const double exponent = -0.5 * (1.0 + s.hurst);
    const double below = s.plateau ? 1.0 : 0.0;
    for (int i = 0; i < kBatch; ++i) {
        const double y = static_cast<double>(ky_first + i);
        const double q2 = x2 + y * y;
        const double bounded = q2 < lowest_q2 ? lowest_q2 : q2;
        const double power = vector_math::exp_moderate(exponent * (vector_math::log_positive(bounded) - log_ql2));
        amplitude[i] = q2 < lowest_q2 ? below : power;
    }
}

struct Lanes {
    double e[kLanes] = {}, y2[kLanes] = {}, y4[kLanes] = {}, a[kLanes] = {};
};

// Multiplies the noise by the amplitudes into interleaved coefficients, and adds up the energies and their moments in ky.
RSC_ALWAYS_INLINE void apply_body(const double* amplitude, const double* re, const double* im, int ky_first, int count,
                                  double* coefficient, Lanes& sums) {
    alignas(64) double energy[kBatch], square[kBatch];
    for (int i = 0; i < kBatch; ++i) {
        const double a = i < count ? amplitude[i] : 0.0;
        square[i] = a * a;
        energy[i] = square[i] * (re[i] * re[i] + im[i] * im[i]);
    }
    for (int i = 0; i < count; ++i) {
        coefficient[2 * i] = amplitude[i] * re[i];
        coefficient[2 * i + 1] = amplitude[i] * im[i];
    }
    for (int i = 0; i < kBatch; i += kLanes)
        for (int l = 0; l < kLanes; ++l) {
            const double y = static_cast<double>(ky_first + i + l);
            const double y2 = y * y;
            const double e = energy[i + l];
            sums.e[l] += e;
            sums.y2[l] += e * y2;
            sums.y4[l] += e * (y2 * y2);
            sums.a[l] += square[i + l];
        }
}

RSC_DISPATCH(amplitudes, amplitudes_body, (const Spectrum& s, double lowest_q2, int kx, int ky_first, double* amplitude),
             (s, lowest_q2, kx, ky_first, amplitude))
RSC_DISPATCH(apply, apply_body,
             (const double* amplitude, const double* re, const double* im, int ky_first, int count, double* coefficient, Lanes& sums),
             (amplitude, re, im, ky_first, count, coefficient, sums))

double sum(const double* lanes) {
    double total = 0;
    for (int l = 0; l < kLanes; ++l) total += lanes[l];
    return total;
}

// The modes (kx, first..last) into coefficient[0..last-first].
void draw_run(const Spectrum& spectrum, double lowest_q2, const NoiseKey& key, int kx, int first, int last,
              std::complex<double>* coefficient, Lanes& lanes) {
    alignas(64) double amplitude[kBatch], re[kBatch] = {}, im[kBatch] = {};
    for (int ky = first; ky <= last; ky += kBatch) {
        const int count = std::min(kBatch, last - ky + 1);
        amplitudes(spectrum, lowest_q2, kx, ky, amplitude);
        column_noise(key, kx, ky, count, re, im);
        apply(amplitude, re, im, ky, count, reinterpret_cast<double*>(coefficient + (ky - first)), lanes);
    }
}

}  // namespace

void ModeSums::add(const ModeSums& other) {
    expected += other.expected;
    m0 += other.m0;
    m2 += other.m2;
    m4 += other.m4;
    grid += other.grid;
}

ModeSums draw_column(const Spectrum& spectrum, const NoiseKey& key, int kx, int n, std::complex<double>* column) {
    const Band limits = band(spectrum);
    const int top = limits.highest_ky(kx);
    std::fill(column, column + n, std::complex<double>());
    Lanes lanes;
    draw_run(spectrum, limits.lowest_q2, key, kx, kx > 0 ? 0 : 1, top, column + (kx > 0 ? 0 : 1), lanes);
    const double nyquist_energy = 2.0 * std::norm(column[n / 2]);  // of the mode (0, n/2), if there is one
    if (kx > 0) {
        draw_run(spectrum, limits.lowest_q2, key, kx, -top, -1, column + n - top, lanes);
    } else {
        // The column kx = 0 is its own mirror image. The mode at n/2 and its mirror image share one place.
        for (int ky = 1; ky < std::min(top + 1, n / 2); ++ky) column[n - ky] = std::conj(column[ky]);
        column[n / 2] += std::conj(column[n / 2]);
    }
    const double x2 = static_cast<double>(kx) * kx;
    const double e = sum(lanes.e), y2 = sum(lanes.y2), y4 = sum(lanes.y4);
    ModeSums sums;
    sums.expected = 2.0 * sum(lanes.a);
    sums.m0 = 2.0 * e;
    sums.m2 = x2 * e + y2;
    sums.m4 = 2.0 * (x2 * x2 * e + y4 + 3.0 * x2 * y2) / 3.0;
    sums.grid = sums.m0;
    if (kx == 0) sums.grid += std::norm(column[n / 2]) - nyquist_energy;
    if (kx == n / 2) {
        column[0] += std::conj(column[0]);
        sums.grid = std::norm(column[0]);
    }
    return sums;
}

}  // namespace rsc
