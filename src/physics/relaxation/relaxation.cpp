#include "physics/relaxation/relaxation.hpp"

#include "base/error.hpp"

namespace rsc {
namespace {

// Zero between low and high of a decreasing function.
template <class F>
double zero_between(double low, double high, F&& falling) {
    for (;;) {
        const double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high)) return middle;
        (falling(middle) > 0 ? low : high) = middle;
    }
}

// (1 - exp(-x))/x and (x - 1 + exp(-x))/x^2: means over a step of exp(-t/tau) and of the response
// to a linear change, x = dt/tau.
double decayed(double x) { return x > 0 ? -std::expm1(-x) / x : 1.0; }
double lagged(double x) {
    // below, the fraction suffers from cancellation and five terms of the series are exact
    constexpr double small = 1e-2;
    if (x < small) return 0.5 - x * (1 / 6.0 - x * (1 / 24.0 - x * (1 / 120.0 - x / 720.0)));
    return (1 - decayed(x)) / x;
}

using Branch = Creep::Branch;
constexpr double kRounding = 1e-12;  // of the sum of the shares

// The branches of the body itself, slowest first; equal times are merged. Sets the sum of their
// shares.
std::vector<Branch> branches_of(const Relaxation& body, double& total) {
    if (body.share.size() != body.time.size() || body.share.size() > at(kMostRelaxations))
        bad_input(
            "solids%relaxation_share and relaxation_time must have the same number of "
            "values, at most 16");
    total = 0;
    std::vector<Branch> own;
    for (const auto k : indices(body.share)) {
        if (!(body.share[k] >= 0) || !(body.time[k] > 0) || std::isinf(body.time[k]))
            bad_input(
                "solids%relaxation_share must not be negative, and relaxation_time must be "
                "positive and finite");
        total += body.share[k];
        if (body.share[k] > 0) own.push_back({body.share[k], 1 / body.time[k]});
    }
    if (total > 1 + kRounding)
        bad_input("solids%relaxation_share: the sum of the shares exceeds 1");
    if (!(body.soft > 0 && body.soft <= 1))
        bad_input("solids%relaxation_share: body 1 is rigid and cannot relax");
    std::ranges::sort(own, [](const Branch& a, const Branch& b) { return a.rate < b.rate; });
    for (std::size_t k = own.size(); k-- > 1;) {
        if (own[k].rate > own[k - 1].rate) continue;
        own[k - 1].share += own[k].share;
        own.erase(own.begin() + std::ptrdiff_t(k));
    }
    return own;
}

}  // namespace

Level TimeSteps::follow(const Leg& leg) const {
    const int steps = std::max(1, int(std::ceil(16 * std::min(1.0, leg.length / shortest_))));
    Level level;
    for (int k = 1; k <= steps; ++k) {
        level = leg.solve(double(k) / steps, leg.length / steps, leg.length / steps);
        if (!level.converged) break;
    }
    return level;
}

Creep::Creep(const Relaxation& body) {
    double total;
    const std::vector<Branch> own = branches_of(body, total);
    const double g = 1 - total > kRounding ? 1 - total : 0;

    // The transform at -lambda, g - sum g_k lambda/(1/tau_k - lambda), decreases between its poles
    // 1/tau_k.
    for (const auto k : indices(own)) {
        double lambda = 0;
        if (k > 0 || g > 0)
            lambda = zero_between(k > 0 ? own[k - 1].rate : 0.0, own[k].rate, [&](double at) {
                double sum = g;
                for (const Branch& b : own) sum -= b.share * at / (b.rate - at);
                return sum;
            });
        double steep = 0;
        for (const Branch& b : own)
            steep += b.share * b.rate / ((b.rate - lambda) * (b.rate - lambda));
        retardations_.push_back({lambda, body.soft / steep});
    }
    if (body.soft == 1) {
        branches_ = own;
        last_ = g;
        return;
    }
    // For a pair with an elastic body, the relaxation rates are the zeros of the transform of the
    // creep function, 1 - sum v_k/(rate - lambda_k).
    last_ = retardations_.empty() || retardations_.front().rate > 0 ? 1 / compliance(HUGE_VAL) : 0;
    double flow = 0;
    for (const Retardation& r : retardations_) flow += r.flow;
    for (const auto k : indices(retardations_)) {
        const double high = k + 1 < retardations_.size() ? retardations_[k + 1].rate
                                                         : 2 * (retardations_[k].rate + flow);
        const double rate = zero_between(retardations_[k].rate, high, [&](double at) {
            double sum = -1;
            for (const Retardation& r : retardations_) sum += r.flow / (at - r.rate);
            return sum;
        });
        double steep = 0;
        for (const Retardation& r : retardations_)
            steep += r.flow / ((rate - r.rate) * (rate - r.rate));
        branches_.push_back({1 / (steep * rate), rate});
    }
}

double Creep::compliance(double t) const {
    double sum = 1;
    for (const Retardation& r : retardations_)
        sum += r.rate > 0 ? r.flow * -std::expm1(-r.rate * t) / r.rate : r.flow * t;
    return sum;
}

double Creep::modulus(double t) const {
    double sum = last_;
    for (const Branch& b : branches_) sum += b.share * std::exp(-b.rate * t);
    return sum;
}

Passage::Passage(const Creep& creep, double step) : dt(step), modulus(creep.last()) {
    for (const auto& [rate, flow] : creep.retardations()) {
        const double x = rate * dt, after = flow * dt * lagged(x);
        lags.push_back({std::exp(-x), flow * dt * decayed(x) - after, after});
        compliance += after;
    }
    for (const auto& [share, rate] : creep.branches()) {
        const double x = rate * dt;
        decays.push_back({std::exp(-x), decayed(x), lagged(x)});
        modulus += share * decayed(x);
    }
    if (dt == 0) modulus = 1;  // exactly
}

}  // namespace rsc
