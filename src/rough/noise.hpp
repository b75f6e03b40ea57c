// White noise of the modes of a random surface: counter-based, so that a mode's noise depends on nothing but its name.
#pragma once

#include <complex>
#include <cstdint>

namespace rsc {

// Which noise: realization number `realization` of `seed`. All 128 bits count.
struct NoiseKey {
    std::int64_t seed = 1;
    std::int64_t realization = 1;
};

// Complex Gaussian noise of the mode with integer wavevector (kx, ky): mean 0, mean square modulus 1, uniform phase.
// Philox4x32-10 (Salmon et al., SC 2011) with key = seed and counter = (kx, ky, realization), then Box and Muller.
std::complex<double> mode_noise(const NoiseKey& key, std::int32_t kx, std::int32_t ky);

// The same for ky = ky_first, ky_first + 1, ... ky_first + count - 1: re[i], im[i]. Same bits as mode_noise.
void column_noise(const NoiseKey& key, std::int32_t kx, std::int32_t ky_first, int count, double* re, double* im);

}  // namespace rsc
