// The contact of the asperities of a rough surface with a sphere, level by level (paper, section 4).
#pragma once

#include <memory>
#include <vector>

#include "contact/indentation.hpp"
#include "contact/law.hpp"
#include "contact/newton.hpp"
#include "contact/products.hpp"

namespace rsc {

// Penetration without interaction, g0_i = height_i - Z0, of an asperity under the sphere whose tip is at (x0, y0):
// height_i = z_i + sqrt(R^2 - rho_i^2) - R; -Infinity outside the sphere (rho > R).
double height_under_sphere(const Indenter& indenter, double x, double y, double z);

class Contact {
public:
    // The asperities must outlive the contact. Throws Error(bad_input) for moduli, radii or options out of range.
    Contact(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options);
    ~Contact();
    Contact(Contact&&) noexcept;

    // The answer at the separation Z0 [length]. It depends on Z0 alone: earlier levels are used as a start where the solution is
    // proved unique, and not otherwise. Never throws for a level that did not converge: see Level::status.
    Level at_separation(double Z0);

    // The separation at which the sphere carries the force N > 0 [force], and the answer there.
    Level at_force(double N);

    // dN/dZ0 of the last level (negative) [force/length].
    double stiffness();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace rsc
