#include "contact/law/hardness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "error.hpp"

namespace rsc {
namespace {

using std::numbers::pi;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

class Yielding final : public Law {
public:
    Yielding(std::unique_ptr<Law> elastic, const Asperities& asperities, const Hardness& hardness)
        : elastic_(std::move(elastic)), radius_(asperities.radius), hardness_(hardness), place_(asperities.size(), -1) {}

    bool convex() const override { return false; }  // the slope falls where a reloaded asperity yields on
    bool path_dependent() const override { return true; }

    void prepare(std::span<const int> asperities) override {
        elastic_->prepare(asperities);
        for (int i : asperities) {
            if (place_[at(i)] >= 0) continue;
            place_[at(i)] = static_cast<int>(summits_.size());
            Summit s;
            s.H = hardness_.H0 * std::sqrt(1 + hardness_.length / radius_[at(i)]);
            s.yield = elastic_->yield_penetration(i, s.H);
            const double force = elastic_->force(i, s.yield), area = elastic_->area(i, s.yield);
            s.area = area;
            s.spread = elastic_->spread(i, s.yield);
            s.modulus = 3 * force / (4 * std::sqrt(area / pi) * s.yield);
            summits_.push_back(s);
        }
    }

    void respond(int n, const int* asperity, const double* u, double* force, double* slope, double* work) const override {
        elastic_->respond(n, asperity, u, force, slope, work);
        for (int k = 0; k < n; ++k) {
            const Summit& s = summit(asperity[k]);
            if (u[k] <= (s.deepest > 0 ? s.rest : s.yield)) {
                if (s.deepest > 0) force[k] = slope[k] = work[k] = 0;
                continue;
            }
            if (u[k] <= s.deepest) {
                const double x = u[k] - s.rest, f_over_x = s.c * std::sqrt(x);
                force[k] = f_over_x * x;
                slope[k] = 1.5 * f_over_x;
                work[k] = 0.4 * force[k] * x;
                continue;
            }
            const Spread now = elastic_->spread(asperity[k], u[k]);
            force[k] = s.H * (s.area + 2 * (now.area - s.spread.area));
            slope[k] = 2 * s.H * now.slope;
            work[k] = s.deepest > 0 ? recoverable(s, s.deepest) + flow(s, s.deepest_spread, s.deepest, now, u[k])
                                    : elastic_work(asperity[k]) + flow(s, s.spread, s.yield, now, u[k]);
        }
    }

    double force(int asperity, double u) const override {
        const Summit& s = summit(asperity);
        if (s.deepest > 0 && u <= s.deepest) return u > s.rest ? s.c * (u - s.rest) * std::sqrt(u - s.rest) : 0.0;
        return u > s.yield ? s.H * flowing_area(asperity, u) : elastic_->force(asperity, u);
    }

    double area(int asperity, double u) const override {
        const Summit& s = summit(asperity);
        // c = (4/3) E' sqrt(r')
        if (s.deepest > 0 && u <= s.deepest) return u > s.rest ? pi * std::pow(0.75 * s.c / s.modulus, 2) * (u - s.rest) : 0.0;
        return u > s.yield ? flowing_area(asperity, u) : elastic_->area(asperity, u);
    }

    double axes(int asperity) const override { return elastic_->axes(asperity); }
    bool beyond(int asperity, double u) const override { return elastic_->beyond(asperity, u); }
    Spread spread(int asperity, double u) const override { return elastic_->spread(asperity, u); }
    double yield_penetration(int asperity, double pressure) const override { return elastic_->yield_penetration(asperity, pressure); }

    double steepest(int asperity, double high) const override {
        const Summit& s = summit(asperity);
        const auto slope = [&](double u) {
            double f, D, W;
            respond(1, &asperity, &u, &f, &D, &W);
            return D;
        };
        double most = slope(high);
        if (s.deepest > 0 && high > s.deepest) most = std::max(most, slope(s.deepest));
        return most;
    }

    bool yields(int asperity, double u) const override {
        const Summit& s = summit(asperity);
        return u > s.yield && u >= s.deepest;
    }
    double residual_depth(int asperity) const override { return place_[at(asperity)] < 0 ? 0 : summit(asperity).rest; }
    double work_lost() const override {
        double sum = 0;
        for (const Summit& s : summits_) sum += s.lost;
        return sum;
    }

    void commit(int n, const int* asperity, const double* u) override {
        for (int k = 0; k < n; ++k) {
            Summit& s = summits_[at(place_[at(asperity[k])])];
            if (!(u[k] > s.yield && u[k] > s.deepest)) continue;
            const Spread now = elastic_->spread(asperity[k], u[k]);
            const double area = s.area + 2 * (now.area - s.spread.area), f = s.H * area, a = std::sqrt(area / pi);
            const double spent = elastic_work(asperity[k]) + flow(s, s.spread, s.yield, now, u[k]);
            const double x = 0.75 * f / (s.modulus * a);  // a^2/r'
            s.deepest = u[k];
            s.deepest_spread = now;
            s.rest = u[k] - x;
            s.c = f / (x * std::sqrt(x));
            s.lost = spent - recoverable(s, u[k]);
        }
    }

private:
    struct Summit {
        double H = 0;
        double yield = 0;    // u_c
        double area = 0;     // at u_c
        Spread spread;       // at u_c
        double modulus = 0;  // E'
        // History; deepest = 0: has never yielded.
        double deepest = 0;     // u_m
        Spread deepest_spread;  // at u_m
        double rest = 0;        // u_r
        double c = 0;           // f = c (u - u_r)^(3/2)
        double lost = 0;        // work that does not come back
    };

    const Summit& summit(int asperity) const { return summits_[at(place_[at(asperity)])]; }

    double flowing_area(int asperity, double u) const {
        const Summit& s = summit(asperity);
        return s.area + 2 * (elastic_->spread(asperity, u).area - s.spread.area);
    }
    // int f du at constant pressure between two penetrations.
    static double flow(const Summit& s, const Spread& from, double u_from, const Spread& to, double u_to) {
        return s.H * ((s.area - 2 * s.spread.area) * (u_to - u_from) + 2 * (to.integral - from.integral));
    }
    static double recoverable(const Summit& s, double u) { return 0.4 * s.c * (u - s.rest) * (u - s.rest) * std::sqrt(u - s.rest); }
    double elastic_work(int asperity) const {
        double f, D, W;
        elastic_->respond(1, &asperity, &summit(asperity).yield, &f, &D, &W);
        return W;
    }

    std::unique_ptr<Law> elastic_;
    const std::vector<double>& radius_;
    Hardness hardness_;
    std::vector<int> place_;  // of an asperity in summits_; -1: not prepared
    std::vector<Summit> summits_;
};

}  // namespace

std::unique_ptr<Law> make_yielding(std::unique_ptr<Law> elastic, const Asperities& asperities, const Hardness& hardness) {
    if (!(hardness.H0 > 0)) throw Error(Failure::bad_input, "solids%hardness must be positive (Infinity: elastic)");
    if (!(hardness.length >= 0) || std::isinf(hardness.length)) throw Error(Failure::bad_input, "solids%size_effect must not be negative");
    if (std::isinf(hardness.H0)) return elastic;
    return std::make_unique<Yielding>(std::move(elastic), asperities, hardness);
}

}  // namespace rsc
