// Points of measured maps that were missing and are not part of the contact.
#pragma once

#include "contact/level.hpp"
#include "surface/measured.hpp"

namespace rsc {

// The filled points of a map.
struct FilledPoints : PointGrid {
    const std::vector<std::uint8_t>* filled;  // 1 at index(i, j)
    bool periodic;
    bool second;                        // of body 2
    bool at(double x, double y) const;  // whether the nearest point is filled
};

// Those of the maps of both bodies, if any; `measured`: of body 1, with its first point at (x0,
// y0), may be null. Both must outlive the result.
std::vector<FilledPoints> filled_points(const Measured* measured, double x0, double y0,
                                        const Indenter& indenter);

// Share of the contact area that is on filled points: of the pixels under pressure of elements, or
// of the points of the first map within the contact spots of asperities, or, if that is larger, of
// the points where Gaussian heights of rms sigma would reach the indenter: the filling is smooth
// and low, so that contact avoids it.
double share_on_filled(const Level& level, std::span<const FilledPoints> maps,
                       const Indenter& indenter, double sigma);

}  // namespace rsc
