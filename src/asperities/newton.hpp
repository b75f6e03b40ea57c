// Newton's method on the active set, globalised by a trust region on the energy, for the paper's
// equation F = C<G0 - B F>^(3/2) in terms of penetrations.
//
// Unknowns: the penetrations v with interaction at all points of the working set (negative: no
// contact); F = f(<v>).
//     equation:     v + B F(v) = g0
//     Newton step:  (I + S B S) w = -S res on the active set {v > 0},
//                   S = sqrt(D), D = df/dv, dv = w/S
//     energy:       E(F) = F'BF/2 + sum(f v - W(v)) - g0'F over F >= 0,
//                   dE/dF = res = v + B F - g0
// B has no negative elements, so the energy is coercive on F >= 0 and has a minimum. I + S B S may
// be indefinite if spots overlap: Steihaug's conjugate gradients follow negative curvature to the
// border of the trust region. A stationary point is accepted only if I + S B S is positive definite
// there; otherwise it is left along the lowest eigenvector.
#pragma once

#include "asperities/law.hpp"
#include "interaction/products.hpp"

namespace rsc {

// Working set: point k is asperity[k] at (x[k], y[k]), with the penetration g0[k] without
// interaction.
struct WorkingSet {
    std::vector<int> asperity;
    std::vector<double> x, y, g0;
    int size() const { return int(asperity.size()); }
    void reserve(std::size_t n) {
        asperity.reserve(n);
        x.reserve(n);
        y.reserve(n);
        g0.reserve(n);
    }
    void clear() {
        asperity.clear();
        x.clear();
        y.clear();
        g0.clear();
    }
};

struct NewtonOutcome {
    bool converged = false;
    bool minimum = true;  // the second-order condition holds (if it was checked)
    int iterations = 0;
    double residual = 0;  // |F - f(<g0 - B F>)| / |F|
};

// |error|/|force|, without overflow or underflow of squares; 1 if the force is zero or not finite
// but the error is not zero.
double relative_residual(const std::vector<double>& error, const std::vector<double>& force);

class Newton {
public:
    explicit Newton(const Law& law) : law_(law) {}

    // Sets the products with B, which must remain valid.
    void use(Products& products) { products_ = &products; }

    // Solves from the start v (size of the set); the solution is in v, force() and phi(). The
    // products must have the points of the set. ask_minimum = false omits the test for a minimum,
    // for approximations or if uniqueness is tested afterwards.
    NewtonOutcome solve(const WorkingSet& set, double tolerance, int max_iterations,
                        std::vector<double>& v, bool ask_minimum = true);

    // True if the solution of this set, found by solve() without this check, is a minimum.
    bool at_minimum(const WorkingSet& set);

    // Sets v as the solution, to which the functions below then refer. Products as in solve().
    void take(const WorkingSet& set, const std::vector<double>& v);

    // E(F), with an error of second order in that of F.
    double energy() const { return now_.energy; }

    const std::vector<double>& force() const { return now_.force; }  // F over the working set
    const std::vector<double>& slope() const { return now_.slope; }  // D over the working set
    const std::vector<double>& phi() const { return now_.phi; }      // B F over the working set

    // B F of the solution at n other points, in single precision.
    void potential_at(std::size_t n, const double* x, const double* y, double* phi);

    // dN/dZ0 = sum D dv at the solution, where (I + B D) dv = -1 on the active set, to the
    // tolerance or the accuracy of full products.
    double stiffness(double tolerance);

    // After stiffness(): dv/dZ0 at the active points.
    std::vector<double> sinking() const;

    template <class Archive, class Self>
    static void archive(Archive& a, Self& newton) {
        auto& now = newton.now_;
        a(now.v, now.force, now.slope, now.work, now.phi, now.res, now.active, now.energy,
          now.scale, now.residual, now.accurate);
    }
    // Whether an archived solution is one of n points.
    bool fits(std::size_t n) const {
        for (const auto* of : {&now_.v, &now_.force, &now_.slope, &now_.phi, &now_.res})
            if (of->size() != n) return false;
        return std::ranges::all_of(now_.active, [n](int k) { return k >= 0 && at(k) < n; });
    }

private:
    struct State {
        std::vector<double> v, force, slope, work, phi, res;
        std::vector<int> active;
        double energy = 0, scale = 0, residual = 0;
        bool accurate = false;  // phi is from a full product
    };
    struct Step {
        std::vector<double> dv;
        double norm = 0;       // norm of w
        double predicted = 0;  // decrease of the quadratic model
        bool border = false, negative_curvature = false;
    };

    // Limits |w|, and the share of the penetration that asperities without force may gain.
    struct TrustRegion {
        double radius = kInfinity, entering = 1;
    };

    bool descend(const WorkingSet& set, double forcing, TrustRegion& trust);
    void evaluate(const WorkingSet& set, State& state, bool accurate);
    // True if inner products are accurate enough for a residual of this size.
    bool rough_will_do(double residual) const;
    void step(const WorkingSet& set, const State& state, double forcing, double radius,
              double entering, Step& out);
    // Products with I + S B S on the active set.
    void multiply(const std::vector<double>& w, std::vector<double>& out);
    // Steihaug's truncated conjugate gradients for (I + S B S) w = b within |w| <= radius.
    void steihaug(const std::vector<double>& b, double forcing, double radius,
                  std::vector<double>& w, Step& out);
    // True if I + S B S is positive definite at the state; otherwise w is its lowest eigenvector.
    bool positive_definite(const WorkingSet& set, const State& state, std::vector<double>& w);
    void leave_saddle(const WorkingSet& set, const std::vector<double>& w);
    void scale_active(const State& state);

    const Law& law_;
    Products* products_ = nullptr;
    State now_, trial_;
    std::vector<double> root_, sinking_;  // S over the active set; S dv/dZ0
    std::vector<double> force_, phi_, r_, p_, mp_, df_, active_force_, error_, passive_;
};

}  // namespace rsc
