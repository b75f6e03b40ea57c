// Potential of a point and its images on a rectangular lattice in the plane: the periodic form of
// 1/d.
#pragma once

#include "interaction/period.hpp"

namespace rsc {

class SmoothPart;

// Gamma(x, y) = sum over images of 1/d - neutralising background, with mean 0 over a period. A mode
// exp(i k x) of sources has the potential
// 2 pi/k exp(i k x). Ewald sum with A = Lx Ly and any b [1/length]:
//     sum over images erfc(b d)/d + (2 pi/A) sum_{k != 0} erfc(k/2b) cos(k x)/k - 2 sqrt(pi)/(b A).
// It is evaluated as the sum of 1/d over the 4 images around the point plus a precomputed
// polynomial in (Lx/2 - |x|)^2 and (Ly/2 - |y|)^2, where |x|, |y| are the offsets from the nearest
// image; the error is below 1e-13/sqrt(A). With layers, 1/d + s(d)/near replaces 1/d (near = 1/(pi
// E*)), and modes have the potential 2 pi/k (1 + share(k)); the polynomial then includes a sum over
// all modes with a relevant share.
class Lattice {
public:
    // Largest ratio of the longer to the shorter side.
    static constexpr double kMostAspect = 4;

    // Throws Error(bad_input) unless the sides are positive and finite and their ratio is at most
    // kMostAspect, or if they are so long compared with the layers that there are too many modes.
    // `smooth` must outlive this object.
    explicit Lattice(Period period, const SmoothPart* smooth = nullptr, double near = 1);

    const Period& period() const { return period_; }
    double at(double dx, double dy) const;  // nonzero offset
    // At a source, without its own 1/d: -3.90026492/L on a square.
    double self() const { return self_; }
    // Smallest value, in the middle between images: -1.61554/L on a square; with layers a bound of
    // it.
    double least() const { return least_; }
    // Gamma minus 1/d + s(d)/near of the nearest image.
    double rest(double dx, double dy) const;
    double nearest_smooth(double dx, double dy) const;  // s(d)/near of the nearest image

    // phi[i] = sum_j fs[j] Gamma(target i - source j), i < n_targets, with self() for coinciding
    // points, to a few units in the last place.
    // Coordinates must be finite. phi must not overlap the other arrays.
    void potential(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources,
                   const double* xs, const double* ys, const double* fs, double* phi) const;

private:
    double add_smooth(double unit, std::vector<double>& table) const;
    void search_least();
    double polynomial(double u, double v) const;
    double smooth(double x, double y) const;  // s/near at an offset
    // Contribution of the shares of the modes at all (x, y), from 0 to half a period, in the units
    // of `sum`.
    std::vector<double> shares(const std::vector<double>& x, const std::vector<double>& y) const;

    Period period_;
    const SmoothPart* smooth_;
    double near_;
    double self_ = 0, least_ = 0;
    int degree_ = 0;
    // Of u^a v^b, a + b <= degree, ordered by a, then b; u = 2 (1 - 2|x|/Lx)^2 - 1, v similarly.
    std::vector<double> c_;
};

}  // namespace rsc
