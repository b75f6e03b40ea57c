// Summits touched by an indenter: those of the difference between the surface and the indenter's
// face.
#pragma once

#include "contact/level.hpp"
#include "surface/asperities.hpp"
#include "surface/detection.hpp"

namespace rsc {

// The indenter as body above a surface in the search for summits.
class Face final : public BodyAbove {
public:
    explicit Face(const Indenter& indenter) : indenter_(indenter) {}
    void row(int n, double x0, double dx, double y, double* height) const override;
    Form at(double x, double y) const override;
    std::unique_ptr<BodyAbove> transposed() const override;
    bool periodic() const override {
        return indenter_.period.finite() || indenter_.around.finite();
    }

private:
    Indenter indenter_;
};

// Summits of a difference, and the heights of the surface between them.
struct FoundSummits {
    Asperities summits;
    std::shared_ptr<const HeightMap> map;  // null if the heights are not kept
    double points_per_wave = 0;            // of the map, in its shortest wave; 0: unknown
    int threads = 1;                       // for work on the heights
    std::shared_ptr<const Breaks> breaks;  // of a measured map
    double lay = 0;                        // of the surface, as in SummitCount
    bool renumbered = false;               // their number and order are not those of the surface
};

// Finds the summits of the surface minus the face of an indenter. Empty for asperities given as a
// list, without a surface.
using SummitSearch = std::function<FoundSummits(const Indenter&)>;

// Largest ratio of the slope of the indenter's face to the rms slope of the surface at which
// moved_summits() is used; above it, and beside the corner of a cone, summits of the difference
// appear and vanish.
inline constexpr double kMostSlopeRatio = 0.2;

// Summits of the difference from those of the surface, to second order in the gradient g of the
// face. With the curvatures H of a summit and C of the face, H' = H + C, a summit is displaced by
// -H'^-1 g and has the curvatures H'. Summits outside the face, or where the difference has none,
// are unchanged. Number and order are those of the surface.
Asperities moved_summits(const Asperities& of_surface, const Indenter& indenter);

// Adds to the summits found of the difference those of the surface that have none near: on the
// flanks of a steep face, where the difference has no summits, they are what the contact comes to
// when it is pressed further. `spacing`: mean distance of the surface's summits; `period`: that of
// the surface.
void add_flanks(Asperities& found, const Asperities& of_surface, double spacing,
                const Period& period);

// Largest slope of the face above asperities with a clearance above `least`; 0 if there are none.
double steepest_above(const Asperities& asperities, const Indenter& indenter, double least);

// Largest slope of the face at the contacts of a level; 0 if there are none.
double steepest_contact(const Level& level, const Indenter& indenter);

}  // namespace rsc
