// Surfaces with a given height distribution and an unchanged spectrum.
#pragma once

#include "rough/spectrum.hpp"

namespace rsc {

// Changes only the phases of a surface's modes until its heights have the skewness and kurtosis, or the distribution, given in the
// Spectrum: by Newton's method for both moments, at first of the waves that hold 92 % of the mean square height, then of 98.5 % or all.
// Towards a measured distribution heights are replaced by rank and the amplitudes of the modes restored (Schreiber and Schmitz, Phys.
// Rev. Lett. 77, 1996, 635) before the last rounds. columns: the coefficients of kx = 0, 1, ... highest_kx, `stride` apart, index ky mod
// n, n > 2 highest_ky; changed in place. The result depends only on the modes, not on n. Returns the final skewness and kurtosis. Throws
// Error(no_memory).
HeightShape reshape_heights(const Spectrum& spectrum, std::complex<double>* columns, std::ptrdiff_t stride, int n);

}  // namespace rsc
