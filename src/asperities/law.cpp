#include "asperities/law.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include "asperities/bessel_profile.hpp"
#include "asperities/ellipse.hpp"
#include "asperities/shifted_summits.hpp"
#include "base/error.hpp"

namespace rsc {
namespace {

class Hertz final : public Law, Truncation, Widening {
public:
    Hertz(const Asperities& asperities, double E_star, ShiftedSummits*)
        : radius_(asperities.radius), E_star_(E_star), c_(asperities.size()) {}

    void prepare(std::span<const int> asperities) override {
        for (int i : asperities) c_[at(i)] = 4.0 / 3.0 * E_star_ * std::sqrt(radius_[at(i)]);
    }

    void respond(int n, const int* asperity, const double* u, double* force, double* slope,
                 double* work) const override {
        for (const int k : indices(n)) {
            const double x = std::max(u[k], 0.0);
            const double c_root = c_[at(asperity[k])] * std::sqrt(x);
            force[k] = c_root * x;
            slope[k] = 1.5 * c_root;
            work[k] = 0.4 * force[k] * x;
        }
    }

    Footprint footprint(int asperity, double u) const override {
        return {u > 0 ? pi * radius_[at(asperity)] * u : 0.0, 1, false};
    }
    LawCapabilities capabilities() const override { return {this, this, true, true}; }
    bool sinks() const override { return false; }
    Spread spread(int asperity, double u) const override {
        const double slope = pi * radius_[at(asperity)];
        return {slope * u, slope, 0.5 * slope * u * u};
    }
    double widening(int, double u) const override { return 0.5 / u; }
    // f/A = 4 E*/(3 pi) sqrt(u/r)
    double yield_penetration(int asperity, double pressure) const override {
        const double root = 0.75 * pi * pressure / E_star_;
        return root * root * radius_[at(asperity)];
    }

private:
    const std::vector<double>& radius_;
    double E_star_;
    std::vector<double> c_;  // (4/3) E* sqrt(r)
};

// Laws 'fourth_order' and 'elliptic'; the latter has q = 0.
class FourthOrder final : public Law, Truncation, Widening {
public:
    FourthOrder(const Asperities& asperities, double E_star, ShiftedSummits* shifts, bool quartic)
        : asperities_(asperities),
          shifts_(shifts),
          E_star_(E_star),
          quartic_(quartic),
          place_(asperities.size(), -1) {}

    void prepare(std::span<const int> asperities) override {
        for (int i : asperities) {
            if (shifts_) shifts_->shift_and_prepare(at(i));
            const double kappa1 = asperities_.kappa1[at(i)], kappa2 = asperities_.kappa2[at(i)],
                         kappa = std::sqrt(kappa1 * kappa2);
            const double q2 = quartic_ ? asperities_.biharmonic[at(i)] / (kappa1 + kappa2) : 0.0;
            const auto ellipse = ellipse_factors(kappa1 / kappa2);
            Summit s;
            s.e = E_star_ / ellipse.F2;
            s.r = 1 / (kappa * ellipse.F2);
            s.t = q2 / (4 * kappa * ellipse.F2);
            s.last = ellipse.F2 * (q2 > 0   ? 4 * kappa / q2
                                   : q2 < 0 ? 2 * kappa / -q2 * (std::cosh(kDeepest) - 1)
                                            : kInfinity);
            s.spot = pi * ellipse.F1 * ellipse.F1;
            s.axes = ellipse.axes;
            if (place_[at(i)] < 0) {
                place_[at(i)] = int(summits_.size());
                summits_.emplace_back();
            }
            summits_[at(place_[at(i)])] = s;
        }
    }

    void respond(int n, const int* asperity, const double* u, double* force, double* slope,
                 double* work) const override {
        for (const int k : indices(n)) {
            if (!(u[k] > 0)) {
                force[k] = slope[k] = work[k] = 0;
                continue;
            }
            const Summit& s = summit(asperity[k]);
            const double smooth = std::min(u[k], s.last), past = u[k] - smooth;
            const auto shape = profile_.at(argument(s, u[k]));
            const double paraboloid = s.e * std::sqrt(s.r * smooth),
                         stiffness = 2 * paraboloid * shape.radius;
            const double P = 4.0 / 3 * paraboloid * smooth * shape.load;
            force[k] = P + stiffness * past;
            slope[k] = stiffness;
            work[k] = 8.0 / 15 * paraboloid * smooth * smooth * shape.work + P * past +
                      0.5 * stiffness * past * past;
        }
    }

    Footprint footprint(int asperity, double u) const override {
        const Summit& s = summit(asperity);
        if (!(u > 0)) return {0, s.axes, false};
        const double smooth = std::min(u, s.last), radius = profile_.at(argument(s, u)).radius;
        return {s.spot * s.r * smooth * radius * radius, s.axes, u > s.last};
    }
    LawCapabilities capabilities() const override { return {this, this, !quartic_, true}; }
    bool sinks() const override { return quartic_; }

    double widening(int asperity, double u) const override {
        const Summit& s = summit(asperity);
        const double t = s.t * u;
        return t < 1 && u <= s.last ? 0.5 / (u * profile_.at(t).radius * std::sqrt(1 - t)) : 0.0;
    }

    // Up to t = kFlattest, A(u) = spot r u R(t)^2 with t R(t)^2 = asin^2(sqrt(t)).
    Spread spread(int asperity, double u) const override {
        const Summit& s = summit(asperity);
        const double end = s.t > 0 ? std::min(u, kFlattest / s.t) : u, t = s.t * end,
                     past = u - end;
        const double R = profile_.at(t).radius, root = std::sqrt(1 - t), scale = s.spot * s.r;
        Spread result;
        result.area = scale * end * R * R;
        result.slope = scale * R / root;
        result.integral = scale * end * end * integral_over_t2(t, R, root);
        result.integral += past * (result.area + 0.5 * result.slope * past);
        result.area += result.slope * past;
        return result;
    }

    // The mean pressure increases up to t = kFlattest, then decreases, and increases again beyond
    // `last`, where the area is constant.
    double yield_penetration(int asperity, double pressure) const override {
        const Summit& s = summit(asperity);
        const auto excess = [&](double u) {
            return std::log(force(asperity, u) / (pressure * area(asperity, u)));
        };
        double start = s.t > 0 ? kFlattest / s.t : s.r * std::pow(pressure / s.e, 2);
        if (s.t > 0 && excess(start) < 0) start = s.last;
        std::uintmax_t steps = 2000;
        const auto [low, high] = boost::math::tools::bracket_and_solve_root(
            excess, start, 2.0, true, boost::math::tools::eps_tolerance<double>(), steps);
        return 0.5 * (low + high);
    }

private:
    // sin^2(x/2) at the maximum of the mean pressure (sin x - x cos x)/x^2, x = q a
    static constexpr double kFlattest = 0.7444;

    // Integral of asin^2(sqrt(t')) dt' from 0 to t, divided by t^2.
    static double integral_over_t2(double t, double R, double root) {
        if (std::abs(t) > 0.02) return (R * root - 0.5 - 0.5 * R * R * (1 - 2 * t)) / t;
        // asin^2(sqrt(t)) = sum of coefficient_n t^n,
        // coefficient_n+1/coefficient_n = n^2/((n+1)(n+1/2)).
        double sum = 0, power = 1, coefficient = 1;
        for (int n = 1; n <= 10; ++n) {
            sum += coefficient * power / (n + 1);
            power *= t;
            coefficient *= 2.0 * n * n / ((n + 1) * (2.0 * n + 1));
        }
        return sum;
    }

    // limit of |q| a for q^2 < 0: far beyond any contact, but cosh(2 |q| a) does not overflow
    static constexpr double kDeepest = 100;

    // Coefficients in terms of u = F2 delta: a^2 = r u, argument t u of BesselProfile, modulus e of
    // the forces.
    struct alignas(64) Summit {
        double e = 0, r = 0, t = 0;
        double last = 0;  // u at which the contact reaches the trough of the profile
        double spot = 0;  // pi F1^2, the ratio of the area to a^2
        double axes = 1;
    };

    // The argument of the profile. It is exactly 1 where the contact has reached the trough, as the
    // radius has an infinite slope there, which would turn a rounding error into one of 1e-8.
    static double argument(const Summit& s, double u) {
        return u < s.last ? s.t * u : s.t > 0 ? 1.0 : s.t * s.last;
    }

    const Summit& summit(int asperity) const { return summits_[at(place_[at(asperity)])]; }

    const Asperities& asperities_;
    ShiftedSummits* shifts_;
    double E_star_;
    bool quartic_;
    const BesselProfile& profile_ = BesselProfile::table();
    std::vector<int> place_;       // index of an asperity in summits_; -1: not prepared
    std::vector<Summit> summits_;  // contiguous data of the prepared asperities
};

// All laws in the order of LawKind.
struct Row {
    LawTraits traits;
    std::unique_ptr<Law> (*make)(const Asperities& asperities, double E_star,
                                 ShiftedSummits* shifts);
};
template <class T, auto... more>
std::unique_ptr<Law> made(const Asperities& asperities, double E_star, ShiftedSummits* shifts) {
    return std::make_unique<T>(asperities, E_star, shifts, more...);
}
constexpr Row kLaws[] = {
    // curvatures, biharmonic, between points, elliptic spots
    {{kLawNames[0], false, false, false, false}, made<Hertz>},
    {{kLawNames[1], true, false, true, true}, made<FourthOrder, false>},
    {{kLawNames[2], true, true, true, true}, made<FourthOrder, true>},
};
static_assert(std::size(kLaws) == kLawNames.size());

}  // namespace

const LawTraits& traits(LawKind kind) { return kLaws[int(kind)].traits; }

std::unique_ptr<Law> make_law(LawKind kind, const Asperities& asperities, double E_star,
                              ShiftedSummits* shifts) {
    const LawTraits& law = traits(kind);
    if (law.needs_curvatures && asperities.size() > 0 &&
        asperities.kappa1.size() != asperities.size()) {
        throw Error(Failure::bad_input, std::string("asperities%law = '") + law.name +
                                            "' needs the principal curvatures of every asperity, "
                                            "which were not given: only 'hertz' is "
                                            "possible");
    }
    if (law.needs_biharmonic && asperities.size() > 0 &&
        asperities.biharmonic.size() != asperities.size()) {
        throw Error(Failure::bad_input,
                    "asperities%law = 'fourth_order' needs the biharmonic of the height at every "
                    "summit, which was "
                    "not given: 'hertz' and 'elliptic' are possible");
    }
    return kLaws[int(kind)].make(asperities, E_star, shifts);
}

LawCapabilities capabilities_of(LawKind kind) {
    return make_law(kind, Asperities(), 1)->capabilities();
}

}  // namespace rsc
