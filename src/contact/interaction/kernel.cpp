#include "contact/interaction/kernel.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace rsc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class FreeKernel final : public Kernel {
public:
    explicit FreeKernel(double E_star) : Kernel(E_star, 1 / (std::numbers::pi * E_star)) {}
    double at(double dx, double dy) const override { return 1 / (std::numbers::pi * modulus() * std::sqrt(dx * dx + dy * dy)); }
    double self() const override { return 0; }
    double least() const override { return 0; }
    double period() const override { return kInfinity; }
};

class NoKernel final : public Kernel {
public:
    explicit NoKernel(double E_star) : Kernel(E_star, 0) {}
    double at(double, double) const override { return 0; }
    double self() const override { return 0; }
    double least() const override { return 0; }
    double period() const override { return kInfinity; }
};

}  // namespace

std::shared_ptr<const Kernel> make_kernel(Interaction interaction, double E_star) {
    if (interaction == Interaction::none) return std::make_shared<NoKernel>(E_star);
    return std::make_shared<FreeKernel>(E_star);
}

}  // namespace rsc
