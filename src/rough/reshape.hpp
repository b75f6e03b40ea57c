// Surfaces with a given height distribution and an unchanged spectrum.
#pragma once

#include "rough/spectrum.hpp"

namespace rsc {

// The smallest even number >= least with fast Fourier transforms.
int fast_size(double least);

// Changes the phases of a surface's modes, but no amplitude, until its heights have the distribution of the Spectrum: alternately heights
// get the values of their ranks in that distribution, and modes their amplitudes (Schreiber and Schmitz, Phys. Rev. Lett.
// 77, 1996, 635: iterated amplitude adjustment). Skewness and kurtosis are reached by iterating larger target
// values, because restoring the amplitudes reduces them.
// columns: the coefficients of kx = 0, 1, ... highest_kx, `stride` apart, index ky mod n, n > 2 highest_ky; changed in place.
// The result depends on the modes alone, not on n. Returns the final skewness and kurtosis.
// Throws Error(no_memory).
HeightShape reshape_heights(const Spectrum& spectrum, std::complex<double>* columns, std::ptrdiff_t stride, int n);

}  // namespace rsc
