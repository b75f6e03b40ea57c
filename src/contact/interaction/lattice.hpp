// The potential of a point and of its images on a rectangular lattice in the plane: the periodic form of 1/d.
#pragma once

#include "contact/period.hpp"

namespace rsc {

class SmoothPart;

// Gamma(x, y) = sum over images 1/d - neutralising background: its mean over a period is 0. A mode exp(i k x) of sources answers
// 2 pi/k exp(i k x). By Ewald's sum, b any length's inverse, A = Lx Ly:
//     sum over images erfc(b d)/d + (2 pi/A) sum_{k != 0} erfc(k/2b) cos(k x)/k - 2 sqrt(pi)/(b A).
// Worked out once: with |x|, |y| to the nearest image, Gamma = sum over the 4 images around the place of 1/d + a polynomial in
// (Lx/2 - |x|)^2 and (Ly/2 - |y|)^2, whose error is below 1e-13 of 1/sqrt(A).
// On a body with layers 1/d is 1/d + s(d)/near, near the deflection times d close to a unit force, and a mode answers 2 pi/k (1 + share(k)):
// the images that are not around the place make a polynomial again, from a sum over all modes that have a share.
class Lattice {
public:
    // The longer side is at most this many shorter ones.
    static constexpr double kMostAspect = 4;

    // Throws Error(bad_input) for sides that are not positive and finite, or too different, or so much longer than the layers are thick that
    // there are too many modes. `smooth` must outlive it.
    explicit Lattice(Period period, const SmoothPart* smooth = nullptr, double near = 1);

    const Period& period() const { return period_; }
    double at(double dx, double dy) const;   // offset not zero
    double self() const { return self_; }    // at a source, its own 1/d left out: -3.90026492/L on a square
    double least() const { return least_; }  // in the middle between images: -1.61554/L on a square; with layers a bound of the least value
    // Gamma less 1/d + s(d)/near to the nearest image.
    double rest(double dx, double dy) const;
    double nearest_smooth(double dx, double dy) const;  // s(d)/near to the nearest image

    // phi[i] = sum_j fs[j] Gamma(target i - source j), i < n_targets, self() where they coincide: to a few units of the last place.
    // Coordinates are finite. phi may not overlap the other arrays.
    void potential(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources, const double* xs, const double* ys,
                   const double* fs, double* phi) const;

private:
    double polynomial(double u, double v) const;
    double smooth(double x, double y) const;  // s/near at an offset
    // The share of the modes at (x, y), 0 to half a period each: at every x, for every y, times the unit of `sum`.
    std::vector<double> shares(const std::vector<double>& x, const std::vector<double>& y) const;

    Period period_;
    const SmoothPart* smooth_;
    double near_;
    double self_ = 0, least_ = 0;
    int degree_ = 0;
    std::vector<double> c_;  // of u^a v^b, a + b <= degree, by a and then b; u, v = 2 (1 - 2|x|/Lx)^2 - 1 and alike
};

}  // namespace rsc
