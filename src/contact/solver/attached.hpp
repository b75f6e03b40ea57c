// Adhesive asperities at a given separation: equilibrium of the attached ones.
//
// Unknowns: the state s of every attached asperity (law/sticking.hpp), with its penetration u(s) and force f(s) of either sign.
//     r = g0 - B f - u(s) = 0 over the attached                                                      equations
//     (diag(u') + B diag(f')) ds = r                                                                 Newton step
// The equilibrium is stable if the energy at fixed separation has a minimum as a function of the contact areas. With the stiffness D of the
// asperities at fixed areas and q = D u' - f' > 0, the second derivative is
//     H = Q [diag(u'/q) - B (I + D B)^-1] Q,
// and the Newton matrix is (I + B D) Q^-1 H: both become singular together. The off-diagonal elements of H are not positive, because a
// larger contact pulls on its neighbours; hence H is positive definite if H x = b > 0 has a solution x > 0 (an M-matrix). The
// derivative x = -ds/dZ0, right-hand side 1 in the Newton system, is tried first if contacts are not crowded: b = Q (I + B D)^-1 1 is positive if
// the row sums of B D are below 1.
// Otherwise b = q 1 is tried, with the right-hand side 1 + B D.
// For y = ds f'/p with p = sign(f') sqrt(D |f'|/(|f'| + q))
// the systems are symmetric, with the matrix diag((f' + q)/(|f'| + q)) sign(f') + p B p. Its diagonal is positive for asperities that are
// stable at a given force, negative for those stable only at a given separation. They are solved by MINRES (Paige and Saunders).
//
// Far from equilibrium the areas follow ds/dt = q (u~ - u), where u~ are the penetrations in equilibrium at given areas, u~ - u = (I + B D)^-1
// r. An implicit step of the length 1/mu has the Newton matrix with u' + mu instead of u' and f' + mu D instead of f'; q is the same.
#pragma once

#include "contact/interaction/products.hpp"
#include "contact/law/sticking.hpp"
#include "contact/solver/newton.hpp"

namespace rsc {

class AttachedSolver {
public:
    explicit AttachedSolver(const Sticking& law) : law_(law) {}

    // Sets the products with B. The shift() of their kernel is subtracted, because the true B, which may raise points, is required. Their
    // points must be those of the set, and the active points the attached ones, when the functions below are called.
    void use(Products& products) { products_ = &products; }

    // Solves for a stable equilibrium from the states s of the attached asperities. Returns false if none was found near; s is then
    // undefined, and weakest() is the position among the attached of the one that becomes unstable.
    bool solve(const WorkingSet& set, double tolerance, std::vector<double>& s);
    std::size_t weakest() const { return weakest_; }
    // For states s far from equilibrium: contacts grow and shrink slowly, downhill in the energy, until s is a stable equilibrium or an
    // asperity has shrunk to nothing; `gone` is then its position among the attached. Returns nothing if it does not end, for example on an
    // equilibrium that cannot be proved to be stable because contacts overlap.
    struct Relaxed {
        std::optional<std::size_t> gone;
    };
    std::optional<Relaxed> relax(const WorkingSet& set, double tolerance, std::vector<double>& s);

    // Results of the last equilibrium.
    const std::vector<Sticking::State>& states() const { return state_; }
    const std::vector<double>& phi() const { return phi_; }  // B f over the set
    double force() const { return force_; }
    double energy() const { return energy_; }  // elastic energy of asperities and interaction minus w A: dW/dZ0 = -N
    double residual() const { return residual_; }

    // Derivatives with respect to the separation, of the last stable equilibrium: ds/dZ0 of the attached, du/dZ0 of the others (Products::passive), dN/dZ0.
    struct Change {
        std::vector<double> s, u;
        double force = 0;
    };
    Change change();

private:
    void evaluate(const WorkingSet& set, const std::vector<double>& s);
    // Solves diag(u') ds + B diag(f') ds = right to the relative accuracy.
    void solve_linear(const std::vector<double>& right, double accuracy, std::vector<double>& ds);
    void multiply(const std::vector<double>& y, std::vector<double>& image);
    void weigh(double mu);  // computes the coefficients of the symmetric systems
    bool stable();

    const Sticking& law_;
    Products* products_ = nullptr;
    std::vector<Sticking::State> state_;
    std::vector<double> phi_, f_, res_;
    double force_ = 0, energy_ = 0, residual_ = 0;
    std::size_t weakest_ = 0;
    std::vector<double> change_;               // ds/dZ0
    std::vector<double> diagonal_, p_, to_s_;  // of the symmetric systems; ds = to_s y
    std::vector<double> in_, out_;
};

}  // namespace rsc
