// Where an indenter touches the summits of a surface: the second-order shift of each summit.
#pragma once

#include "contact/indentation.hpp"
#include "contact/level.hpp"
#include "surface/asperities.hpp"

namespace rsc {

// Summits of the difference between a surface and the face of an indenter, to second order. Where
// the face has the gradient g and the curvatures C above a summit of curvatures H, the summit of
// the difference has the curvatures H' = H + C and lies at d = -H'^-1 g from that of the surface:
// d maximises -g'd - d'H' d/2. It is sought only in the summit's own range, |d| <= min(1/q,
// `farthest`), q^2 = biharmonic/(kappa1 + kappa2) (law.hpp); at the border of the range d maximises
// the same on that circle. Summits outside the face, or where H' is not positive definite, are
// unchanged. Number and order are those of the surface; a shifted summit depends on that of the
// surface, the indenter and the place of its tip, on nothing else.
class ShiftedSummits {
public:
    // The summits of the surface and the indenter, whose tip may move, must outlive this object.
    // None is shifted yet.
    ShiftedSummits(const Asperities& of_surface, const Indenter& indenter, double farthest);

    // To be called when the tip has moved: none is shifted any more.
    void forget();
    // Finds the place and the height of summit i, unless that was done since the tip moved.
    void shift(std::size_t i);
    // True if the law was prepared for summit i since the tip moved.
    bool prepared(std::size_t i) const { return done_[i] == kPrepared; }
    // Shifts summit i and finds its curvatures, for the law that is prepared for it.
    void shift_and_prepare(std::size_t i);

    // Those that are not shifted have the values of the surface or of another place of the tip.
    const Asperities& summits() const { return shifted_; }

    // Upper bound of what the shift adds to the clearance of a summit (Indenter::clearance) that
    // is above Z0 after it; Infinity: unknown.
    double most_gained(double Z0) const;

private:
    const Asperities& of_surface_;
    const Indenter& indenter_;
    double farthest_;
    bool geometric_;  // the radius is 1/kappa_g, otherwise 1/kappa_a
    double highest_;  // largest z
    Asperities shifted_;
    Asperities one_;            // work space
    std::vector<Tensor> own_;   // curvatures of the summits of the surface; NaN: not computed yet
    std::vector<Tensor> bent_;  // those of the shifted ones
    enum Done : std::uint8_t { kNothing, kShifted, kPrepared };
    std::vector<Done> done_;
    std::vector<std::size_t> which_;  // those with which something is done
};

// Largest slope of the face at the contacts of a level; 0 if there are none.
double steepest_contact(const Level& level, const Indenter& indenter);

}  // namespace rsc
