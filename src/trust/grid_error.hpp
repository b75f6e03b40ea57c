// Grid errors of elements.
//
// A level is solved again on every second point along both sides, at a quarter of the cost. The
// error of elements on a synthetic surface, which has no waves shorter than lambda_s, decreases at
// least as the first power of the grid step, so that it is at most the change of N from the coarser
// grid; it is more for contacts of few pixels. A map from a file may have waves shorter than its
// grid; the expected error, that of a measurement twice as fine, is fitted to such changes and to
// the size of contacts in pixels. (Its interpolation to a finer grid has no new waves: changes of N
// on it are several times smaller than those of a finer measurement.) Crests of straight ridges
// between the points have errors of their own, because both grids may miss them by the same height.
#pragma once

#include "contact/path.hpp"
#include "surface/surface.hpp"

namespace rsc {

// Expected relative errors of N and A at a separation.
struct GridError {
    double force = 0, area = 0;
};

struct PlaceOfTip {
    double x, y;
    friend bool operator==(const PlaceOfTip&, const PlaceOfTip&) = default;
};

// Every second point of a map, those that leave out its highest point under the indenter, so that
// a mirrored map has the mirrored points. Periodic maps of odd numbers of points have half of them,
// rounded up, with two neighbours among them once in each row and column.
HeightMap coarser_map(const HeightMap& map, const Indenter& indenter);

// Side of the smallest map that is solved on a coarser grid, in points.
inline constexpr int kFewestPoints = 6;

// The contact of a map on its coarser grid.
class SecondGrid {
public:
    // The map must outlive this object and have at least kFewestPoints a side. `read`: it was
    // measured.
    SecondGrid(const HeightMap& map, const Indenter& indenter, const SolverOptions& options,
               bool read);

    // Expected errors of a level of `contact` from the coarser grid, at the same separation or
    // under the same force; those of the force as an error of N at the separation. None if the
    // solver does not converge on that grid.
    std::optional<GridError> error(const LevelValues& level, Path& contact, bool by_force);
    Path::State state() const { return contact_->state(); }
    void forget() { contact_->forget(); }
    void restore(const Path::State& state) { contact_->restore(state); }
    void start_from(const Level& level) { contact_->start_from(level); }

private:
    HeightMap map_;
    bool read_;
    std::unique_ptr<Path> contact_;
};

// The part of the errors of N and A that contacts of few pixels, of the given side [length], have,
// and those at the edge of the indenter, without a second grid.
GridError error_of_pixels(const LevelValues& level, const Indenter& indenter, double side,
                          bool read);

// Lower bounds of the errors of contacts on ridges, whose crests lie between the points: a contact
// one or two points wide and many long has the error of one of few pixels. `stiffness` is dN/dZ0.
// `curvature`: of synthetic surfaces, of which not all heights need be kept, the mean of the second
// derivatives at points of unit height.
GridError error_of_crests(const Level& level, double stiffness, const HeightMap& map,
                          const Indenter& indenter, const std::optional<Tensor>& curvature);

// Upper bound of the Z0 at which the bodies touch, between points too: a summit or a crest between
// two points rises above them by at most half of what they fall to their other neighbours.
double touch_between_points(const HeightMap& map, const Indenter& indenter);

}  // namespace rsc
