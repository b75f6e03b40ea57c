// Deflections of an elastic half-space by uniform pressures on the pixels of a grid, w = K p
// (Johnson 1985, section 3.4).
#pragma once

#include "elements/sparse_plane.hpp"
#include "interaction/kernel.hpp"
#include "surface/surface.hpp"

namespace rsc {

// A pixel of a grid, by column and row.
struct Pixel {
    int x, y;
    friend auto operator<=>(const Pixel&, const Pixel&) = default;
};

// Interface of products with K. Pressures and deflections are vectors over a set of pixels, in its
// order.
class PixelProducts {
public:
    virtual ~PixelProducts() = default;

    // Sets the pixels that may carry pressure and at whose centres deflections are computed; all
    // must be different.
    virtual void set_pixels(const std::vector<Pixel>& pixels) = 0;

    enum class Accuracy { inner, between, full };  // for iterations, and for the final residual
    // w = K p [length] at every pixel of the set. If `requested` is given, at the pixels k with
    // requested[k] != 0, and at others that or 0.
    virtual void apply(const double* p, double* w, Accuracy accuracy,
                       const char* requested = nullptr) = 0;
    // w = K p for pressures on another set, in inner accuracy; cheaper if it is that of the last
    // call.
    virtual void elsewhere(const double* p, const std::vector<Pixel>& pixels, double* w,
                           const char* requested = nullptr) = 0;

    // Approximate inverse of K with `diagonal` added on its diagonal, between near pixels, to a
    // constant factor.
    virtual PixelStencil inverse(double diagonal) const = 0;

    // Constant by which K was raised for each unit force, so that no force raises other points
    // (Kernel::shift()) [length/force].
    virtual double shift() const = 0;

    // Relative errors (2-norm) of the two kinds of products.
    virtual double error(Accuracy accuracy) const = 0;
    double inner_error() const { return error(Accuracy::inner); }
    double full_error() const { return error(Accuracy::full); }
    long count() const { return count_; }  // number of products so far

protected:
    long count_ = 0;
};

// Products for a free body with pixels of sides dx, dy [length]. If `shifted`, K includes the
// offset substrate.bulge() per unit force (Kernel::shift()).
// Near pixels interact by Love's kernel and the smooth part, far ones by a hierarchy of boxes,
// whose pressures are interpolated to a few Chebyshev points (W. Fong, E. Darve, J. Comput. Phys.
// 228, 2009). The work is proportional to the number of pixels. Results do not depend on the number
// of threads.
std::unique_ptr<PixelProducts> make_tree_products(const Substrate& substrate, double dx, double dy,
                                                  double inner_error, double full_error,
                                                  bool shifted = true);

// The deflections under unit pressure on a pixel of a surface that repeats along one axis
// (Indenter::period.line(); line_kernel.hpp) at the offsets [across][along], along at most half a
// period, each force raised by `raised`/(pi E*) [length/pressure].
std::vector<double> line_deflections(const Substrate& substrate, const Period& period, int nx,
                                     int ny, double dx, double dy, double raised);

// At least twice as many pixels less one, for convolutions that do not repeat: a power of two, or
// three quarters of one, so that sets of similar widths share their transforms.
int padded_size(int width);

// Products for a surface that repeats along both axes, with deflections measured from their mean
// (periodic_pixels.hpp), by transforms over the whole period. Pixels are sorted by rows.
std::unique_ptr<PixelProducts> make_periodic_products(const Substrate& substrate,
                                                      const PointGrid& map);

// Those for an indenter on a free surface, or on one that repeats along one axis: on a map of the
// whole period along it, by Fourier transforms, padded across, of a homogeneous half-space.
std::unique_ptr<PixelProducts> make_products(const Substrate& substrate, const Period& period,
                                             const PointGrid& map, double inner_error,
                                             double full_error, bool shifted = true);

}  // namespace rsc
