// Grid errors of elements.
//
// The error of a quantity grows with the share of border pixels of the contacts (border_share),
// with a constant from the study of input/trust, which solves bodies of many kinds on grids four
// times finer. A second solution on every second point was tried and given up: two grids often
// agree by accident. Crests of straight ridges between the points, and the edges of punches, have
// errors of their own.
#pragma once

#include "contact/grid_bodies.hpp"
#include "contact/quantities.hpp"
#include "physics/physics.hpp"
#include "surface/surface.hpp"

namespace rsc {

// The class of the errors of elements.
GridBodies grid_bodies(bool measured, const Indenter& indenter);

struct PlaceOfTip {
    double x, y;
    friend bool operator==(const PlaceOfTip&, const PlaceOfTip&) = default;
};

// Expected relative error of a quantity from the resolution of the contacts; NaN where none was
// calibrated, or there is no contact.
double error_of_resolution(const LevelQuantity& quantity, std::size_t component,
                           const LevelValues& level, const GridBodies& bodies);

// States the errors of the curves of a level of boundary elements, `step` being the side of a pixel
// [length].
void state_curve_errors(std::span<double> curves, std::span<const AskedCurves> asked, double step,
                        const Case& settings, const LevelValues& level, const GridBodies& bodies);

// Expected relative errors of N and A. `edge`: radius of a punch whose edge is sharp and lies
// between points `side` apart [length]; not positive: there is none.
GridError error_of_grid(const LevelValues& level, const GridBodies& bodies, double edge,
                        double side);

// Lower bounds of the errors of contacts on straight ridges, whose crests lie between the points: a
// contact one or two points wide and many long has the error of one of few pixels. 0 without long
// straight borders. `stiffness` is dN/dZ0.
// `curvature`: of synthetic surfaces, of which not all heights need be kept, the mean of the second
// derivatives at points of unit height.
GridError error_of_crests(const Level& level, double stiffness, const HeightMap& map,
                          const Indenter& indenter, const std::optional<Tensor>& curvature);

// Upper bound of the Z0 at which the bodies touch, between points too: a summit or a crest between
// two points rises above them by at most half of what they fall to their other neighbours.
double touch_between_points(const HeightMap& map, const Indenter& indenter);

}  // namespace rsc
