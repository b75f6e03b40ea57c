// A surface of other heights with the same spectrum.
#pragma once

#include "rough/spectrum.hpp"

namespace rsc {

// The next even number from `least` on whose Fourier transforms are fast.
int fast_size(double least);

// Changes the phases of a surface's modes, and no amplitude, until its heights have the distribution that the spectrum asks for: heights
// take their ranks' values in the wanted distribution, modes get their amplitudes back, and so on (Schreiber and Schmitz, Phys. Rev. Lett.
// 77, 1996, 635: iterated amplitude adjustment). The wanted skewness and kurtosis are reached by asking for as much more of them as the
// amplitudes take back.
// columns: the coefficients of kx = 0, 1, ... highest_kx, `stride` apart, index ky mod n, n > 2 highest_ky; changed in place.
// The result depends on the modes alone, not on n. Returns what the heights have in the end.
// Throws Error(no_memory).
HeightShape reshape_heights(const Spectrum& spectrum, std::complex<double>* columns, std::ptrdiff_t stride, int n);

}  // namespace rsc
