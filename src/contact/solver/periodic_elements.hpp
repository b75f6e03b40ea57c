// Boundary-element contact on a periodic surface: 0 <= p, w = K p - (z - Z0) >= 0, p w = 0 on all pixels of the period, for a given mean
// pressure or separation. Products with K: interaction/periodic_pixels.hpp.
#pragma once

#include "contact/solver/periodic_grid.hpp"

namespace rsc {

// Heights on the pixels of a period, row by row; they must outlive their users.
struct Relief {
    int nx = 0, ny = 0;
    double dx = 0, dy = 0;  // sides of a pixel [length]
    const double* z = nullptr;
    std::ptrdiff_t stride = 0;  // between rows
};

// Active-set method of bounded.hpp. The conjugate gradients are preconditioned by K^-1 (modes E* |k|/2) truncated to a few pixels, with a
// correction for what is farther apart (block_correction.hpp), and the start is the solution on a grid of half as many pixels per side
// (recursively), so that both short and long waves converge in few steps.
// Products are in single precision while the error is large; the final error is computed in double precision. Levels are independent of
// each other.
class PeriodicElements {
public:
    // Pressures are limited to `highest` (the hardness; Infinity: no limit); where p = highest, w may be negative. Throws Error(bad_input)
    // if all heights are equal, Error(no_memory).
    PeriodicElements(const Relief& relief, const Substrate& substrate, double highest);

    // Solves for a given mean pressure > 0, or a separation Z0 (from z = 0 to the flat; the mean of K p is 0). Throws Error(bad_input) at
    // full contact, where Z0 does not determine the pressure.
    ElementsOutcome press(double mean_pressure, double tolerance, int most_iterations);
    ElementsOutcome approach(double Z0, double tolerance, int most_iterations);

    // Separation of full contact: the mean height, to rounding. None with a highest pressure, because pixels at this pressure can
    // penetrate.
    double closed() const;

    // Lowers the pixels at the highest pressure by their penetration, for which the last solution remains valid. Returns these pixels and
    // depths; the owner of the heights must lower them and call heights_changed().
    std::vector<std::pair<Pixel, double>> press_out();
    void heights_changed() { mean_ = mean_height(); }

    // K p at all points, row by row, for pressures p on some of them; its mean is 0.
    std::vector<double> deflections(const std::vector<Pixel>& pixels, const std::vector<double>& p);

    // Mean pressure of full contact: -min of K^-1 z.
    double closing_pressure();

    // Results of the last solution:
    double separation() const { return zero_ + grid_->Z0() * rms_; }
    const std::vector<Pixel>& pixels() const { return pixels_; }         // under pressure, row by row
    const std::vector<double>& pressures() const { return pressures_; }  // of these pixels
    // -d(mean pressure)/dZ0. For further loading, pixels at the highest pressure keep it; for unloading (`back`) they are elastic.
    double stiffness(bool back);
    // p'Kp/2 per pixel, with an error of the order of the square of the residual.
    double energy() const;

private:
    template <class F>
    double mean_of(F&& f) const;
    double mean_height() const;
    double points() const { return static_cast<double>(relief_.nx) * relief_.ny; }
    double pressure_unit() const { return substrate_.modulus() * (rms_ / relief_.dx); }
    ElementsOutcome solve(Given given, double tolerance, int most_iterations);

    Relief relief_;
    Substrate substrate_;
    double highest_;
    // Units in which values are of order 1: heights are relative to `zero_` in units of `rms_` (both of the initial heights), pressures in
    // units of E* rms/dx.
    double zero_, rms_;
    double mean_;  // mean of the current heights
    std::unique_ptr<PeriodicGrid> grid_;
    std::vector<Pixel> pixels_;
    std::vector<double> pressures_;
};

}  // namespace rsc
