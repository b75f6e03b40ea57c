// What a force does to other places: the one place that knows 1/(pi E* d). Pairs, mesh, pixels, the periodic grid and deflections take
// it from here.
#pragma once

#include <memory>
#include <utility>

#include "contact/indentation.hpp"
#include "contact/interaction/lattice.hpp"
#include "contact/interaction/smooth_part.hpp"

namespace rsc {

// The elastic body that is pressed. A unit force lowers its surface at a distance d by 1/(pi E* d) + s(d) (Boussinesq; s: layers), a
// mode of pressure with the wavenumber k by 2/(E* k) (1 + share(k)) of itself.
class Substrate {
public:
    // E_star: E* > 0 of what lies at the surface, finite [force/length^2]. `smooth`: null for a homogeneous half-space.
    Substrate(double E_star, std::shared_ptr<const SmoothPart> smooth = {});

    double modulus() const { return E_star_; }
    double near() const;  // 1/(pi E*)
    const SmoothPart* smooth() const { return smooth_.get(); }
    // s(d), 0 of a homogeneous half-space.
    double smooth_at(double d) const { return smooth_ ? smooth_->at(d) : 0; }
    // How far a unit force raises other places at most [length/force]: 0 but for nearly incompressible layers on a stiffer body, which
    // bulge around what presses them.
    double bulge() const { return bulge_; }
    // The deflection at an offset (x, y) from the middle of a rectangle of sides dx and dy under unit pressure [length^3/force].
    double under_pixel(double x, double y, double dx, double dy) const;

private:
    double E_star_, bulge_ = 0;
    std::shared_ptr<const SmoothPart> smooth_;
};

// The body that an indenter is pressed into, with its layers.
Substrate substrate_of(const Indenter& indenter);

// G(dx, dy): how far a unit force lowers the surface at an offset from it [length/force]. B_ij = G(x_i - x_j, y_i - y_j), B_ii = self().
class Kernel {
public:
    virtual ~Kernel() = default;

    // G at an offset that is not zero.
    virtual double at(double dx, double dy) const = 0;
    // What a force does to its own place beside what the law of the place answers: through layers, and through its images, if any.
    virtual double self() const = 0;
    // What G has been raised by, so that no force raises any other place: then only what reaches above the separation can touch (alone
    // it could rise only by a spot as wide as the period). 0 for a free half-space, bulge() for a free body. A solution with this G at Z0' is the one with the
    // true G at Z0 = Z0' + shift() N.
    virtual double shift() const = 0;
    // Where everything repeats; null: nowhere. Then G = near() Gamma + shift().
    virtual const Lattice* lattice() const { return nullptr; }
    Period period() const { return lattice() ? lattice()->period() : Period{}; }

    // Close to the force G = near()/d + something bounded: 1/(pi E*), or 0 without interaction.
    double near() const { return near_; }
    bool none() const { return near_ == 0; }
    const Substrate& substrate() const { return substrate_; }
    double modulus() const { return substrate_.modulus(); }           // E*
    const SmoothPart* smooth() const { return substrate_.smooth(); }  // null: none

protected:
    Kernel(Substrate substrate, double near) : substrate_(std::move(substrate)), near_(near) {}

private:
    Substrate substrate_;
    double near_;
};

// Interaction::point: G = 1/(pi E* d) + s(d) + shift(), the free body (Boussinesq; paper, section 4). Interaction::none: G = 0, self() = s(0).
// A finite period: G = Gamma/(pi E*) + shift(), Gamma the sum over images less its mean (lattice.hpp): of a mode exp(i k x) of pressure
// the half-space's answer 2/(E* |k|), of a uniform pressure none, for Z0 is measured from the mean plane of the deformed surface. Its
// least value is 0, and self() = -2.28472/(pi E* L) on a square.
std::shared_ptr<const Kernel> make_kernel(Interaction interaction, Substrate substrate, Period period = {});

}  // namespace rsc
