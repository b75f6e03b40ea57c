// Surfaces with a given height distribution and an unchanged spectrum.
#pragma once

#include "rough/spectrum.hpp"

namespace rsc {

// The smallest even size >= least with a fast Fourier transform.
int fast_size(double least);

// Changes only the phases of a surface's modes until its heights have the distribution given in the Spectrum, by iterated amplitude
// adjustment (Schreiber and Schmitz, Phys. Rev. Lett. 77, 1996, 635): heights are replaced by rank, then the amplitudes of the modes are
// restored. The target skewness and kurtosis are increased during the iteration, because restoring the amplitudes reduces them. columns:
// the coefficients of kx = 0, 1, ... highest_kx, `stride` apart, index ky mod n, n > 2 highest_ky; changed in place. The result depends
// only on the modes, not on n. Returns the final skewness and kurtosis. Throws Error(no_memory).
HeightShape reshape_heights(const Spectrum& spectrum, std::complex<double>* columns, std::ptrdiff_t stride, int n);

}  // namespace rsc
