// Proof that the contact problem has only one solution.
//
// Every asperity is assigned a spherical shell of radius rho_i. Separate shells interact as 1/d
// (Newton), so the matrix U of shell energies
// (U_ii = 1/rho_i, U_ij = 1/d_ij, less for overlapping shells) is positive semidefinite. Hence
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

// True if no other solution exists near the given one (penetrations v, negative: no contact;
// forces; slopes) of all candidates. A second solution differs by dF with dF'(B + 1/D')dF = 0,
// where D' is the secant slope of the law between the two, and its penetrations cannot exceed those
// without close partners. The shell test with these secants can prove that there is none. If it
// does not, the box of possible penetrations of a doubtful cluster is bisected, and each part is
// narrowed by the equation until it is empty or passes the test with its own, smaller secants. The
// field of more distant contacts is that of the given solution, within a tenth of the possible
// change by the cluster itself.
bool has_one_solution(const Law& law, const Kernel& kernel, const std::vector<int>& asperity,
                      const std::vector<double>& x, const std::vector<double>& y,
                      const std::vector<double>& v, const std::vector<double>& force,
                      const std::vector<double>& slope);

// What is known of all solutions with penetrations between some bounds, for calls in a loop during
// which little changes: a proof, by the tests of has_one_solution() with the largest secants that
// are possible, and the slack that the bounds leave; or which of several solutions a start that
// defines it leads to. A proof holds for fewer asperities, too, if those between the bounds that
// may touch are the same. The law must not change meanwhile.
class LastingProof {
public:
    // As has_one_solution(). `place`: depth and position of the tip, by which it is decided whether
    // bounds are worth a test.
    bool holds(const Law& law, const Kernel& kernel, const std::vector<int>& asperity,
               const std::vector<double>& x, const std::vector<double>& y,
               const std::vector<double>& v, const std::vector<double>& force,
               const std::vector<double>& slope, const std::array<double, 3>& place);

    // To be called with a solution found from its defining start, because it is not proved to be
    // unique.
    void select(const std::vector<int>& asperity, const std::vector<double>& x,
                const std::vector<double>& y, const std::vector<double>& v);
    // True if v is so near to that solution that the start of the present place leads to v: by less
    // than products of different methods make a difference on the way.
    bool selected(const std::vector<int>& asperity, const std::vector<double>& x,
                  const std::vector<double>& y, const std::vector<double>& v) const;

private:
    struct Bounds {
        struct Asperity {
            double low = 0, high = -kInfinity;  // of its penetration; -Infinity: it has no bounds
            double x = 0,
                   // its place: on a surface that repeats another image may have come near the tip
                y = 0;
        };
        std::vector<Asperity> by_asperity;
        std::size_t touching = 0;   // asperities whose upper bound is positive
        std::vector<int> asperity;  // those with bounds

        // Bounds at a distance of |v| times `share` from v, at least of `width`.
        void set(const std::vector<int>& asperities, const std::vector<double>& x,
                 const std::vector<double>& y, const std::vector<double>& v, double share,
                 double width);
        // `others`: asperities without bounds are of no importance unless they touch.
        bool contain(const std::vector<int>& asperities, const std::vector<double>& x,
                     const std::vector<double>& y, const std::vector<double>& v, bool others) const;
    };
    Bounds proved_, chosen_;
    std::array<double, 3> place_{kInfinity};
    // distance of the bounds from a solution, in its largest penetration; less after a test that
    // failed
    double wide_ = 0.01;
    int waits_ = 0;  // calls until bounds are tested again
};

}  // namespace rsc
