// The interaction kernel G(d) = 1/(pi E* d) + s(d): the deflection of other places by a unit force, with the smooth part s(d) of layers.
#pragma once

#include "contact/indentation.hpp"
#include "contact/interaction/lattice.hpp"

namespace rsc {

// A smooth function of a square, v = value(t^2), as polynomials of degree 4 in y = 1 + t^2/unit^2, 64 to an octave of y: a lookup costs
// what it gathers, five numbers.
class SquareTable {
public:
    static constexpr int kDegree = 4, kPiecesPerOctave = 64, kOctaves = 80;
    static constexpr std::size_t kPieces = std::size_t{kOctaves} * kPiecesPerOctave;

    // `value(t)` for t >= 0. Beyond t = 2^40 unit the table keeps its last value.
    SquareTable(double unit, const std::function<double(double)>& value);

    double unit() const { return unit_; }
    double at_square(double t2) const;
    // The same for kBlock squares at once.
    static constexpr std::size_t kBlock = 64;
    void values(const double* squares, double* value) const;
    // The integral of v t dt from 0 to t.
    double moment(double t) const;
    // to[i] += sum over j of f[j] v((xt[i] - xs[j])^2 + (yt[i] - ys[j])^2). The arrays do not overlap.
    void add(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources, const double* xs, const double* ys,
             const double* f, double* to) const;

private:
    double unit_, inverse_square_;
    std::vector<double> coefficient_;  // [degree][piece], of powers of the distance from the middle of the piece over its octave
    std::vector<double> sum_;          // the integral of v dy up to each piece
};

class SmoothPart {
public:
    // s(d) for d >= 0 [length/force]; share(k) for k > 0, with which a mode of pressure of the wavenumber k [1/length] answers
    // 2/(E* k) (1 + share(k)) of itself: E* k/2 times the two-dimensional Fourier transform of s. `scale` [length]: s changes little
    // within it, that is, share(k) falls like exp(-k scale) and d^2 may be replaced by -scale^2 before s has a singularity.
    SmoothPart(const std::function<double(double)>& s, std::function<double(double)> share, double scale);

    double at(double d) const { return table_.at_square(d * d); }
    double at_square(double d2) const { return table_.at_square(d2); }
    double share(double k) const { return share_(k); }
    double scale() const { return table_.unit(); }
    // The integral of s over the rectangle |x' - x| < a, |y' - y| < b, d the distance of (x', y') from 0.
    double over_rectangle(double x, double y, double a, double b) const;
    const SquareTable& table() const { return table_; }

private:
    double corner(double s, double t) const;

    SquareTable table_;
    std::function<double(double)> share_;
};

// The deflection of other places by a force: only this file knows 1/(pi E* d). Pairs, mesh, pixels, the periodic grid and deflections take
// it from here.

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
    // Largest height by which a unit force raises other places [length/force]: 0 except for nearly incompressible layers on a stiffer body, which
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
    // Deflection of the force's own place beyond that of the contact law: by layers, and by periodic images.
    virtual double self() const = 0;
    // Constant added to G so that no force raises any other place: then only points above the separation can touch (alone
    // it could rise only by a spot as wide as the period). 0 for a free half-space, bulge() for a free body. A solution with this G at Z0' is the one with the
    // true G at Z0 = Z0' + shift() N.
    virtual double shift() const = 0;
    // The lattice of periodic boundaries, or null. With it G = near() Gamma + shift().
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
