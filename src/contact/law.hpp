// What one asperity answers to a penetration (paper, section 4: Hertz). The solvers know nothing else of an asperity.
#pragma once

#include <memory>

#include "contact/indentation.hpp"

namespace rsc {

// A law is convex and increasing in the penetration u > 0, with force 0 and slope 0 at u = 0. Asperities are named by their
// index in the Asperities the law was made from.
class Law {
public:
    virtual ~Law() = default;

    // For k = 0 .. n-1: force f(u), slope D = df/du and work W = int_0^u f du of asperity[k] at penetration u[k];
    // all three are 0 where u[k] <= 0.
    virtual void respond(int n, const int* asperity, const double* u, double* force, double* slope, double* work) const = 0;

    virtual double force(int asperity, double u) const = 0;
    virtual double area(int asperity, double u) const = 0;  // contact area [length^2]; 0 for u <= 0
};

// Hertz: f = (4/3) E* sqrt(r) u^(3/2), a = sqrt(r u).
std::unique_ptr<Law> make_law(LawKind kind, const Asperities& asperities, double E_star);

}  // namespace rsc
