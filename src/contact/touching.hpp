// The summits that an indenter touches: those of the difference between the surface and the indenter's face, not those of the surface.
#pragma once

#include "contact/level.hpp"
#include "rough/asperities.hpp"
#include "rough/detection.hpp"

namespace rsc {

// The indenter as the body above a surface, for the search for summits. The indenter must outlive it.
class Face final : public BodyAbove {
public:
    explicit Face(const Indenter& indenter) : indenter_(indenter) {}
    void row(int n, double x0, double dx, double y, double* height) const override;
    Form at(double x, double y) const override;
    bool periodic() const override { return indenter_.period.finite() || indenter_.around.finite(); }

private:
    const Indenter& indenter_;
};

// Finds the summits of the surface less the face of an indenter. Empty for asperities of a list: of those nothing more is known.
using SummitSearch = std::function<Asperities(const Indenter&)>;

// Largest slope of the indenter's face, over the surface's rms slope, at which the summits of the difference are the surface's own moved
// to second order; from there on some appear and others vanish.
inline constexpr double kMostSlopeRatio = 0.2;

// The summits of the difference from those of the surface, to second order in the slope g of the face: with H the curvatures of a summit and C
// those of the face, H' = H + C, the summit lies H'^-1 g away from the surface's, where g points uphill, and has the curvatures H'. Those
// where the face does not reach, or would leave no summit, stay as they are. As many as the surface's, in their order.
Asperities moved_summits(const Asperities& of_surface, const Indenter& indenter);

// Adds to the summits found of the difference those of the surface that have none near: on the flanks of a steep face, where the difference has no
// summits, they are what the contact comes to when it is pressed further. `spacing`: mean distance of the surface's summits; `period`: in which
// the surface repeats.
void add_flanks(Asperities& found, const Asperities& of_surface, double spacing, const Period& period);

// Largest slope of the face above asperities it may touch, those with a clearance above `least`; 0 without any.
double steepest_above(const Asperities& asperities, const Indenter& indenter, double least);

// Largest slope of the face at the contacts of a level; 0 without any.
double steepest_contact(const Level& level, const Indenter& indenter);

}  // namespace rsc
