// The split of 1/d into a near part and a band-limited far part, and the window that spreads forces onto the mesh. Lengths here are
// in mesh spacings.
//
// F(d) = 1/d [int_0^{d/c} w / int_0^1 w] with the Kaiser-Bessel bell w(t) = I0(beta sqrt(1 - t^2)), c the cutoff: F = 1/d beyond
// c, and its transform is exp(-beta) beyond the wavenumber beta / c. The spreading window is the same bell of another shape. For
// a given width of the window and cutoff, beta and the window's shape b are those of least error; aliases are weighed as by
// Hockney and Eastwood, Computer Simulation Using Particles, section 8-3.
#pragma once

#include "contact/interaction/pairs_kernel.hpp"

namespace rsc {

struct MeshDesign {
    double error;   // relative error of the product
    int width;      // of the spreading window
    double cutoff;  // c
    double shape;   // b of the window
    double beta;    // of the split
};

// The cheapest design whose error is safely below relative_error, or the most accurate one.
const MeshDesign& mesh_design(double relative_error);

// F and with it the near kernel 1/d - F, for a cutoff of the given length. `design` is one that mesh_design gave.
NearKernel near_kernel(const MeshDesign& design, double cutoff);

MeshWindow mesh_window(const MeshDesign& design);
// Fourier transform of the window at wavenumber k, and sum_m of its squares at k + 2 pi m.
double window_transform(const MeshDesign& design, double k);
double window_alias_sum(const MeshDesign& design, double k);

// A smooth function of period `period` that equals x^2 for |x| <= period/2 - bend: replaces (x_i - x_j)^2 on a periodic mesh so
// that the kernel has no kink where it wraps around.
double periodic_square(const MeshDesign& design, double x, double period, double bend);

}  // namespace rsc
