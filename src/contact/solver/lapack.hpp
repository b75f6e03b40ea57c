// Wrappers of the LAPACK routines used by rsc.
#pragma once

#include "std.hpp"

namespace rsc::lapack {

// Solves A x = b in place by dgesv (A: n x n, column-major, overwritten). Returns false if A is singular to working precision.
bool solve(int n, double* A, double* b, std::vector<int>& pivots);

// True if the symmetric matrix A (n x n, overwritten) is positive definite, by dpotrf. A must be finite.
bool is_positive_definite(int n, double* A);

// Lowest eigenvalue and its unit eigenvector of the symmetric tridiagonal matrix with the diagonal alpha and off-diagonal beta.
double lowest_of_tridiagonal(std::vector<double> alpha, std::vector<double> beta, std::vector<double>& vector);

}  // namespace rsc::lapack
