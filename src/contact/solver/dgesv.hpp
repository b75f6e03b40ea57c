// The paper's method (section 4): regularised Newton on the forces with the dense matrix, every step solved by LAPACK dgesv.
#pragma once

#include "contact/interaction/kernel.hpp"
#include "contact/law/law.hpp"
#include "contact/solver/newton.hpp"

namespace rsc {

struct PaperMethod {
    double delta0;     // first regularisation length delta [length]
    double cut;        // delta is divided by this each iteration
    double tolerance;  // on |dF|/|F| and on the unregularised residual
    int max_iterations;
};

struct PaperOutcome {
    bool converged = false;
    bool singular = false;  // dgesv found no pivot
    int iterations = 0;     // dgesv solves
    double residual = 0;    // |F - f(<g0 - B F>)| / |F|, unregularised
    double delta = 0;       // of the last iteration [length]
};

// One iteration's equations at the forces F, v = g0 - B F: the residual R = F - f(m(v, delta)) with the smooth, positive
// m(x, delta) = delta^2/(2 delta - x) for x < delta, x otherwise, in place of <x>; and K = dR/dF = I + diag(f'(m) dm/dx) B,
// column-major, n x n.
void paper_equations(const Law& law, const Kernel& kernel, const WorkingSet& set, double delta, const std::vector<double>& force,
                     const std::vector<double>& v, std::vector<double>& R, double* K);

// Forces of all points of the set from the no-interaction start F0 = f(<g0>); v receives g0 - B F. Needs 8 n^2 bytes: throws
// Error(no_memory) when they are refused.
PaperOutcome solve_by_dgesv(const Law& law, const Kernel& kernel, const WorkingSet& set, const PaperMethod& method, std::vector<double>& v,
                            std::vector<double>& force);

}  // namespace rsc
