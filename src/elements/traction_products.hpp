// Tangential displacements by tractions on the pixels of a grid, u = T q, in two components
// (interaction/cerruti.hpp).
#pragma once

#include "elements/pixel_products.hpp"

namespace rsc {

// Vectors over a set of pixels: all x components, then all y components.
class TractionProducts {
public:
    // Two bodies without layers, of modulus E_star and `shear` = c > -1 (cerruti.hpp), on a free
    // surface or one that repeats along the axes of `period`, which are those of the map.
    TractionProducts(const Substrate& substrate, double shear, const Period& period,
                     const PointGrid& map);
    ~TractionProducts();

    // Sets the pixels, all different, in any order. On a free surface their columns and rows may be
    // any.
    void set_pixels(const std::vector<Pixel>& pixels);
    std::size_t size() const { return pixels_.size(); }
    // u = T q [length] for q [force/length^2], in double precision if `exact`, otherwise in single
    // precision (relative error 2e-6).
    void apply(const double* q, double* u, bool exact);
    // An approximation of T^-1 q between near pixels, to a constant factor; symmetric.
    void precondition(const std::vector<float>& q, std::vector<float>& y);
    // At least as large as all eigenvalues of T on any set of these pixels.
    double largest() const { return largest_; }
    // About the eigenvalue of T for tractions that change from pixel to pixel.
    double local() const { return map_.dx / substrate_.modulus(); }
    long count() const { return count_; }  // products so far

private:
    void set_plane(int nx, int ny);
    VectorModes free_modes() const;
    VectorModes line_modes() const;
    VectorModes periodic_modes() const;
    template <class Real>
    void multiply(std::unique_ptr<VectorPixels<Real>>& plane, const double* q, double* u);

    Substrate substrate_;
    double shear_;
    Period period_;
    PointGrid map_;
    std::vector<double> line_;  // line_deflections()
    PixelStencil inverse_;

    std::vector<Pixel> pixels_;
    std::vector<std::size_t> order_;    // of the pixels, row by row
    Pixel first_{0, 0};                 // of the plane
    std::vector<std::size_t> begin_;    // of the rows of the plane
    std::vector<std::int32_t> column_;  // of the pixels, on the plane
    int nx_ = 0, ny_ = 0;               // of the plane
    VectorModes modes_;
    double largest_ = 0;
    std::unique_ptr<VectorPixels<float>> single_;
    std::unique_ptr<VectorPixels<double>> double_;
    std::unique_ptr<SparsePlane> near_;
    long count_ = 0;
};

}  // namespace rsc
