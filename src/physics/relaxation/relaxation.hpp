// Relaxing (linear viscoelastic) body: E(t) = E [1 - sum g_k (1 - exp(-t/tau_k))] with the
// instantaneous modulus E and constant Poisson's ratio (generalised Maxwell body; Tschoegl, The
// Phenomenological Theory of Linear Viscoelastic Behavior, 1989).
#pragma once

#include "contact/stepper.hpp"

namespace rsc {

inline constexpr int kMostRelaxations = 16;

// Relaxation of body 1: shares g_k > 0, whose sum is at most 1, and times tau_k > 0 [time]. Empty:
// the body is elastic.
struct Relaxation {
    std::vector<double> share = {}, time = {};
    // share of this body in the compliance 1/E* of the pair; 1 if the other one is rigid
    double soft = 1;
    bool none() const { return share.empty(); }
    // The shortest relaxation time with a share; Infinity: there is none.
    double shortest() const {
        double least = kInfinity;
        for (const auto k : indices(share))
            if (share[k] > 0) least = std::min(least, time[k]);
        return least;
    }
};

// Equal steps of time. A step is of second order: with 16 in the shortest relaxation time or more,
// or 16 in all, N of bodies with one and four times, pressed, held and withdrawn, is within 1.1 %,
// mostly 0.4 %.
class TimeSteps final : public Stepper {
public:
    explicit TimeSteps(double shortest_time) : shortest_(shortest_time) {}
    PathClock clock() const override { return PathClock::time; }
    Level follow(const Leg& leg) const override;

private:
    double shortest_;
};

// Contact of a relaxing body with an elastic or rigid one. The deflection under a variable load f
// is that of the instantaneous body under
//     f + sum_k y_k,   y_k' = v_k f - lambda_k y_k
// so that the creep function is J(t)/J(0) = 1 + sum v_k (1 - exp(-lambda_k t))/lambda_k. The force
// for a displacement w is that of the instantaneous body for
//     g w + sum_k g_k d_k,   d_k' = w' - d_k/tau_k,   g = 1 - sum g_k,
// lambda_k are the zeros of the transform of the relaxation function, one below each 1/tau_k. If
// the shares add up to 1, one of them is 0 (viscous flow, J ~ t).
class Creep {
public:
    // Throws Error(bad_input) for invalid shares or times.
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
    double last() const { return last_; }  // g, the share that never relaxes

private:
    std::vector<Retardation> retardations_;
    std::vector<Branch> branches_;
    double last_ = 1;
};

// Coefficients of a time step dt in which loads, or displacements, change linearly; dt = 0:
// instantaneous.
struct Passage {
    Passage(const Creep& creep, double dt);
    double dt;
    // y_k becomes stay y_k + before f_0 + after f_1.
    struct Lag {
        double stay, before, after;
    };
    std::vector<Lag> lags;
    // mean of J(t)/J(0) over 0 ... dt: deflection at the end of the step per change of the load
    double compliance = 1;
    // d_k becomes stay d_k + change (w_1 - w_0); its mean over the step is change d_k + mean (w_1 -
    // w_0).
    struct Decay {
        double stay, change, mean;
    };
    std::vector<Decay> decays;
    double modulus = 1;
};

}  // namespace rsc
