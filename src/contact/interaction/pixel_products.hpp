// Deflections of an elastic half-space by uniform pressures on the pixels of a grid, w = K p (physics: Johnson 1985, section 3.4).
#pragma once

#include "contact/interaction/kernel.hpp"

namespace rsc {

// A pixel of a grid, by column and row.
struct Pixel {
    int x, y;
    friend bool operator==(const Pixel&, const Pixel&) = default;
};

// The one interface behind which every kernel of pixels stands: the free half-space here, others (periodic) beside it.
// The solver works on a set of pixels: pressures and deflections are vectors over it, in its order.
class PixelProducts {
public:
    virtual ~PixelProducts() = default;

    // The pixels that may carry pressure and at whose middles deflections are wanted; no two the same.
    virtual void set_pixels(const std::vector<Pixel>& pixels) = 0;

    enum class Accuracy { inner, between, full };  // what iterations are made of, and what answers are judged by
    // w = K p [length], at every pixel of the set, sources and targets.
    virtual void apply(const double* p, double* w, Accuracy accuracy) = 0;
    // Deflections at other pixels under pressures on the set, in inner accuracy.
    virtual void elsewhere(const double* p, const std::vector<Pixel>& where, double* w) = 0;

    // K between two pixels so many columns and rows apart [length/pressure].
    virtual double coefficient(int dx, int dy) const = 0;

    // Relative errors (2-norm) of the two kinds of products.
    virtual double error(Accuracy accuracy) const = 0;
    double inner_error() const { return error(Accuracy::inner); }
    double full_error() const { return error(Accuracy::full); }
    long count() const { return count_; }  // products taken so far

protected:
    long count_ = 0;
};

// A free body under pixels of sides dx, dy [length], everything raised by substrate.bulge() a unit force (Kernel::shift()): Love's kernel, and a smooth part if it has one, between near pixels, and between far ones a
// hierarchy of boxes, each of which acts through its pressures interpolated to a few points (Chebyshev; W. Fong, E. Darve, J. Comput.
// Phys. 228, 2009): the work grows with the number of pixels. Results do not depend on the number of threads.
std::unique_ptr<PixelProducts> make_tree_products(const Substrate& substrate, double dx, double dy, double inner_error, double full_error);

}  // namespace rsc
