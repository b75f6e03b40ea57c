// The contact of the asperities of a rough surface with a sphere, level by level (paper, section 4).
#pragma once

#include <memory>
#include <vector>

#include "contact/indentation.hpp"
#include "contact/interaction/products.hpp"
#include "contact/law/law.hpp"
#include "contact/ranking.hpp"
#include "contact/solver/newton.hpp"

namespace rsc {

class Contact {
public:
    // The asperities must outlive the contact. Throws Error(bad_input) for moduli, radii or options out of range.
    Contact(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options);
    ~Contact();
    Contact(Contact&&) noexcept;

    // The answer at the separation Z0 [length]. It depends on Z0 alone: earlier levels are used as a start where the solution is
    // proved unique, and not otherwise. Never throws for a level that did not converge: see Level::status.
    Level at_separation(double Z0);

    // The separation at which the sphere carries the force N > 0 [force], and the answer there, to the tolerance or to the
    // spacing of floating-point numbers Z0, whichever is coarser.
    Level at_force(double N);

    // dN/dZ0 of the last level (negative; 0 without contact) [force/length].
    double stiffness();

    // Elastic energy of the last level, W = sum W_i(u_i) + F'BF/2 with the work W_i = int_0^u f du of the asperities and the
    // interaction energy: since u + B F = g0, dW/dZ0 = F'dg0/dZ0 = -N, the contact is conservative [force length]. Evaluated as
    // -E(F) of newton.hpp, which equals W at the solution and is in error only by the square of the residual.
    double energy() const;

    // Moves the tip to (x0, y0). The last level goes on as a start for the next where the solution is proved unique.
    void move_tip(double x0, double y0);

    // Z0 at which the sphere touches its first asperity [length]; -Infinity when none lies under it.
    double first_touch() const;

    const Indenter& indenter() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace rsc
