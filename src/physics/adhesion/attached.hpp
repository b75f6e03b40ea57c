// Adhesive asperities at a given separation: equilibrium of the attached ones.
//
// Unknowns: the state s of every attached asperity (sticking.hpp), with its penetration u(s)
// and force f(s) of either sign.
//     r = g0 - B f - u(s) = 0 over the attached
//     equations
//     (diag(u') + B diag(f')) ds = r
//     Newton step
// The equilibrium is stable if the energy at fixed separation has a minimum as a function of the
// contact areas. With the stiffness D of the asperities at fixed areas and q = D u' - f' > 0, the
// second derivative is
//     H = Q [diag(u'/q) - B (I + D B)^-1] Q,
// and the Newton matrix is (I + B D) Q^-1 H: both become singular together. The off-diagonal
// elements of H are not positive, because a larger contact pulls on its neighbours; hence H is
// positive definite if H x = b > 0 has a solution x > 0 (an M-matrix). The derivative x = -ds/dZ0,
// right-hand side 1 in the Newton system, is tried first if contacts are not crowded: b = Q (I + B
// D)^-1 1 is positive if the row sums of B D are below 1. Otherwise b = q 1 is tried, with the
// right-hand side 1 + B D. For nearly incompressible layers on a stiffer body, whose B has small
// negative elements, the sign of those of H is assumed, not proved.
// A cheaper proof is tried before these two. H is congruent to diag(f'/(q D)) + S^-1/D with S = I +
// D^1/2 B D^1/2. Let S be positive definite (asperities/uniqueness.hpp) and U be the asperities
// with f' < 0. Since (S^-1)_UU is at least (S_UU)^-1, it suffices that diag(u'/|f'|) - B_UU is
// positive definite, and as B >= 0 that some v > 0 has u' v > |f'| B v on U. Such a v is found by
// fixed-point iteration from the previous v.
// For y = ds f'/p with p = sign(f') sqrt(D |f'|/(|f'| + q)) the systems are symmetric, with the
// matrix diag((f' + q)/(|f'| + q)) sign(f') + p B p. Its diagonal is positive for asperities that
// are stable at a given force, negative for those stable only at a given separation. They are
// solved by MINRES (Paige and Saunders).
//
// Far from equilibrium the areas follow ds/dt = q (u~ - u), where u~ are the penetrations in
// equilibrium at given areas, u~ - u = (I + B D)^-1 r. An implicit step of the length 1/mu has the
// Newton matrix with u' + mu instead of u' and f' + mu D instead of f'; q is the same.
#pragma once

#include "asperities/newton.hpp"
#include "interaction/products.hpp"
#include "physics/adhesion/sticking.hpp"

namespace rsc {

class AttachedSolver {
public:
    explicit AttachedSolver(const Sticking& law) : law_(law) {}

    // Sets the products with B. The shift() of their kernel is subtracted, because the true B,
    // which may raise points, is required. Their points must be those of the set, and the active
    // points the attached ones, when the functions below are called.
    void use(Products& products) {
        products_ = &products;
        reference_.clear();
        phi_reference_.clear();
        proof_.clear();
        stiffest_.clear();
        room_ = 1.2;
    }

    // Solves for a stable equilibrium from the states s of the attached asperities. Returns false
    // if none was found near; s is then undefined, and weakest() is the position among the attached
    // of the one that becomes unstable. `exact`: forces, phi() and energy() are those of a full
    // product; otherwise its error is below a tenth of the tolerance.
    // `least`: smallest number of Newton steps. If positive, s is the state that rest_on() left
    // apart from a jump, and the rounding errors of that state do not count as convergence.
    bool solve(const WorkingSet& set, double tolerance, bool exact, std::vector<double>& s,
               int least = 0);
    // Takes the forces in the states s as those from whose change further products are found, if
    // the error of their product is below `noise`; otherwise after a full product. The next states
    // then differ from s without that error.
    void rest_on(const WorkingSet& set, double noise, const std::vector<double>& s);
    std::size_t weakest() const { return weakest_; }
    // For states s far from equilibrium: contacts grow and shrink slowly, downhill in the energy,
    // until s is a stable equilibrium or an asperity has shrunk to nothing; `gone` is then its
    // position among the attached. Returns nothing if it does not end, for example on an
    // equilibrium that cannot be proved to be stable because contacts overlap.
    struct Relaxed {
        std::optional<std::size_t> gone;
    };
    std::optional<Relaxed> relax(const WorkingSet& set, double tolerance, std::vector<double>& s);

    // Results of the last equilibrium.
    const std::vector<Sticking::State>& states() const { return state_; }
    const std::vector<double>& phi() const { return phi_; }  // B f over the set
    double force() const { return force_; }
    // elastic energy of asperities and interaction minus w A: dW/dZ0 = -N
    double energy() const { return energy_; }
    double residual() const { return residual_; }
    const std::vector<double>& residuals() const { return res_; }  // g0 - B f - u of the attached

    // Derivatives at the last stable equilibrium, to a relative accuracy, for given rates of g0
    // over the set (-1: with respect to the separation): of s of the attached, of u of the others
    // (Products::passive), of N, and of the power -f'rate at constant rates.
    struct Change {
        std::vector<double> s, u;
        double force = 0, power = 0;
    };
    Change change(const std::vector<double>& rate, double accuracy);

    // For the states of the attached at an equilibrium: dN/dZ0, and the force that a unit approach
    // adds at fixed contact areas, as flat punches that interact.
    double slope(const std::vector<Sticking::State>& states);
    double clamped_stiffness(const std::vector<Sticking::State>& states);

private:
    // Products are those of the change of the forces since the last full product, with the error
    // noise_ in the residual, unless `full`.
    void evaluate(const WorkingSet& set, const std::vector<double>& s, bool full,
                  double negligible = 0);
    void balance(const WorkingSet& set);
    void add_passive();
    void complete(const std::vector<double>& y, std::vector<double>& image,
                  const std::vector<double>& lift) const;
    void judge(const WorkingSet& set);  // norms of the residuals and of their errors out_
    void step(const WorkingSet& set, double accuracy, std::vector<double>& s);  // Newton's method
    // Solves diag(u') ds + B diag(f') ds = right to the relative accuracy. pulled_ and lifted_ are
    // then f' ds and B f' ds.
    void solve_linear(const std::vector<double>& right, double accuracy, std::vector<double>& ds);
    std::vector<double> elevations(
        const std::vector<double>& f);  // B f of the attached, by a full product
    void multiply(const std::vector<double>& y, std::vector<double>& image,
                  std::vector<double>& lift);
    void weigh(double mu);  // computes the coefficients of the symmetric systems
    bool stable(const WorkingSet& set);
    bool apart(const WorkingSet& set);   // S is positive definite
    bool proved(const WorkingSet& set);  // stable by the cheaper proof

    const Sticking& law_;
    Products* products_ = nullptr;
    std::vector<Sticking::State> state_;
    std::vector<double> phi_, f_, res_;
    double force_ = 0, energy_ = 0, residual_ = 0, noise_ = 0;
    std::size_t weakest_ = 0;
    bool weighed_ = false;  // by weigh(), since the states were evaluated
    double mu_ = 0;         // of weigh()
    // by position in the set: D up to which S is known to be positive definite
    std::vector<double> stiffest_;
    double room_ = 1.2;                    // safety factor on stiffest_
    std::vector<double> proof_;            // by position in the set: the last v, a starting point
    std::vector<double> pulled_, lifted_;  // of solve_linear()
    std::vector<double> derivative_;       // -ds/dg0 of the present states, from stable()
    std::vector<double> elevated_;         // B df_
    bool stepped_ = false;   // the present states are one step behind those to be evaluated
    double noise_bent_ = 0;  // relative change of the forces that elevated_ lacks
    // Last full product or rest_on(): active positions, forces, B f over the set, without shift(),
    // and its noise; and the present change of the forces.
    std::vector<int> reference_;
    std::vector<double> f_reference_, phi_reference_, df_;
    double noise_reference_ = 0;
    std::vector<double> diagonal_, p_, to_s_;  // of the symmetric systems; ds = to_s y
    std::vector<double> in_, out_;
};

}  // namespace rsc
