#include "contact/law.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "error.hpp"

namespace rsc {
namespace {

class Hertz final : public Law {
public:
    Hertz(const Asperities& asperities, double E_star) : radius_(asperities.radius), c_(asperities.size()) {
        for (std::size_t i = 0; i < c_.size(); ++i) c_[i] = 4.0 / 3.0 * E_star * std::sqrt(radius_[i]);
    }

    void respond(int n, const int* asperity, const double* u, double* force, double* slope, double* work) const override {
        for (int k = 0; k < n; ++k) {
            const double x = std::max(u[k], 0.0);
            const double c_root = c_[static_cast<std::size_t>(asperity[k])] * std::sqrt(x);
            force[k] = c_root * x;
            slope[k] = 1.5 * c_root;
            work[k] = 0.4 * force[k] * x;
        }
    }

    double force(int asperity, double u) const override {
        return u > 0 ? c_[static_cast<std::size_t>(asperity)] * u * std::sqrt(u) : 0.0;
    }

    double area(int asperity, double u) const override {
        return u > 0 ? std::numbers::pi * radius_[static_cast<std::size_t>(asperity)] * u : 0.0;
    }

private:
    std::vector<double> radius_;
    std::vector<double> c_;  // (4/3) E* sqrt(r)
};

}  // namespace

std::unique_ptr<Law> make_law(LawKind kind, const Asperities& asperities, double E_star) {
    if (kind == LawKind::hertz) return std::make_unique<Hertz>(asperities, E_star);
    throw Error(Failure::bad_input, "asperities%law: only 'hertz' is available");
}

}  // namespace rsc
