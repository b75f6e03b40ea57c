// Asperities that stick, at given grips: the equilibrium of those that are attached.
//
// Unknown: s, the state of every attached asperity (law/sticking.hpp), with its penetration u(s) and its force f(s) of either sign.
//     r = g0 - B f - u(s) = 0 over the attached                                                      equations
//     (diag(u') + B diag(f')) ds = r                                                                 Newton step
// The equilibrium is stable if the energy at fixed grips, as a function of the contact areas, has a minimum there. With the asperities'
// stiffness D at fixed areas and q = D u' - f' > 0 its second derivative is
//     H = Q [diag(u'/q) - B (I + D B)^-1] Q,
// and the Newton matrix is (I + B D) Q^-1 H: both become singular together. A larger contact pulls on its neighbours, so no element of H
// off the diagonal is positive, and then H is positive definite if H x = b > 0 has a solution x > 0 (an M-matrix). With b = q 1 this is
// one more system with the Newton matrix, of right-hand side 1 + B D.
// In y = ds f'/p with p = sign(f') sqrt(D |f'|/(|f'| + q)) the systems are symmetric, with the matrix diag((f' + q)/(|f'| + q)) sign(f') + p B p:
// positive where an asperity would be stable under a given force, negative where only the grips hold it. Paige and Saunders' MINRES solves them.
#pragma once

#include "contact/interaction/products.hpp"
#include "contact/law/sticking.hpp"
#include "contact/solver/newton.hpp"

namespace rsc {

class AttachedSolver {
public:
    explicit AttachedSolver(const Sticking& law) : law_(law) {}

    // How products with B are taken from now on, less shift() of their kernel: it is the true B, which may raise a place. They must have
    // been given the points of the set, and the attached as active ones, before anything below is asked.
    void use(Products& products) { products_ = &products; }

    // From the states s of the attached to a stable equilibrium. False: none was found near; s is then undefined, and weakest() the
    // place among the attached of the one that gives way.
    bool solve(const WorkingSet& set, double tolerance, std::vector<double>& s);
    std::size_t weakest() const { return weakest_; }

    // Of the last equilibrium.
    const std::vector<Sticking::State>& states() const { return state_; }
    const std::vector<double>& phi() const { return phi_; }  // B f over the set
    double force() const { return force_; }
    double energy() const { return energy_; }  // elastic energy of asperities and interaction less w A: dW/dZ0 = -N
    double residual() const { return residual_; }

    // Its change with the separation: ds/dZ0 of the attached, du/dZ0 of the others (Products::passive), dN/dZ0.
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
    bool stable();

    const Sticking& law_;
    Products* products_ = nullptr;
    std::vector<Sticking::State> state_;
    std::vector<double> phi_, f_, res_;
    double force_ = 0, energy_ = 0, residual_ = 0;
    std::size_t weakest_ = 0;
    std::vector<double> diagonal_, p_, to_s_;  // of the symmetric systems; ds = to_s y
    std::vector<double> in_, out_;
};

}  // namespace rsc
