// Far field of particle-mesh sums: splitting of 1/d, spreading window, and convolution on the mesh.
#pragma once

#include <fftw3.h>

#include "base/library_lock.hpp"
#include "interaction/kernel.hpp"
#include "interaction/pairs_kernel.hpp"

namespace rsc {

// Splitting of 1/d into a near part and a band-limited far part, and the window that spreads forces
// onto the mesh. Lengths are in mesh spacings.
//
// F(d) = 1/d [int_0^{d/c} w / int_0^1 w] with the Kaiser-Bessel bell w(t) = I0(beta sqrt(1 - t^2))
// and the cutoff c: F = 1/d beyond c, and its transform is exp(-beta) beyond the wavenumber beta /
// c. The spreading window is the same bell with another shape parameter b. beta and b are optimal
// for a given window width and cutoff; aliases are treated as by Hockney and Eastwood, Computer
// Simulation Using Particles, section 8-3.
struct MeshDesign {
    double error;   // relative error of the product
    int width;      // width of the spreading window
    double cutoff;  // c
    double shape;   // b of the window
    double beta;    // of the split
};

// The cheapest design whose error is safely below relative_error, or the most accurate one.
const MeshDesign& mesh_design(double relative_error);

// F and with it the near kernel 1/d - F, for a cutoff of the given length. `design` must be
// returned by mesh_design().
NearKernel near_kernel(const MeshDesign& design, double cutoff);

MeshWindow mesh_window(const MeshDesign& design);

// Convolution with the smooth far kernel F on a mesh with free boundary, by pruned Fourier
// transforms.

// Aligned memory from FFTW.
struct FftwFree {
    void operator()(void* p) const noexcept { fftw_free(p); }
};
using FftwArray = std::unique_ptr<double[], FftwFree>;
FftwArray fftw_array(std::size_t n);  // uninitialised; Error(no_memory)

class FarField {
public:
    // For points within length_x times length_y mesh spacings [length]. The smooth part of the
    // kernel, divided by near(), is added to F.
    FarField(const MeshDesign& design, double length_x, double length_y, double spacing,
             const Kernel& kernel);
    // Periodic version: F is the far part for a cutoff [length], on a mesh of at least
    // period_x/spacing x period_y/spacing points; convolve() computes the sum of f (F + Gamma's
    // rest - its smallest value) [force/length].
    FarField(const MeshDesign& design, const Lattice& lattice, double spacing, double cutoff);

    // Mesh for spreading: `rows` rows of `stride` doubles, including a margin for windows. A point
    // at (x, y) from the corner of the bounding box of the points is at (u, v) = (x + width/2, y +
    // width/2).
    std::size_t rows() const { return rows_; }
    std::size_t stride() const { return 2 * columns_; }
    std::size_t columns() const { return period_x_; }  // of a periodic mesh: points per period
    std::size_t lines() const { return period_y_; }
    std::size_t points() const { return period_x_ * period_y_; }

    // Replaces forces on the mesh by the potential, times the mesh spacing.
    void convolve(double* mesh) const;

    // Number of points of the smallest mesh for the doubled box.
    static double points_needed(const MeshDesign& design, double length_x, double length_y);

private:
    static constexpr std::size_t kColumns = 8;  // columns transformed together

    void make_plans();
    // `value(m, n)`: the kernel m columns and n rows away.
    void make_multiplier(const MeshDesign& design,
                         const std::function<double(std::size_t, std::size_t)>& value);
    void fold(double* mesh) const;    // adds values beyond a period to their images
    void unfold(double* mesh) const;  // copies values of images beyond a period

    std::size_t period_x_, period_y_;  // sides of the doubled mesh
    bool periodic_ = false;
    std::size_t rows_, columns_;  // mesh rows in use, complex columns (padded to kColumns)
    FftwArray multiplier_;        // [column block][wavenumber 0 ... period_y/2][column]
    FftwPlan row_forward_, row_backward_, column_forward_, column_backward_;
};

}  // namespace rsc
