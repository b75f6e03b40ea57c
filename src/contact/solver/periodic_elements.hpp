// The contact of elements on a surface that repeats: 0 <= p, w = K p - (z - Z0) >= 0, p w = 0 on all pixels of the period, with the mean
// pressure or the separation given. Products are those of interaction/periodic_pixels.hpp.
#pragma once

#include "contact/interaction/pixel_products.hpp"
#include "contact/solver/elements.hpp"

namespace rsc {

// Heights on the pixels of a period, row by row; they must outlive who looks at them.
struct Relief {
    int nx = 0, ny = 0;
    double dx = 0, dy = 0;  // sides of a pixel [length]
    const double* z = nullptr;
    std::ptrdiff_t stride = 0;  // between rows
};

// Active set as in elements.hpp: pixels whose pressure falls below 0 leave, pixels that penetrate enter, some steps of conjugate gradients
// in between. Their preconditioner is the part of K^-1, whose modes are E* |k|/2, that reaches a few pixels far; the start is the
// solution on half as many pixels a side, got in the same way: so neither short waves nor long ones take many steps. Products are in single
// precision while the error is large, and the outcome is judged in double. A level depends on no other.
class PeriodicElements {
public:
    // Pressures are bounded by `highest` (the hardness; Infinity: none): where p = highest, w may be negative.
    // Throws Error(bad_input) for heights all the same, no_memory.
    PeriodicElements(const Relief& relief, const Substrate& substrate, double highest);
    ~PeriodicElements();

    // The solution under a mean pressure > 0, or at a separation: Z0 from z = 0 to the flat, the mean of K p being 0. Throws
    // Error(bad_input) where the gap is closed altogether: Z0 then no longer says what the pressure is.
    ElementsOutcome press(double mean_pressure, double tolerance, int most_iterations);
    ElementsOutcome approach(double Z0, double tolerance, int most_iterations);

    // The separation of full contact: the mean height, to rounding. With a highest pressure there is none: what
    // carries no more goes on penetrating.
    double closed() const;

    // Pixels at the highest pressure, where they penetrate, are lowered by it: the last solution still holds. Returns which of pixels() they
    // are and how far; whoever owns the heights has to lower them, and say so.
    std::vector<std::pair<Pixel, double>> press_out();
    void heights_changed();

    // K p at every point, row by row, of pressures p on some of them; its mean is 0.
    std::vector<double> deflections(const std::vector<Pixel>& pixels, const std::vector<double>& p);

    // The mean pressure of full contact: -min of K^-1 z.
    double closing_pressure();

    // Of the last solution:
    double separation() const;
    const std::vector<Pixel>& pixels() const;      // under pressure, row by row
    const std::vector<double>& pressures() const;  // theirs
    // -d(mean pressure)/dZ0. Pressed further, pixels at the highest pressure keep it; on the way `back` they are elastic.
    double stiffness(bool back);
    // p'Kp/2 a pixel, to the square of the residual.
    double energy() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace rsc
