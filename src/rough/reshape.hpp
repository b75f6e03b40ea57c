// Surfaces with a given height distribution and an unchanged spectrum.
#pragma once

#include "rough/spectrum.hpp"

namespace rsc {

// The smallest even size >= least with a fast Fourier transform.
int fast_size(double least);

// Changes only the phases of a surface's modes until its heights have the skewness and kurtosis, or the distribution, given in the Spectrum.
// Heights are replaced by rank in a distribution and the amplitudes of the modes restored (Schreiber and Schmitz, Phys. Rev. Lett. 77, 1996,
// 635); Newton's method follows for both moments. Waves that hold 90 % of the mean square height (97 % for long tails and close to the lower
// bound of the kurtosis) are changed; all waves are, if that does not suffice, and for a measured distribution. columns:
// the coefficients of kx = 0, 1, ... highest_kx, `stride` apart, index ky mod n, n > 2 highest_ky; changed in place. The result depends
// only on the modes, not on n. Returns the final skewness and kurtosis. Throws Error(no_memory).
HeightShape reshape_heights(const Spectrum& spectrum, std::complex<double>* columns, std::ptrdiff_t stride, int n);

}  // namespace rsc
