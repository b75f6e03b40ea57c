// Proof that the contact problem has only one solution.
//
// Every asperity is assigned a spherical shell of radius rho_i. Separate shells interact as 1/d
// (Newton), so the matrix U of shell energies (U_ii = 1/rho_i, U_ij = 1/d_ij, less for overlapping
// shells) is positive semidefinite. Hence
//     I + S B S, S_i^2 = 2 E* a_i, (S B S)_ij = (2/pi) sqrt(a_i a_j)/d_ij
// is I - (2/pi) diag(a_i/rho_i) + (2/pi) sqrt(a_i a_j) (1/d_ij - U_ij) + a semidefinite part. Only
// pairs with overlapping shells can make it indefinite. With rho_i = 3 (2/pi) a_i the diagonal is
// 2/3, and the sparse matrix of overlaps consists of small clusters. Each is tested by row sums
// (Gershgorin) and, if these do not suffice, by a Cholesky factorisation. The cost is O(n) for n
// contacts.
//
// With periodic boundaries the argument also holds, since each mode of the shell charges has an
// energy >= 0. The neutralising background lies in the plane and not on the shells, which reduces
// the shift c of G by (pi/A)(rho_i + rho_j). c is larger than that if shells are smaller than a
// quarter of the period (contacts an eighth).
//
// A smooth part s of the kernel (layers) belongs to the semidefinite part, since the energy of all
// modes is >= 0 on the layered body as well. The difference between points and shells in s is of
// second order in rho/h, where h is the thickness of the layer; contacts that are not small
// compared with h are out of validity.
#pragma once

#include "asperities/law.hpp"
#include "interaction/kernel.hpp"

namespace rsc {

// True proves that I + S B S is positive definite for contact radii a [length] (0: not in contact);
// false proves nothing.
bool positive_definite_by_shells(const std::vector<double>& x, const std::vector<double>& y,
                                 const std::vector<double>& a, const Period& period = {});

// The parts of the contact that may have another solution near the given one (penetrations v,
// negative: no contact; forces; slopes) of all candidates; none: the solution is unique. Where
// nothing can be proved the part is all of them. A second solution differs by dF with dF'(B +
// 1/D')dF = 0, where D' is the secant slope of the law between the two, and its penetrations cannot
// exceed those without close partners. The shell test with these secants can prove that there is
// none. If it does not, the box of possible penetrations of a doubtful cluster is bisected, and
// each part is narrowed by the equation until it is empty or passes the test with its own, smaller
// secants. The field of more distant contacts is that of the given solution, within a tenth of the
// possible change by the cluster itself.
std::vector<std::vector<std::size_t>> doubtful_parts(
    const Law& law, const Kernel& kernel, const std::vector<int>& asperity,
    const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& v,
    const std::vector<double>& force, const std::vector<double>& slope);

}  // namespace rsc
