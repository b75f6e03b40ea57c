// Defects of measured maps: missing points, outliers, rounded heights, and breaks.
#pragma once

#include "surface/surface.hpp"

namespace rsc {

// Number of points whose height is NaN.
long count_missing(const HeightMap& map);

// Outliers are single points or small groups of points far from their neighbours, caused by dust or
// lost light.
struct Outliers {
    long count = 0;        // all of them
    long islands = 0;      // of these in small groups of points alone inside a missing part
    double threshold = 0;  // [length]
};

// Sets outliers to NaN. An outlier differs from what the 5 x 5 points around it (near the border of
// the map fewer) make likely, the median of the mean heights of opposite points, by more than
// `times` the standard deviation of these differences, estimated from their 90 % quantile, and of
// rounded heights. On the border straight lines through two neighbours take the place of the
// median. Missing points are ignored. Groups of at most 12 points without any other around them are
// outliers where they differ by more from the harmonic function of the heights around the hole.
Outliers remove_outliers(HeightMap& map, double times);

// Fills missing points with the discrete harmonic function of the heights around them: every filled
// point is the mean of its neighbours (four inside the map, fewer at its edges), weighted by 1/dx^2
// and 1/dy^2. Solved by conjugate gradients to 1e-12. Points that are alone get the mean of the
// polynomials through four points on either side along their row and column. Returns a mask of the
// filled points, 1 at j*nx + i, or an empty vector if no point is missing. Throws Error(bad_input)
// if all are missing.
std::vector<std::uint8_t> fill_missing(HeightMap& map);

// Leaves of a mask of filled points those more than `steps` steps along rows and columns away from
// all others, and empties it if there are none. Nearer to measured points the filling follows the
// surface; deep in a hole its roughness is missing.
void keep_depths(std::vector<std::uint8_t>& filled, int nx, int ny, int steps);

// Rounding step of the heights: all differences of neighbouring heights are multiples of it. 0
// unless many neighbours have equal heights.
// Missing points (NaN) are ignored. To be called before a form is subtracted.
double height_step(const HeightMap& map);

// Removes the rounding noise from a map whose heights are multiples of `step`, by a Wiener filter
// on its cosine series. Rounding adds white noise of variance step^2/12. Waves of little more power
// are damped; the first ring without more power and all shorter waves are removed.
void smooth_rounded(HeightMap& map, double step);

// Transforms a map without missing points to its waves, lets `damp` multiply them by their gains
// times `scale`, and transforms back. The waves are nx x ny numbers, row by row: the cosine series
// of the map, number (i, j) with i and j half waves along its sides, or with `periodic` those of
// FFTW's half-complex format. Throws Error(no_memory) with the purpose.
void damp_waves(HeightMap& map, bool periodic, const char* purpose,
                const std::function<void(double* waves, double scale)>& damp);

// Breaks: places where a map is not smooth on the scale of its grid (pits, spikes, steps).
// Interpolating polynomials overshoot there.
struct Breaks {
    enum Kind { pit, spike, step, kKinds };
    struct Place {
        int i = 0, j = 0;
        bool along_x = true;  // a pit (or groove) in the profile along x, otherwise along y
    };
    struct Found {
        long points = 0;
        Place largest;
        double size = 0;  // depth, height or jump of the largest [length]
    };
    std::array<Found, kKinds> found;  // by Kind
    std::vector<Place> pits, spikes;
    // Distance to the nearest spike or step in points, at most kMostClear, at j*nx + i; empty:
    // none.
    std::vector<std::uint8_t> clear;
    static constexpr int kMostClear = 6;
};

// A point is a break if its second difference along x or y exceeds kBreak times the median. A pit
// has a positive second difference larger than those of both neighbours, a spike a negative one
// along both axes; all other breaks are steps. Second differences below a few multiples of the
// rounding step `height_step` (0: heights are not rounded) are ignored.
Breaks find_breaks(const HeightMap& map, double height_step);
inline constexpr double kBreak = 12;

// Raises pits to the polynomial through their neighbours. Their bottoms never touch, and they would
// distort the summits beside them.
void raise_pits(HeightMap& map, const Breaks& breaks);

}  // namespace rsc
