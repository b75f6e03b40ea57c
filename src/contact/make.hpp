// The paths of contacts of all models and physics: the only place that knows them all.
#pragma once

#include "contact/path.hpp"
#include "surface/surface.hpp"

namespace rsc {

// A contact of asperities, with what options.physics adds to it. The asperities must
// outlive it. Throws Error(bad_input) for moduli, shapes or options out of range.
std::unique_ptr<Path> make_asperity_contact(const Asperities& asperities, const Indenter& indenter,
                                            const SolverOptions& options);
std::unique_ptr<Path> make_asperity_contact(Asperities&&, const Indenter&,
                                            const SolverOptions&) = delete;

// A contact of boundary elements on the points of a map, likewise. The heights must outlive it and
// are not changed.
std::unique_ptr<Path> make_element_contact(const HeightMap& heights, const Indenter& indenter,
                                           const SolverOptions& options);

}  // namespace rsc
