// Newton's method on the active set, globalised by a trust region on the energy (paper's equation F = C<G0 - B F>^(3/2), in
// the penetrations).
//
// Unknown: v, the penetration with interaction at every point of the working set (negative: no contact), F = f(<v>).
//     v + B F(v) = g0                                                                            equation
//     (I + S B S) w = -S res on the active set {v > 0}, S = sqrt(D), D = df/dv, dv = w/S          Newton step
//     E(F) = F'BF/2 + sum(f v - W(v)) - g0'F over F >= 0, dE/dF = res = v + B F - g0              energy
// The energy is coercive on F >= 0 since B has no negative entry, so a minimum always exists; where spots overlap, I + S B S may be
// indefinite. Steihaug's conjugate gradients follow the negative curvature to the border of the trust region; a point where the
// gradient vanishes is accepted only if I + S B S is positive definite there, and left along its lowest eigenvector otherwise.
#pragma once

#include "contact/interaction/products.hpp"
#include "contact/law/law.hpp"

namespace rsc {

// The problem on the working set: point k is asperity[k], at (x[k], y[k]), with penetration g0[k] without interaction.
struct WorkingSet {
    std::vector<int> asperity;
    std::vector<double> x, y, g0;
    int size() const { return static_cast<int>(asperity.size()); }
};

struct NewtonOutcome {
    bool converged = false;
    bool minimum = true;  // second-order condition holds, if it was checked
    int iterations = 0;
    double residual = 0;  // |F - f(<g0 - B F>)| / |F|
};

// |error|/|force|, also where squares overflow or vanish; 1 when there is no force, or none that is finite, and an error.
double relative_residual(const std::vector<double>& error, const std::vector<double>& force);

class Newton {
public:
    explicit Newton(const Law& law) : law_(law) {}

    // The products with B to use from now on; they must outlive their use here.
    void use(Products& products) { products_ = &products; }

    // From v (size of the set), to the solution in v, force(), phi(). Products must have been given the set's points. Whether it is a
    // minimum is asked unless an approximation is all that is wanted, or uniqueness, which says more, is asked afterwards.
    NewtonOutcome solve(const WorkingSet& set, double tolerance, int max_iterations, std::vector<double>& v, bool ask_minimum = true);

    // True if the solution of this set, found by solve() without this check, is a minimum.
    bool at_minimum(const WorkingSet& set);

    // Takes v as the solution found by other means, so that everything below speaks of it. Products as in solve().
    void take(const WorkingSet& set, const std::vector<double>& v);

    double energy() const { return now_.energy; }                    // E(F): second order in the error of F
    const std::vector<double>& force() const { return now_.force; }  // F over the working set
    const std::vector<double>& slope() const { return now_.slope; }  // D over the working set
    const std::vector<double>& phi() const { return now_.phi; }      // B F over the working set

    // At the solution: B F at n other places, in single precision.
    void potential_at(std::size_t n, const double* x, const double* y, double* phi);

    // At the solution: the solution of (I + B D) dv = -1 on the active set gives dN/dZ0 = sum D dv, to the tolerance or the accuracy of
    // full products.
    double stiffness(double tolerance);
    // The same to some 1e-3.
    double rough_stiffness();

private:
    struct State {
        std::vector<double> v, force, slope, work, phi, res;
        std::vector<int> active;
        double energy = 0, scale = 0, residual = 0;
        bool accurate = false;  // phi from a full product
    };
    struct Step {
        std::vector<double> dv;
        double norm = 0;       // of w
        double predicted = 0;  // decrease of the quadratic model
        bool border = false, negative_curvature = false;
    };

    void evaluate(const WorkingSet& set, State& state, bool accurate);
    // True if inner products are accurate enough for a residual of this size.
    bool rough_will_do(double residual) const;
    void step(const WorkingSet& set, const State& state, double forcing, double radius, double entering, Step& out);
    // Products with I + S B S on the active set.
    void multiply(const std::vector<double>& w, std::vector<double>& out);
    // Steihaug's truncated conjugate gradients for (I + S B S) w = b within |w| <= radius.
    void steihaug(const std::vector<double>& b, double forcing, double radius, std::vector<double>& w, Step& out);
    // True if I + S B S is positive definite at the state; otherwise w is its lowest eigenvector.
    bool positive_definite(const WorkingSet& set, const State& state, std::vector<double>& w);
    void leave_saddle(const WorkingSet& set, const std::vector<double>& w);
    void scale_active(const State& state);

    const Law& law_;
    Products* products_ = nullptr;
    State now_, trial_;
    std::vector<double> root_;  // S over the active set
    std::vector<double> force_, phi_, r_, p_, mp_, df_, active_force_, error_, passive_;
};

}  // namespace rsc
