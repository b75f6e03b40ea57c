// Surfaces with a given height distribution and an unchanged spectrum.
#pragma once

#include "rough/spectrum.hpp"

namespace rsc {

// The smallest even size >= least with a fast Fourier transform.
inline int fast_size(double least) {
    int n = static_cast<int>(std::ceil(least));
    for (n += n % 2;; n += 2) {
        int rest = n;
        for (int factor : {2, 3, 5, 7})
            while (rest % factor == 0) rest /= factor;
        if (rest == 1) return n;
    }
}

// Changes only the phases of a surface's modes until its heights have the skewness and kurtosis, or the distribution, given in the
// Spectrum: by Newton's method for both moments, at first of the waves that hold 92 % of the mean square height, of all waves if that does
// not suffice. Towards a measured distribution heights are replaced by rank and the amplitudes of the modes restored (Schreiber and
// Schmitz, Phys. Rev. Lett. 77, 1996, 635) before the last rounds. columns: the coefficients of kx = 0, 1, ... highest_kx, `stride` apart,
// index ky mod n, n > 2 highest_ky; changed in place. The result depends only on the modes, not on n. Returns the final skewness and
// kurtosis. Throws Error(no_memory).
HeightShape reshape_heights(const Spectrum& spectrum, std::complex<double>* columns, std::ptrdiff_t stride, int n);

}  // namespace rsc
