// Wrappers of the LAPACK routines used by rsc, and the lowest eigenvalue of an operator.
#pragma once

#include "base/std.hpp"

namespace rsc::lapack {

// Solves A x = b in place by dgesv (A: n x n, column-major, overwritten). Returns false if A is
// singular to working precision.
bool solve(int n, double* A, double* b, std::vector<int>& pivots);

// True if the symmetric matrix A (n x n, overwritten) is positive definite, by dpotrf. A must be
// finite.
bool is_positive_definite(int n, double* A);

// Lowest eigenvalue of a symmetric operator, used to distinguish minima from saddles: Lanczos
// iteration with full reorthogonalisation and a fixed start. It stops as soon as the sign of the
// lowest eigenvalue is certain. Returns the lowest Ritz value minus its error bound if that is
// positive, the Ritz value itself if it is negative; `vector` receives the Ritz vector (unit
// length).
double lanczos_lowest(
    std::size_t n,
    const std::function<void(const std::vector<double>&, std::vector<double>&)>& multiply,
    std::vector<double>& vector);

}  // namespace rsc::lapack
