// Products with the interaction matrix (paper, section 4) for many points in O(N log N).
//
// 1/d = [1/d - F(d)] + F(d), where F is smooth and equals 1/d beyond a cutoff. The first part is
// summed over near pairs. The second is band limited: forces are spread onto a mesh, convolved with
// F by Fourier transforms on a mesh of twice the size (free boundary), and interpolated. The error
// is due to the band limit and the spreading window and does not depend on the density of points.
// For periodic boundaries the sum over images minus 1/d of the nearest one is smooth and is added
// to F, and the mesh is not doubled. A smooth part of the kernel is also added to F, and the
// spacing resolves it.
//
// Existing libraries (multipole methods, Ewald sums) are made for three dimensions or periodic
// boxes, and their results depend on the number of threads.
#pragma once

#include "interaction/mesh_far.hpp"
#include "interaction/pairs.hpp"

namespace rsc {

class MeshPotential {
public:
    // n points with finite coordinates [length]. relative_error, from 1e-10 to 1e-2, is the bound
    // of |phi - exact| / |phi| in the 2-norm for forces of any sign (smaller for forces of one
    // sign). Any positions are allowed, including coinciding points; clusters cost more.
    // Throws Error(bad_input) for coordinates that are not finite or an error out of range. A point
    // acts on itself through periodic images and a smooth part.
    MeshPotential(std::size_t n, const double* x, const double* y, double relative_error,
                  std::shared_ptr<const Kernel> kernel);

    // phi[i] = sum_j f[j] G_ij, in the order the points were given. Uses threads
    // (base/parallel.hpp); the bits do not depend on their number.
    void apply(const double* f, double* phi);

    // Points of the doubled mesh; 0: direct sums.
    std::size_t mesh_points() const { return far_ ? far_->points() : 0; }

    // Estimated seconds per product on one core of 3.4 GHz with AVX2, for n points spread uniformly
    // over a rectangle and a smooth part that changes little within `scale` times the longer side.
    static double estimated_cost(std::size_t n, double relative_error, double aspect_ratio = 1,
                                 double scale = 1e300);

private:
    int threads() const;
    double resolved() const;
    void make_periodic(const double* x, const double* y);
    void make_strips(const double* x, const double* y, double x0, double y0, double length_y);
    void fill_strips(const double* x, const double* y, double x0, double y0, std::size_t whole);
    void near_strip(std::size_t s);
    void near_field();
    void spread();

    std::size_t n_;
    std::shared_ptr<const Kernel> kernel_;
    const Lattice* lattice_;  // null unless periodic
    // Used instead of the mesh for few or coinciding points, and if a mesh would be too fine.
    PairSums direct_;

    const MeshDesign* design_;
    double spacing_ = 0;  // of the mesh [length]
    double scale_ = 1;    // near-field coordinate units per length, a power of two
    NearKernel near_part_;
    MeshWindow window_;
    std::unique_ptr<const FarField> far_;

    // Points are sorted in strips along the longer side (x), by x within a strip. Strips are padded
    // for the pair loops. With periodic boundaries the first `strips_` strips are followed by
    // copies: of the two lowest strips beyond the upper border, then of the left ends of all these
    // strips beyond the right border.
    std::size_t strips_ = 0;
    std::vector<std::size_t> strip_begin_, strip_size_;
    // [strip_begin_[s] + k] index of the caller, k < strip_size_[s].
    std::vector<std::uint32_t> point_;
    std::vector<double> x_, y_;    // for the near field, scaled
    std::vector<double> u_, v_;    // on the mesh
    std::size_t spread_band_ = 1;  // number of strips whose windows reach only into the next band

    // Work space of a product, in the order of the strips.
    std::vector<double> f_, near_phi_, far_phi_;
    FftwArray mesh_;
};

}  // namespace rsc
