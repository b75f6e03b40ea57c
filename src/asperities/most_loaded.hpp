// The contact spot of one summit as the ellipse that carries the largest load.
//
// Of all flat punches that press a frictionless half-space as far as a profile does, the one with
// the true contact area as its planform carries the largest load (Barber, J. Elasticity 4, 1974).
// By Betti's reciprocal theorem, the load of an elliptic planform with semi-axes a >= b at the
// penetration u of the summit is
//     F = S (u - g),   S = 2 E* agm(a, b) = pi E* a/K(e),   g = mean over the ellipse of (top -
//     height) with the weight of a flat
//     punch's pressure, 1/(2 pi a b sqrt(1 - r^2)), r = 1 at the rim,
// where agm is the arithmetic-geometric mean and heights are those of the surface minus the
// indenter. The maximum over centre, axes and angle is Hertz's ellipse for a paraboloid, the exact
// load of a round profile, and a lower bound for others; dF/du = S. What the bound misses is
// estimated from the angular harmonics of the profile that an ellipse cannot follow.
#pragma once

#include "asperities/spots.hpp"
#include "asperities/touching.hpp"
#include "contact/indentation.hpp"
#include "surface/stencil.hpp"

namespace rsc {

// Heights of the surface minus the indenter on a fine grid around a summit, with bicubic
// interpolation.
class HeightsAround {
public:
    // Window |x - x0|, |y - y0| <= half_width, cut at the border of a map that is not periodic.
    // `steps`: points in a grid step of the map.
    HeightsAround(const FoundSummits& found, const Stencil& stencil, const Indenter& indenter,
                  double x0, double y0, double half_width, int steps);
    bool usable() const { return usable_; }  // false: too small, or not entirely below the indenter
    // Height and gradient at an offset from the summit; false outside the window.
    bool at(double dx, double dy, double& height, double& hx, double& hy) const;

private:
    bool usable_ = false;
    int nx_ = 0, ny_ = 0;
    double left_ = 0, low_ = 0, hx_ = 1, hy_ = 1;  // offset of the first point, steps
    std::vector<double> z_;
};

// An ellipse of largest load at the penetration u.
struct LoadedEllipse {
    double u = 0, force = 0, stiffness = 0;  // [length], [force], dF/du [force/length]
    Spot spot{};                             // its centre counted from the summit
};

// Ellipses of a summit with the given mean curvature sqrt(kappa1 kappa2), ratio of curvatures and
// direction of its long axis, for increasing penetrations, the first one small. They end where the
// larger semi-axis would exceed `widest`, or where the ellipse would contain points higher than the
// summit, which belong to another one. Empty if that is so from the start.
std::vector<LoadedEllipse> most_loaded_ellipses(const HeightsAround& heights, double E_star,
                                                double curvature, double ratio, double angle,
                                                double widest);

// The same, found from the ellipses `like` of the same summit under a tip close by, whose mean
// curvature was smaller by the factor `ratio`: one for each of them, or these themselves if one is
// not found.
std::vector<LoadedEllipse> ellipses_like(const HeightsAround& heights, double E_star, double ratio,
                                         std::span<const LoadedEllipse> like);

}  // namespace rsc
