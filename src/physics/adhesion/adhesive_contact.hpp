// Contact of adhesive asperities (JKR, or with a range of the attraction): the deterministic
// multi-asperity model with forces of either sign.
//
// A level is the end of a path on which the separation changes quasi-statically from the last
// accepted level to the requested one. On this path asperities attach when they touch, and detach
// where the equilibrium of the attached ones becomes unstable; this may cause others to attach or
// detach at the same separation (an avalanche, counted as one jump). Each jump is located, so that
// the result does not depend on intermediate levels. A jump dissipates the energy difference of the
// states before and after it.
#pragma once

#include "contact/model.hpp"
#include "surface/asperities.hpp"

namespace rsc {

// Asperities and indenter as for AsperityModel; the work of adhesion is positive. Throws
// Error(bad_input) for options that are not available with adhesion.
//
// energy() is the elastic energy minus w A, with dW/dZ0 = -N; 0 if nothing is attached. If
// asperities are attached, move_tip() follows their state while the tip moves on a straight line at
// the separation of the last accepted level; they attach and detach on the way as on a path of
// separations. The next level includes these jumps. It throws Error(not_converged) if the path is
// lost; the tip then stays where it was. If none is attached, the next level is approached from
// above. The summits of the difference are those of the new place: attached ones come to the
// equilibrium there at the end of the way.
std::unique_ptr<Model> make_adhesive_asperities(const Asperities& asperities,
                                                const Indenter& indenter,
                                                const SolverOptions& options);

}  // namespace rsc
