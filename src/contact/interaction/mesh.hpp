// The product with the interaction matrix (paper, section 4) for very many points in O(N log N).
//
// 1/d = [1/d - F(d)] + F(d), with F smooth and equal to 1/d from a cutoff on. The first part is a sum over near pairs. The second
// is band limited: forces are spread onto a mesh, convolved with F by Fourier transforms on a mesh of twice the size (free
// boundary: nothing is periodic), and read off again. The error is one of the band limit and of the spreading window, the same at
// every density of points. Where everything repeats, the sum over images less 1/d to the nearest one is smooth and goes to the mesh
// with F, which needs no doubling then. A smooth part of the kernel goes to the mesh, too, whose spacing then resolves it.
//
// By hand, over FFTW: libraries for such sums (multipole methods, Ewald sums) are made for points in three dimensions or for periodic
// boxes, and the bits they give depend on the number of threads.
#pragma once

#include "contact/interaction/kernel.hpp"

namespace rsc {

class FarField;
struct MeshDesign;

// Far fields of meshes that repeat, by design and spacing: with one lattice they are the same for all points. Not for several threads.
using FarFields = std::map<std::pair<const MeshDesign*, double>, std::shared_ptr<const FarField>>;

class MeshPotential {
public:
    // n points with finite coordinates [length]. relative_error, 1e-10 to 1e-2: wanted bound on |phi - exact| / |phi| in the
    // 2-norm, for forces of any sign (forces of one sign do better). Points may lie as they like, twice at the same place
    // included; clusters cost more. Throws Error(bad_input) for coordinates that are not finite or an error out of bounds.
    // A point acts on itself through its periodic images and through a smooth part. Without a kernel: 1/d.
    // `kept`: far fields made before with this kernel's lattice; what is missing is added, and all give way once they take much memory.
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

    // For reports and for choosing between methods.
    std::size_t bytes() const;        // memory held, scratch of one product included
    std::size_t mesh_points() const;  // of the doubled mesh; 0: so few points that they are summed directly
    double cutoff() const;            // radius of the near field [length]
    double near_pairs() const;        // estimated directed pairs of the near field
    double cost() const;              // estimated seconds a product on one core of some 3.4 GHz with AVX2
    // The same for n points spread evenly over a rectangle with these sides; with a smooth part that changes little within `scale` times the
    // longer side.
    static double estimated_cost(std::size_t n, double relative_error, double aspect_ratio = 1, double scale = 1e300);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace rsc
