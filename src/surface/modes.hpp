// The random modes of a surface: noise and amplitudes.
#pragma once

#include "surface/spectrum.hpp"

namespace rsc {

// Identifies the noise of realization number `realization` of `seed`. All 128 bits are significant.
struct NoiseKey {
    std::int64_t seed = 1;
    std::int64_t realization = 1;
};

// Complex Gaussian noise of the mode with integer wavevector (kx, ky): mean 0, mean square modulus
// 1, uniform phase. Philox4x32-10 (Salmon et al., SC 2011) with key = seed and counter = (kx, ky,
// realization), followed by the Box-Muller transform.
std::complex<double> mode_noise(const NoiseKey& key, std::int32_t kx, std::int32_t ky);

// Noise of the modes ky = ky_first ... ky_first + count - 1 in re[i], im[i], with the same bits as
// mode_noise().
void column_noise(const NoiseKey& key, std::int32_t kx, std::int32_t ky_first, int count,
                  double* re, double* im);

// A surface is z(x, y) = sum of 2 Re[c exp(2 pi i (kx x + ky y)/L)] over the half plane kx > 0, or
// kx = 0 and ky > 0. Its modes c are drawn column by column.

// Sums over modes with integer wavevectors and amplitudes for Phi0 = 1.
struct ModeSums {
    double expected = 0;  // expectation of the mean square height
    double m0 = 0;        // mean square height of the continuous surface
    MomentTensor tensor;  // by direction
    double m2 = 0;        // (m20 + m02)/2
    double m4 = 0;  // (m40 + m04 + 3 m22)/3; MomentTensor::m4() if the spectrum is anisotropic
    // m2 and m4 from finite differences, in units of the step of the differences
    double m2_differences = 0;
    double m4_differences = 0;
    // mean square height over the n x n points (differs from m0 by the modes at the grid's Nyquist
    // limit)
    double grid = 0;
    void add(const ModeSums& other);
};

// Finite differences of a mode: the integer wavevector component k becomes 2 sin(pi k/n)/h on n
// steps of h = L/n.
class Differences {
public:
    // For |k| <= most; h is given in units of L.
    Differences(int most, double h);
    // Squares of the components k, k + 1, ... for h = 1; kBatch of them may be read from any |k| <=
    // most.
    const double* from(int k) const { return square_.data() + (k + most_); }
    static constexpr int kBatch = 128;

private:
    int most_;
    std::vector<double> square_;
};

// Writes the Fourier coefficients of column kx (0 <= kx <= n/2) of an n x n complex-to-real
// transform to column[0..n), index ky mod n, and zero where there is no mode. highest_kx and
// highest_ky must be at most n/2, and less than n/2 if the column of the mode at n/2 holds other
// modes.
ModeSums draw_column(const Spectrum& spectrum, const NoiseKey& key, int kx, int n,
                     const Differences& differences, std::complex<double>* column);

}  // namespace rsc
