// A small dense system of equations.
#pragma once

#include "check.hpp"

// Solves A x = b by elimination; A is n x n.
template <class Real>
std::vector<Real> solved(std::vector<Real> A, std::vector<Real> b) {
    const std::size_t n = b.size();
    for (const std::size_t k : indices(n)) {
        std::size_t pivot = k;
        for (std::size_t i = k; i < n; ++i)
            if (std::abs(A[i * n + k]) > std::abs(A[pivot * n + k])) pivot = i;
        for (const std::size_t j : indices(n)) std::swap(A[k * n + j], A[pivot * n + j]);
        std::swap(b[k], b[pivot]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const Real q = A[i * n + k] / A[k * n + k];
            for (std::size_t j = k; j < n; ++j) A[i * n + j] -= q * A[k * n + j];
            b[i] -= q * b[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) b[k] -= A[k * n + j] * b[j];
        b[k] /= A[k * n + k];
    }
    return b;
}

// The same with the rows of A apart.
template <class Real>
std::vector<Real> solved(const std::vector<std::vector<Real>>& rows, const std::vector<Real>& b) {
    std::vector<Real> A;
    for (const auto& row : rows) A.insert(A.end(), row.begin(), row.end());
    return solved(A, b);
}
