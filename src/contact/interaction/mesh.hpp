// Products with the interaction matrix (paper, section 4) for many points in O(N log N).
//
// 1/d = [1/d - F(d)] + F(d), where F is smooth and equals 1/d beyond a cutoff. The first part is summed over near pairs. The second is band
// limited: forces are spread onto a mesh, convolved with F by Fourier transforms on a mesh of twice the size (free boundary), and
// interpolated. The error is due to the band limit and the spreading window and does not depend on the density of points. For periodic
// boundaries the sum over images minus 1/d of the nearest one is smooth and is added to F, and the mesh is not doubled. A smooth part of
// the kernel is also added to F, and the spacing resolves it.
//
// Existing libraries (multipole methods, Ewald sums) are made for three dimensions or periodic boxes, and their results depend on the
// number of threads.
#pragma once

#include "contact/interaction/kernel.hpp"

namespace rsc {

class FarField;
struct MeshDesign;

// Far fields of periodic meshes by design and spacing; for one lattice they do not depend on the points. Not thread-safe.
using FarFields = std::map<std::pair<const MeshDesign*, double>, std::shared_ptr<const FarField>>;

class MeshPotential {
public:
    // n points with finite coordinates [length]. relative_error, from 1e-10 to 1e-2, is the bound of |phi - exact| / |phi| in the 2-norm
    // for forces of any sign (smaller for forces of one sign). Any positions are allowed, including coinciding points; clusters cost more.
    // Throws Error(bad_input) for coordinates that are not finite or an error out of range. A point acts on itself through periodic images
    // and a smooth part. Without a kernel: 1/d. `kept`: stored far fields of the lattice of this kernel; missing ones are added, and all
    // are removed when they take too much memory.
    MeshPotential(std::size_t n, const double* x, const double* y, double relative_error, std::shared_ptr<const Kernel> kernel = nullptr,
                  FarFields* kept = nullptr);
    ~MeshPotential();
    MeshPotential(MeshPotential&&) noexcept;
    MeshPotential& operator=(MeshPotential&&) noexcept;

    std::size_t size() const;
    // phi[i] = sum_j f[j] G_ij, in the order the points were given. A const object may be used by
    // several threads at once. Uses threads (rough/parallel.hpp); the bits do not depend on their
    // number.
    void apply(const double* f, double* phi) const;

    // For reports and the choice of the method.
    std::size_t bytes() const;        // memory, including the work space of one product
    std::size_t mesh_points() const;  // points of the doubled mesh; 0: direct sums
    double cutoff() const;            // radius of the near field [length]
    double near_pairs() const;        // estimated directed pairs of the near field
    double cost() const;              // estimated seconds per product on one core of 3.4 GHz with AVX2
    // Cost for n points spread uniformly over a rectangle, with a smooth part that changes little within `scale` times the longer side.
    static double estimated_cost(std::size_t n, double relative_error, double aspect_ratio = 1, double scale = 1e300);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace rsc
