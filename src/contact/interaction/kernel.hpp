// What a force does to other places: Green's function of the elastic half-space. The one place that knows 1/(pi E* d).
#pragma once

#include <memory>

#include "contact/indentation.hpp"

namespace rsc {

// G(dx, dy): how far a unit force lowers the surface at an offset from it [length/force]. B_ij = G(x_i - x_j, y_i - y_j), B_ii = self().
class Kernel {
public:
    virtual ~Kernel() = default;

    // G at an offset that is not zero.
    virtual double at(double dx, double dy) const = 0;
    // What a force does to its own place beside what the law of the place answers: through its images, if it has any.
    virtual double self() const = 0;
    // The least value of G, self() included: 0 where every force only lowers the surface.
    virtual double least() const = 0;
    // The surface repeats after this length in x and y; Infinity if it does not.
    virtual double period() const = 0;

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
// E_star: E* > 0, finite [force/length^2].
std::shared_ptr<const Kernel> make_kernel(Interaction interaction, double E_star);

}  // namespace rsc
