#include "contact/law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "contact/bessel_profile.hpp"
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
    double axes(int) const override { return 1; }
    bool beyond(int, double) const override { return false; }

private:
    const std::vector<double>& radius_;
    double E_star_;
    std::vector<double> c_;  // (4/3) E* sqrt(r)
};

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
            const double kappa = std::sqrt(kappa1 * kappa2), q2 = quartic_ ? asperities_.biharmonic[at(i)] / (kappa1 + kappa2) : 0.0;
            s.per_kappa = 1 / kappa;
            s.t_per_delta = q2 / (4 * kappa);
            s.axes = ellipse.axes;
            s.F2 = ellipse.F2;
            s.per_F2 = 1 / ellipse.F2;
            s.F1_squared = ellipse.F1 * ellipse.F1;
            s.last_delta = q2 > 0   ? 4 * kappa / q2
                           : q2 < 0 ? 2 * kappa / -q2 * (std::cosh(kDeepest) - 1)
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
            const auto shape = profile_.at(s.t_per_delta * smooth);
            const double paraboloid = std::sqrt(smooth * s.per_kappa);  // its contact radius
            const double a = paraboloid * shape.radius;
            const double P = 4.0 / 3 * E_star_ * paraboloid * smooth * shape.load;
            const double W = 8.0 / 15 * E_star_ * paraboloid * smooth * smooth * shape.work;  // int P ddelta
            force[k] = P + 2 * E_star_ * a * past;
            slope[k] = 2 * E_star_ * a * s.per_F2;
            work[k] = (W + P * past + E_star_ * a * past * past) * s.F2;
        }
    }

    double force(int asperity, double u) const override {
        if (!(u > 0)) return 0;
        const Summit& s = summits_[at(asperity)];
        const double delta = u * s.per_F2, smooth = std::min(delta, s.last_delta);
        const double t = s.t_per_delta * smooth, paraboloid = std::sqrt(smooth * s.per_kappa);
        const double P = 4.0 / 3 * E_star_ * paraboloid * smooth * profile_.load(t);
        return delta > smooth ? P + 2 * E_star_ * paraboloid * profile_.at(t).radius * (delta - smooth) : P;
    }

    double area(int asperity, double u) const override {
        if (!(u > 0)) return 0;
        const Summit& s = summits_[at(asperity)];
        const double smooth = std::min(u * s.per_F2, s.last_delta), radius = profile_.at(s.t_per_delta * smooth).radius;
        return std::numbers::pi * s.F1_squared * smooth * s.per_kappa * radius * radius;
    }

    double axes(int asperity) const override { return summits_[at(asperity)].axes; }

    bool beyond(int asperity, double u) const override {
        const Summit& s = summits_[at(asperity)];
        return u * s.per_F2 > s.last_delta;
    }

private:
    static constexpr double kDeepest = 100;  // |q| a where q^2 < 0: far beyond all sense, and cosh(2 |q| a) does not overflow

    struct Summit {
        double per_kappa = 0;      // R_e
        double t_per_delta = 0;    // q^2/(4 kappa)
        double axes = 1, F2 = 1, per_F2 = 1, F1_squared = 1;
        double last_delta = 0;     // the contact reaches the profile's trough
    };

    const Asperities& asperities_;
    double E_star_;
    bool quartic_;
    const BesselProfile& profile_ = BesselProfile::table();
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
