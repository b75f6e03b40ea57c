// The paper's method (section 4): regularised Newton iteration for the forces with the dense
// matrix, solved by LAPACK dgesv.
#pragma once

#include "asperities/law.hpp"
#include "asperities/newton.hpp"
#include "interaction/kernel.hpp"

namespace rsc {

struct PaperMethod {
    double delta0;     // first regularisation length delta [length]
    double cut;        // delta is divided by this each iteration
    double tolerance;  // for |dF|/|F| and for the unregularised residual
    int max_iterations;
};

struct PaperOutcome : NewtonOutcome {  // iterations: dgesv solves
    bool singular = false;             // dgesv reported a singular matrix
};

// Equations of one iteration at the forces F, v = g0 - B F. The residual is R = F - f(m(v, delta)),
// where the smooth and positive m(x, delta) = delta^2/(2 delta - x) for x < delta, otherwise x,
// replaces <x>. K = dR/dF = I + diag(f'(m) dm/dx) B is n x n, column-major.
void paper_equations(const Law& law, const Kernel& kernel, const WorkingSet& set, double delta,
                     const std::vector<double>& force, const std::vector<double>& v,
                     std::vector<double>& R, double* K);

// Solves for the forces of all points of the set from the no-interaction start F0 = f(<g0>); v
// receives g0 - B F, and slope df/dv. Throws Error(no_memory) if the 8 n^2 bytes cannot be
// allocated.
PaperOutcome solve_by_dgesv(const Law& law, const Kernel& kernel, const WorkingSet& set,
                            const PaperMethod& method, std::vector<double>& v,
                            std::vector<double>& force, std::vector<double>& slope);

}  // namespace rsc
