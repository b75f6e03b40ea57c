// A body that relaxes: E(t) = E [1 - sum g_k (1 - exp(-t/tau_k))], E the instantaneous modulus, Poisson's ratio constant (a generalised
// Maxwell body; Tschoegl, The Phenomenological Theory of Linear Viscoelastic Behavior, 1989).
#pragma once

#include "std.hpp"

namespace rsc {

inline constexpr int kMostRelaxations = 16;

// g_k and tau_k > 0 [time]; the shares are positive and add up to 1 at most. Empty: the body is elastic.
struct Relaxation {
    std::vector<double> share, time;
    double soft = 1;  // share of this body in the compliance of the pair, 1/E*: 1 where the other one is rigid
    bool none() const { return share.empty(); }
};

// The contact of such a body with one that may be elastic. A load f that changes with time deflects as the load
//     f + sum_k y_k,   y_k' = v_k f - lambda_k y_k
// would deflect the instantaneous body: the creep function is J(t)/J(0) = 1 + sum v_k (1 - exp(-lambda_k t))/lambda_k. A displacement w asks
// for the force that
//     g w + sum_k g_k d_k,   d_k' = w' - d_k/tau_k,   g = 1 - sum g_k,
// would take instantaneously. The two belong together: lambda_k are the zeros of the transform of the relaxation function, of which one lies
// below each 1/tau_k; one that is 0 (shares that add up to 1) is viscous flow, J ~ t.
class Creep {
public:
    // Throws Error(bad_input) for lists that are no such body.
    explicit Creep(const Relaxation& body);

    double compliance(double t) const;  // J(t)/J(0)
    double modulus(double t) const;     // E*(t)/E*(0)

    struct Retardation {
        double rate = 0;  // lambda_k [1/time]
        double flow = 0;  // v_k [1/time]
    };
    struct Branch {
        double share = 0, rate = 0;  // g_k of the pair, 1/tau_k [1/time]
    };
    const std::vector<Retardation>& retardations() const { return retardations_; }
    const std::vector<Branch>& branches() const { return branches_; }
    double last() const { return last_; }  // g, what never relaxes

private:
    std::vector<Retardation> retardations_;
    std::vector<Branch> branches_;
    double last_ = 1;
};

// What passes in a time dt in which loads, or displacements, change linearly. With dt = 0 nothing passes.
struct Passage {
    Passage(const Creep& creep, double dt);
    double dt;
    // y_k becomes stay y_k + before f_0 + after f_1.
    struct Lag {
        double stay, before, after;
    };
    std::vector<Lag> lags;
    double compliance = 1;  // means over 0 ... dt: what the change of a load deflects by at the end of the step
    // d_k becomes stay d_k + change (w_1 - w_0); its mean over the step is change d_k + mean (w_1 - w_0).
    struct Decay {
        double stay, change, mean;
    };
    std::vector<Decay> decays;
    double modulus = 1;
};

}  // namespace rsc
