// Grid errors of elements.
//
// A made surface is solved again on a grid of half as many points a side, a quarter of the work; a map read from a file, whose coarser
// points would be another surface, on twice as many, interpolated by its cosine series (rough/surface.hpp). The error of elements decreases
// at least as the first power of the grid step. The expected error is therefore half the change of N from the coarser grid, or the
// whole change to the finer one.
#pragma once

#include "contact/contact.hpp"
#include "contact/level.hpp"
#include "rough/measured.hpp"
#include "run/job.hpp"
#include "run/prepare.hpp"

namespace rsc {

// A level is out_of_validity if N of elements changes by more than this with the grid.
inline constexpr double kUnresolved = 0.01;

// Expected errors of N and A, relative; both are bounds by the argument above.
struct GridError {
    double force = 0, area = 0;
};

// Beside a contact of elements, the same on the other grid.
class OtherGrid {
public:
    // `map`: the heights that the contact stands on, at points_per_wave if they are made. There may be no other grid (a map too large to
    // be worth it, two flats of a map): then error() has nothing.
    OtherGrid(const Job& job, std::int64_t number, int threads, const HeightMap& map, double points_per_wave);
    // Likewise of two contacts that exist: `coarse` has half the points of the one judged.
    explicit OtherGrid(std::unique_ptr<Contact> coarse) : contact_(std::move(coarse)), coarser_(true) {}
    ~OtherGrid();

    bool exists() const { return contact_ != nullptr; }
    // Expected errors of a level by elements. None without another grid, or if it did not converge there.
    std::optional<GridError> error(const LevelValues& level);
    // Solves a level that is not checked, but changes the path: a reversal of the path of a surface that yields.
    void visit(double separation);

private:
    std::optional<HeightMap> map_;
    std::unique_ptr<Contact> contact_;
    bool coarser_ = false;
};

// Judges the levels of a run one after the other: each has the error of the last one that was solved on the other grid, which is done
// anew once contacts have grown or shrunk.
class ResolutionCheck {
public:
    ResolutionCheck(const Job& job, std::int64_t number, int threads, const HeightMap& map);
    // Fills force_error_expected and area_error_expected of level `step` and raises its status where they say so.
    void judge(std::size_t step, Level& level);

private:
    const Job& job_;
    OtherGrid other_;
    std::optional<GridError> last_;
    double pixels_ = 0;  // pixels_per_contact there
};

// The check of a level against the missing points of its map, which the contact itself does not know.

// More of the contact area than this on points that were missing makes a level out_of_validity.
inline constexpr double kMuchFilled = 0.01;

// Fills filled_share of a level on a map with filled points, and raises its status where that is too much. Elements: the pixels under
// pressure; asperities: the points within their spots.
void judge_filled(Level& level, const Measured& map, const Domain& domain);

}  // namespace rsc
