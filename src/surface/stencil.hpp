// Stencils for heights and derivatives between grid points.
#pragma once

namespace rsc {

// Weights over the points -reach ... reach of a line, in units of grid steps. W_q are the weights
// of derivative q at the middle point. At |t| <= 1/2 from it the weights of derivative p follow
// from the Taylor series: sum over r of t^r/r! W_(p+r).
class Stencil {
public:
    static constexpr int kMostReach = 15;
    // weights W_q of the points 0 ... reach, padded with zeros
    static constexpr int kHalf = kMostReach + 1;
    // weights of the points -reach ... reach, padded with zeros
    static constexpr int kTaps = 2 * kMostReach + 2;
    static constexpr int kOrders = 5;  // derivatives 0 ... 4 are available from weights()

    // For lines without waves shorter than `points_per_wave` >= 4 steps: least-squares error over
    // that band, weighted by the spectrum of a self-affine surface. The reach is the shortest for
    // which the relative rms error of the fourth derivative is below 1e-8; lower derivatives are
    // more accurate. Throws Error(bad_input) for fewer points per wave.
    static Stencil band_limited(double points_per_wave);

    // For lines with an unknown spectrum: Lagrange's polynomial through the 2 reach + 1 points and
    // its derivatives.
    static Stencil polynomial(int reach);

    int reach() const { return reach_; }
    // True if made by band_limited(), which is exact between points up to its error.
    bool band_known() const { return band_known_; }

    // weight[o][reach + i] of point i for derivative o at t, |t| <= 1/2, o < orders; zero after i =
    // reach.
    void weights(double t, int orders, double (*weight)[kTaps]) const;

private:
    explicit Stencil(int reach) : reach_(reach) {}
    double fit(
        double
            cutoff);  // used by band_limited(); returns the relative error of the fourth derivative

    // the truncation error of the fourth is (pi/4)^15/15! = 2e-14
    static constexpr int kDerivatives = 19;
    int reach_;
    int derivatives_ = kDerivatives;
    bool band_known_ = false;
    // W_q(i), i >= 0; even q are symmetric, odd q antisymmetric
    double centre_[kDerivatives][kHalf] = {};
};

}  // namespace rsc
