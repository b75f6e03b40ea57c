#include "contact/law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "contact/ellipse.hpp"
#include "error.hpp"

namespace rsc {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

class Hertz final : public Law {
public:
    Hertz(const Asperities& asperities, double E_star) : radius_(asperities.radius), E_star_(E_star), c_(asperities.size()) {}

    void prepare(std::span<const int> asperities) override {
        for (int i : asperities) c_[at(i)] = 4.0 / 3.0 * E_star_ * std::sqrt(radius_[at(i)]);
    }

    void respond(int n, const int* asperity, const double* u, double* force, double* slope, double* work) const override {
        for (int k = 0; k < n; ++k) {
            const double x = std::max(u[k], 0.0);
            const double c_root = c_[at(asperity[k])] * std::sqrt(x);
            force[k] = c_root * x;
            slope[k] = 1.5 * c_root;
            work[k] = 0.4 * force[k] * x;
        }
    }

    double force(int asperity, double u) const override { return u > 0 ? c_[at(asperity)] * u * std::sqrt(u) : 0.0; }
    double area(int asperity, double u) const override { return u > 0 ? std::numbers::pi * radius_[at(asperity)] * u : 0.0; }
    bool beyond(int, double) const override { return false; }

private:
    const std::vector<double>& radius_;
    double E_star_;
    std::vector<double> c_;  // (4/3) E* sqrt(r)
};

// The functions of x^2 = q^2 a^2 in the law of the profile A (1 - J0(q r)); q^2 < 0 makes cosh and sinh of cos and sin.
struct Bessel {
    double load, work;  // 3 (sin x - x cos x)/x^3 and 15 (x/2 + x cos(2x)/4 - 3 sin(2x)/8)/x^5; both 1 at 0
};

Bessel bessel(double x2) {
    if (std::abs(x2) < 1) {  // the closed forms would cancel; what is left out of the series is below 1e-17
        double load = 0, load_term = 1.0 / 3;    // 2 (-x2)^(m-1)/(2m+1)!
        double work = 0, work_term = 1.0 / 120;  // (-4 x2)^(m-1)/(2m+3)!
        for (int m = 1; m < 12; ++m) {
            load += m * load_term;
            load_term *= -x2 / ((2 * m + 2) * (2 * m + 3));
            work += 8 * m * work_term;
            work_term *= -4 * x2 / ((2 * m + 4) * (2 * m + 5));
        }
        return {3 * load, 15 * work};
    }
    const double x = std::sqrt(std::abs(x2));
    const double x3 = x * x * x, x5 = x3 * x * x;
    if (x2 > 0) {
        const double s = std::sin(x), c = std::cos(x);
        return {3 * (s - x * c) / x3, 15 * (0.5 * x + 0.25 * x * std::cos(2 * x) - 0.75 * s * c) / x5};
    }
    const double s = std::sinh(x), c = std::cosh(x);
    return {3 * (x * c - s) / x3, 15 * (0.5 * x + 0.25 * x * std::cosh(2 * x) - 0.75 * s * c) / x5};
}

// The elliptic law is the fourth-order one with q = 0.
class FourthOrder final : public Law {
public:
    FourthOrder(const Asperities& asperities, double E_star, bool quartic)
        : asperities_(asperities), E_star_(E_star), quartic_(quartic), summits_(asperities.size()) {}

    void prepare(std::span<const int> asperities) override {
        for (int i : asperities) {
            const double kappa1 = asperities_.kappa1[at(i)], kappa2 = asperities_.kappa2[at(i)];
            const auto ellipse = ellipse_factors(kappa1 / kappa2);
            Summit& s = summits_[at(i)];
            s.kappa = std::sqrt(kappa1 * kappa2);
            s.q2 = quartic_ ? asperities_.biharmonic[at(i)] / (kappa1 + kappa2) : 0.0;
            s.per_F2 = 1 / ellipse.F2;
            s.F1_squared = ellipse.F1 * ellipse.F1;
            s.last_delta = s.q2 > 0   ? 4 * s.kappa / s.q2
                           : s.q2 < 0 ? 2 * s.kappa / -s.q2 * (std::cosh(kDeepest) - 1)
                                      : std::numeric_limits<double>::infinity();
        }
    }

    void respond(int n, const int* asperity, const double* u, double* force, double* slope, double* work) const override {
        for (int k = 0; k < n; ++k) {
            if (!(u[k] > 0)) {
                force[k] = slope[k] = work[k] = 0;
                continue;
            }
            const Summit& s = summits_[at(asperity[k])];
            const double delta = u[k] * s.per_F2, smooth = std::min(delta, s.last_delta), past = delta - smooth;
            const double a2 = a_squared(s, smooth), a = std::sqrt(a2), a3 = a * a2;
            const Bessel shape = bessel(s.q2 * a2);
            const double P = 4.0 / 3 * E_star_ * s.kappa * a3 * shape.load;
            const double W = 8.0 / 15 * E_star_ * s.kappa * s.kappa * a3 * a2 * shape.work;  // int P ddelta
            force[k] = P + 2 * E_star_ * a * past;
            slope[k] = 2 * E_star_ * a * s.per_F2;
            work[k] = (W + P * past + E_star_ * a * past * past) / s.per_F2;
        }
    }

    double force(int asperity, double u) const override {
        double force, slope, work;
        respond(1, &asperity, &u, &force, &slope, &work);
        return force;
    }

    double area(int asperity, double u) const override {
        if (!(u > 0)) return 0;
        const Summit& s = summits_[at(asperity)];
        return std::numbers::pi * s.F1_squared * a_squared(s, std::min(u * s.per_F2, s.last_delta));
    }

    bool beyond(int asperity, double u) const override {
        const Summit& s = summits_[at(asperity)];
        return u * s.per_F2 > s.last_delta;
    }

private:
    static constexpr double kDeepest = 100;  // |q| a where q^2 < 0: far beyond all sense, and cosh(2 |q| a) does not overflow

    struct Summit {
        double kappa = 0, q2 = 0;  // 1/R_e, squared wave number of the profile
        double per_F2 = 1, F1_squared = 1;
        double last_delta = 0;  // the contact reaches the profile's trough
    };

    // Inverse of delta = A (1 - cos(q a)) = 2 A sin^2(q a/2), A = 2 kappa/q^2.
    static double a_squared(const Summit& s, double delta) {
        const double a2 = delta / s.kappa, y = 0.25 * s.q2 * a2;  // of the paraboloid; sin^2(q a/2)
        if (std::abs(y) < 1e-8) return a2 * (1 + y / 3);          // the next term is below rounding
        const double root = std::sqrt(std::abs(y));
        const double half = y > 0 ? std::asin(std::min(root, 1.0)) : std::asinh(root);  // |q| a/2
        return a2 * (half * half / (root * root));
    }

    const Asperities& asperities_;
    double E_star_;
    bool quartic_;
    std::vector<Summit> summits_;
};

}  // namespace

std::unique_ptr<Law> make_law(LawKind kind, const Asperities& asperities, double E_star) {
    if (kind == LawKind::hertz) return std::make_unique<Hertz>(asperities, E_star);
    const char* name = kind == LawKind::elliptic ? "elliptic" : "fourth_order";
    if (asperities.size() > 0 && asperities.kappa1.size() != asperities.size()) {
        throw Error(Failure::bad_input, std::string("asperities%law = '") + name +
                                            "' needs the principal curvatures of every asperity; these were given without: only 'hertz' is "
                                            "possible");
    }
    if (kind == LawKind::fourth_order && asperities.size() > 0 && asperities.biharmonic.size() != asperities.size()) {
        throw Error(Failure::bad_input, "asperities%law = 'fourth_order' needs the biharmonic of the height at every summit; these asperities "
                                        "were given without: 'hertz' and 'elliptic' are possible");
    }
    return std::make_unique<FourthOrder>(asperities, E_star, kind == LawKind::fourth_order);
}

}  // namespace rsc
