// Stresses on a plane below the pressures of boundary elements, by Fourier transforms.
#pragma once

#include "base/array.hpp"
#include "contact/level.hpp"
#include "physics/stress/stress.hpp"
#include "surface/surface.hpp"

namespace rsc {

// Columns and rows first ... first + count - 1 of a grid.
struct GridWindow {
    int first_column = 0, first_row = 0, columns = 0, rows = 0;
    std::size_t points() const { return at(columns) * at(rows); }
};

// The half-space that is loaded, and how.
struct StressedBody {
    double nu = 0;                 // Poisson ratio of body 1
    SlidingTraction sliding = {};  // traction for a pressure of 1
    Period period = {};            // the pressures repeat with the grid along these axes
};

// Measures of the stress at each point of a window, row by row [force/length^2].
struct StressPlane {
    std::vector<double> mises, shear, tension;
};

// The pressures and six components on a plane, for use at one depth after another.
using StressMemory = std::array<Array<double>, 7>;

// Stresses at `depth` [length] below the points of `window` under the pressures of a level on
// `grid`. If they repeat in both directions, the pressures are taken as band-limited, each mode has
// its closed form, and the mean pressure acts on a body that cannot expand sideways. Otherwise
// Love's and Cerruti's fields of the pixels are added up, in line contact with those of their
// images. `plane`, if given, is set to all values. Returns the largest ones. The
// values in `memory` are of no meaning. Throws
// Error(no_memory). Results do not depend on the number of threads.
LargestStress stress_below(const PointGrid& grid, const LevelPixels& pixels,
                           const StressedBody& body, double depth, const GridWindow& window,
                           StressMemory& memory, StressPlane* plane = nullptr);

// The points at and around the contact where the largest stresses at this depth are sought: those
// within 2 depths, or the radius of the largest contact, of a pixel under pressure along either
// axis, and the nearest 4 at least: the tension at small depths is largest within twice the radius.
// All along an axis of the period. Empty if there is no contact.
GridWindow stressed_window(const PointGrid& grid, const LevelPixels& pixels, const Period& period,
                           double depth);

}  // namespace rsc
