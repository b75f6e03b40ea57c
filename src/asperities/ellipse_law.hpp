// Law 'fourth_order' where the indenter is steep: the most loaded ellipse of each summit.
#pragma once

#include "asperities/law.hpp"
#include "asperities/touching.hpp"

namespace rsc {

// Largest number of summits for which ellipses are determined; some milliseconds each.
inline constexpr std::size_t kMostEllipses = 4000;

// Force of a summit as the largest load of an elliptic spot on the heights around it
// (most_loaded.hpp), tabulated at some 120 penetrations.
// Beyond the table's end the stiffness grows with the fourth root of the penetration. Where the
// ellipse of a summit contains lower ones that have asperities of their own, what these carry is
// subtracted, with the penetration that they leave, so that together they carry the load of the
// ellipse. The force is convex in the penetration. Asperities without an ellipse of their own carry
// nothing if they lie in the spot of a higher summit, and otherwise follow `other`.
//
// Summits, heights and the tip are those of `found` and `indenter`; `asperities` are the summits.
// Tables are built by prepare() and depend on neither the order of calls nor the number of threads.
// `spacing`: mean distance of the surface's summits.
//
// `like` (optional) is such a law of the same summits under a tip close by, with tables of all that
// are asked for: ellipses are found from its ellipses, share the same summits, and tables have the
// same nodes.
std::unique_ptr<Law> make_ellipse_law(std::unique_ptr<Law> other, const FoundSummits& found,
                                      const Indenter& indenter, double spacing,
                                      const Law* like = nullptr);

}  // namespace rsc
