// When the contact problem has one solution only.
//
// Put on every asperity a spherical shell of radius rho_i. Two shells apart interact as 1/d (Newton), so with shell energies U_ij
// (U_ii = 1/rho_i, U_ij = 1/d_ij apart, less where they overlap) the matrix U is positive semidefinite. Hence
//     I + S B S, S_i^2 = 2 E* a_i, (S B S)_ij = (2/pi) sqrt(a_i a_j)/d_ij
// is I - (2/pi) diag(a_i/rho_i) + (2/pi) sqrt(a_i a_j) (1/d_ij - U_ij) + a semidefinite part. The far field never spoils positive
// definiteness: only pairs close enough for their shells to overlap can. With rho_i = 3 (2/pi) a_i the diagonal is 2/3, and the sparse
// matrix of the overlaps, which falls apart into small clusters, decides cluster by cluster: by row sums (Gershgorin) where they
// suffice, by a Cholesky factorisation where they do not. This costs O(n) for n contacts.
//
// With periodic boundaries the same argument holds for shells and images: a mode of the shells' charges has an energy >= 0, and what is left,
// the neutralising background, lies in the plane and not on the shells, which costs (pi/A)(rho_i + rho_j) of the shift c that G has been
// raised by. c is larger while shells are narrower than a quarter of the period, the contacts than an eighth.
//
// A smooth part s of the kernel (layers) goes with the semidefinite part: every wave of the shells' charges has an energy >= 0 on the layered
// body, too. What points feel of s beyond what shells do is of the second order of rho/h, h the thickness of the layer: contacts that are
// not small against it are out of validity.
#pragma once

#include "contact/interaction/kernel.hpp"
#include "contact/law/law.hpp"

namespace rsc {

// True proves that I + S B S is positive definite for contact radii a (0: not in contact) [length]; false decides nothing.
bool positive_definite_by_shells(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& a,
                                 const Period& period = {});

// True if no other solution exists near the given one, for all candidates: penetrations v (negative: no contact), forces and slopes.
// A second solution differs by dF with dF'(B + 1/D')dF = 0, D' the secant slope of the law between the two, and its penetrations
// cannot exceed those left when every close partner lets go. The shells test with these secants proves that there is none; where it
// does not, the box of the penetrations a doubtful cluster may have is bisected, each part narrowed by the equation until it is empty
// or passes the test with its own, smaller secants. The field of what lies further away is taken as that of the given solution, give
// or take a tenth of what the cluster's own may change.
bool has_one_solution(const Law& law, const Kernel& kernel, const std::vector<int>& asperity, const std::vector<double>& x,
                      const std::vector<double>& y, const std::vector<double>& v, const std::vector<double>& force,
                      const std::vector<double>& slope);

}  // namespace rsc
