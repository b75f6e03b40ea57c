#include "contact/interaction/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "contact/interaction/layers.hpp"
#include "contact/interaction/love.hpp"
#include "error.hpp"

namespace rsc {

Substrate::Substrate(double E_star, std::shared_ptr<const SmoothPart> smooth) : E_star_(E_star), smooth_(std::move(smooth)) {
    if (!smooth_) return;
    // Close by 1/(pi E* d) prevails, far away both are as 1/d.
    for (double d = 0.01 * smooth_->scale(); d < 1e4 * smooth_->scale(); d *= 1.01)
        bulge_ = std::max(bulge_, 0 - near() / d - smooth_->at(d));
    bulge_ *= 1 + 1e-3;  // between the places asked
}

double Substrate::near() const { return 1 / (std::numbers::pi * E_star_); }

double Substrate::under_pixel(double x, double y, double dx, double dy) const {
    double sum = near() * dx * pixel_kernel(x / dx, y / dx, dy / dx);
    if (smooth_) sum += smooth_->over_rectangle(x, y, 0.5 * dx, 0.5 * dy);
    return sum;
}

Substrate substrate_of(const Indenter& indenter) { return {indenter.E_star, layers_of(indenter.layers, indenter.E_star)}; }

namespace {

class FreeKernel final : public Kernel {
public:
    explicit FreeKernel(Substrate substrate) : Kernel(substrate, substrate.near()) {}
    double at(double dx, double dy) const override {
        const double d2 = dx * dx + dy * dy, point = near() / std::sqrt(d2);
        return smooth() ? point + smooth()->at_square(d2) + shift() : point;
    }
    double self() const override { return substrate().smooth_at(0) + shift(); }
    double shift() const override { return substrate().bulge(); }
};

class NoKernel final : public Kernel {
public:
    explicit NoKernel(Substrate substrate) : Kernel(std::move(substrate), 0) {}
    double at(double, double) const override { return 0; }
    double self() const override { return substrate().smooth_at(0); }
    double shift() const override { return 0; }
};

class PeriodicKernel final : public Kernel {
public:
    PeriodicKernel(Substrate substrate, Period period) : Kernel(substrate, substrate.near()), lattice_(period) {
        if (smooth()) throw Error(Failure::bad_input, "layers between two flats need solver%model = 'elements'");
    }
    double at(double dx, double dy) const override { return near() * (lattice_.at(dx, dy) - lattice_.least()); }
    double self() const override { return near() * (lattice_.self() - lattice_.least()); }
    double shift() const override { return -near() * lattice_.least(); }
    const Lattice* lattice() const override { return &lattice_; }

private:
    Lattice lattice_;
};

}  // namespace

std::shared_ptr<const Kernel> make_kernel(Interaction interaction, Substrate substrate, Period period) {
    if (interaction == Interaction::none) return std::make_shared<NoKernel>(std::move(substrate));
    if (period.finite()) return std::make_shared<PeriodicKernel>(std::move(substrate), period);
    return std::make_shared<FreeKernel>(std::move(substrate));
}

}  // namespace rsc
