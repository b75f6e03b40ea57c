// What a force does to other places: Green's function of the elastic half-space. The one place that knows 1/(pi E* d).
#pragma once

#include <memory>

#include "contact/indentation.hpp"
#include "contact/interaction/lattice.hpp"

namespace rsc {

// G(dx, dy): how far a unit force lowers the surface at an offset from it [length/force]. B_ij = G(x_i - x_j, y_i - y_j), B_ii = self().
class Kernel {
public:
    virtual ~Kernel() = default;

    // G at an offset that is not zero.
    virtual double at(double dx, double dy) const = 0;
    // What a force does to its own place beside what the law of the place answers: through its images, if it has any.
    virtual double self() const = 0;
    // What G has been raised by, so that no force raises any other place: then only what reaches above the separation can touch (alone
    // it could rise only by a spot as wide as the period). 0 for a free half-space. A solution with this G at Z0' is the one with the
    // true G at Z0 = Z0' + shift() N.
    virtual double shift() const = 0;
    // Where everything repeats; null: nowhere. Then G = near() Gamma + shift().
    virtual const Lattice* lattice() const { return nullptr; }
    Period period() const { return lattice() ? lattice()->period() : Period{}; }

    // Close to the force G = near()/d + something bounded: 1/(pi E*), or 0 without interaction.
    double near() const { return near_; }
    bool none() const { return near_ == 0; }
    double modulus() const { return E_star_; }  // E*

protected:
    Kernel(double E_star, double near) : E_star_(E_star), near_(near) {}

private:
    double E_star_, near_;
};

// Interaction::point: G = 1/(pi E* d), the free half-space (Boussinesq; paper, section 4). Interaction::none: G = 0.
// A finite period: G = Gamma/(pi E*) + shift(), Gamma the sum over images less its mean (lattice.hpp): of a mode exp(i k x) of pressure
// the half-space's answer 2/(E* |k|), of a uniform pressure none, for Z0 is measured from the mean plane of the deformed surface. Its
// least value is 0, and self() = -2.28472/(pi E* L) on a square.
// E_star: E* > 0, finite [force/length^2].
std::shared_ptr<const Kernel> make_kernel(Interaction interaction, double E_star, Period period = {});

}  // namespace rsc
