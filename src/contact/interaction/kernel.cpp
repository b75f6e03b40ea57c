#include "contact/interaction/kernel.hpp"

#include <cmath>
#include <numbers>

namespace rsc {
namespace {

class FreeKernel final : public Kernel {
public:
    explicit FreeKernel(double E_star) : Kernel(E_star, 1 / (std::numbers::pi * E_star)) {}
    double at(double dx, double dy) const override { return 1 / (std::numbers::pi * modulus() * std::sqrt(dx * dx + dy * dy)); }
    double self() const override { return 0; }
    double shift() const override { return 0; }
};

class NoKernel final : public Kernel {
public:
    explicit NoKernel(double E_star) : Kernel(E_star, 0) {}
    double at(double, double) const override { return 0; }
    double self() const override { return 0; }
    double shift() const override { return 0; }
};

class PeriodicKernel final : public Kernel {
public:
    PeriodicKernel(double E_star, Period period) : Kernel(E_star, 1 / (std::numbers::pi * E_star)), lattice_(period) {}
    double at(double dx, double dy) const override { return near() * (lattice_.at(dx, dy) - lattice_.least()); }
    double self() const override { return near() * (lattice_.self() - lattice_.least()); }
    double shift() const override { return -near() * lattice_.least(); }
    const Lattice* lattice() const override { return &lattice_; }

private:
    Lattice lattice_;
};

}  // namespace

std::shared_ptr<const Kernel> make_kernel(Interaction interaction, double E_star, Period period) {
    if (interaction == Interaction::none) return std::make_shared<NoKernel>(E_star);
    if (period.finite()) return std::make_shared<PeriodicKernel>(E_star, period);
    return std::make_shared<FreeKernel>(E_star);
}

}  // namespace rsc
