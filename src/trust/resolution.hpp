// Grid errors of elements.
//
// A surface is solved again on a grid of half as many points a side, at a quarter of the cost. The
// error of elements on a synthetic surface, which has no waves shorter than lambda_s, decreases at
// least as the first power of the grid step: the expected error is half the change of N from the
// coarser grid, and more for contacts of few pixels. A map from a file may have waves shorter than
// its grid; every second point of it is solved, and the expected error, that of a measurement twice
// as fine, is fitted to such changes and to the size of contacts in pixels.
// (Its interpolation to a finer grid has no new waves: changes of N on it are several times smaller
// than those of a finer measurement.) Crests of straight ridges between the points have errors of
// their own (Crests), because both grids may miss them by the same height.
#pragma once

#include "contact/contact.hpp"
#include "contact/level.hpp"
#include "run/job.hpp"
#include "run/prepare.hpp"
#include "surface/measured.hpp"

namespace rsc {

// A level is out_of_validity if N of elements changes by more than this with the grid.
inline constexpr double kUnresolved = 0.01;

// Expected relative errors of N and A.
struct GridError {
    double force = 0, area = 0;
};

// A contact of elements on a second grid.
class OtherGrid {
public:
    // `map`: the heights of the contact, at points_per_wave if synthetic; they must outlive this
    // object. If there is no second grid (a map of few points, a periodic one of an odd number of
    // them, adhesion), error() returns nothing.
    OtherGrid(const Job& job, std::int64_t number, int threads, const HeightMap& map,
              double points_per_wave);
    // Uses an existing contact: `coarse` has half the points a side of the contact to be checked.
    explicit OtherGrid(std::unique_ptr<Contact> coarse) : contact_(std::move(coarse)) {}
    ~OtherGrid();

    bool exists() const { return contact_ != nullptr; }
    // Expected errors of a level by elements. None without a second grid, or if the solver does not
    // converge on it.
    std::optional<GridError> error(const LevelValues& level);
    // Solves a level that is not checked, but changes the path: a reversal of the path of a surface
    // that yields.
    void visit(double separation);

private:
    std::optional<HeightMap> map_;
    std::unique_ptr<Contact> contact_;
    bool coarser_ = true, read_ = false;
    bool by_force_ = false;  // a body that relaxes follows the forces of the levels
    double edge_ = 0;        // share of N by the places of the pixels at the edge of the indenter
};

// Errors of contacts on ridges, whose crests lie between the points: a contact one or two points
// wide and many long has the error of one of few pixels.
class Crests {
public:
    Crests(const Job& job, const HeightMap& map);
    // Lower bounds of the expected errors of a level, from its contacts and its stiffness; 0
    // without contact.
    GridError error(const Level& level) const;

private:
    double height(int column, int row) const;

    const HeightMap& map_;
    const Indenter& indenter_;
    // synthetic surfaces: mean of the second derivatives at points of height 1, with a minus
    // [1/length^2]
    Tensor bend_ = {};
};

// Checks the levels of a run one after the other: each gets the error of the last level that was
// solved on the second grid. The check is repeated once contacts have grown or shrunk.
class ResolutionCheck {
public:
    ResolutionCheck(const Job& job, std::int64_t number, int threads, const HeightMap& map);
    // Sets force_error_expected and area_error_expected of level `step` and raises its status if
    // they are too large.
    void judge(std::size_t step, Level& level, const Crests& ridges);

private:
    const Job& job_;
    OtherGrid other_;
    std::optional<GridError> last_;
    double pixels_ = 0;  // pixels_per_contact of that check
};

// The same without a second grid, for campaigns and with adhesion: the part of the errors that
// contacts of few pixels, of the given side [length], have, and those at the edge of the indenter.
// With adhesion it is added to that of the attraction, and a level is out_of_validity beyond
// kMuchError.
void judge_pixels(Level& level, const Job& job, double side, const Crests& ridges);

// The check of a level for missing points of its map, which are not part of the contact.

// A level is out_of_validity if a larger share of the contact area than this is, or would be, on
// filled points.
inline constexpr double kMuchFilled = 0.01;

// The filled points of a map.
struct FilledPoints : PointGrid {
    const std::vector<std::uint8_t>* filled;  // 1 at index(i, j)
    bool periodic;
    bool second;                        // of body 2
    bool at(double x, double y) const;  // whether the nearest point is filled
};
// Those of the maps of both bodies, if any; `measured`: of body 1, may be null. The job and it must
// outlive them.
std::vector<FilledPoints> filled_points(const Job& job, const Measured* measured);

// Sets filled_share of a level on maps with filled points, and raises its status if it is too
// large: their share of the pixels under pressure of elements, or of the points of the first map
// within the contact spots of asperities, or, if that is larger, of the points where Gaussian
// heights of rms sigma would reach the indenter: the filling is smooth and low, so that contact
// avoids it.
void judge_filled(Level& level, std::span<const FilledPoints> maps, const Indenter& indenter,
                  double sigma);

}  // namespace rsc
