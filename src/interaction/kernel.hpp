// Interaction kernel G(d) = 1/(pi E* d) + s(d): the deflection at a distance d from a unit force,
// with the smooth part s(d) due to layers.
#pragma once

#include "interaction/lattice.hpp"

namespace rsc {

// Deflection of the surface around an asperity: that of a point force, or none.
enum class Interaction { point, none };
inline constexpr std::array kInteractionNames = {"point", "none"};

// Table of a smooth function v of t^2 as polynomials of degree 4 in y = 1 + t^2/unit^2, 64 per
// octave of y. A lookup gathers only five numbers.
class SquareTable {
public:
    static constexpr int kDegree = 4, kPiecesPerOctave = 64, kOctaves = 80;
    static constexpr std::size_t kPieces = std::size_t{kOctaves} * kPiecesPerOctave;

    // Tabulates value(t) for t >= 0. Beyond t = 2^40 unit the table is constant.
    SquareTable(double unit, const std::function<double(double)>& value);

    double unit() const { return unit_; }
    double at_square(double t2) const;
    // Evaluates n <= kBlock squares at once.
    static constexpr std::size_t kBlock = 64;
    void values(std::size_t n, const double* squares, double* value) const;
    // Integral of v t dt from 0 to t.
    double moment(double t) const;
    // to[i] += sum over j of f[j] v((xt[i] - xs[j])^2 + (yt[i] - ys[j])^2). The arrays must not
    // overlap.
    void add(std::size_t n_targets, const double* xt, const double* yt, std::size_t n_sources,
             const double* xs, const double* ys, const double* f, double* to) const;

private:
    double unit_, inverse_square_;
    // [degree][piece], of powers of the distance from the middle of the piece, relative to its
    // octave.
    std::vector<double> coefficient_;
    std::vector<double> sum_;  // integral of v dy up to each piece
};

class SmoothPart {
public:
    // s(d) for d >= 0 [length/force]. share(k) for k > 0 is E* k/2 times the two-dimensional
    // Fourier transform of s: a pressure mode of wavenumber k [1/length] causes a deflection of
    // 2/(E* k) (1 + share(k)) times itself. `scale` [length] is the distance within which s changes
    // little: share(k) falls like exp(-k scale), and s as a function of d^2 is analytic down to
    // -scale^2.
    SmoothPart(const std::function<double(double)>& s, std::function<double(double)> share,
               double scale);

    double at(double d) const { return table_.at_square(d * d); }
    double at_square(double d2) const { return table_.at_square(d2); }
    double share(double k) const { return share_(k); }
    double scale() const { return table_.unit(); }
    // Integral of s(d) over the rectangle |x' - x| < a, |y' - y| < b, where d is the distance of
    // (x', y') from 0.
    double over_rectangle(double x, double y, double a, double b) const;
    const SquareTable& table() const { return table_; }

private:
    double corner(double s, double t) const;
    template <unsigned n>
    double by_points(double x, double y, double a, double b) const;

    SquareTable table_;
    std::function<double(double)> share_;
};

// The factor 1/(pi E* d) is defined only here; pairs, mesh, pixels, the periodic grid and
// deflections use these functions.

// Elastic body. A unit force lowers its surface at a distance d by 1/(pi E* d) + s(d) (Boussinesq;
// s: layers), a pressure mode of wavenumber k by 2/(E* k) (1 + share(k)) times itself.
class Substrate {
public:
    // E_star: E* of the material at the surface, positive and finite [force/length^2]. `smooth`:
    // null for a homogeneous half-space.
    Substrate(double E_star, std::shared_ptr<const SmoothPart> smooth = {});

    double modulus() const { return E_star_; }
    double near() const;  // 1/(pi E*)
    const SmoothPart* smooth() const { return smooth_.get(); }
    // s(d); 0 for a homogeneous half-space.
    double smooth_at(double d) const { return smooth_ ? smooth_->at(d) : 0; }
    // Largest height by which a unit force raises other points [length/force]: 0 except for nearly
    // incompressible layers on a stiffer body, which bulge around the force.
    double bulge() const { return bulge_; }
    // Deflection at an offset (x, y) from the middle of a rectangle of sides dx and dy under unit
    // pressure [length^3/force].
    double under_pixel(double x, double y, double dx, double dy) const;

private:
    double E_star_, bulge_ = 0;
    std::shared_ptr<const SmoothPart> smooth_;
};

// G(dx, dy): deflection of the surface at an offset from a unit force [length/force]. B_ij = G(x_i
// - x_j, y_i - y_j), B_ii = self().
//
// Interaction::point: G = 1/(pi E* d) + s(d) + shift() of the free body (Boussinesq; paper, section
// 4). Interaction::none: G = 0, self() = s(0). Finite period: G = Gamma/(pi E*) + shift(), where
// Gamma is the sum over images minus its mean (lattice.hpp). A pressure mode exp(i k x) deflects by
// 2/(E* |k|), a uniform pressure not at all, because Z0 is measured from the mean plane of the
// deformed surface. The smallest value of G is 0, and self() = -2.28472/(pi E* L) on a square.
class Kernel {
public:
    Kernel(Interaction interaction, Substrate substrate, Period period);
    Kernel(const Kernel&) = delete;
    Kernel& operator=(const Kernel&) = delete;

    // G at a nonzero offset.
    double at(double dx, double dy) const;
    // Deflection at the point of the force beyond that of the contact law, due to layers and
    // periodic images.
    double self() const {
        return lattice_ ? near_ * (lattice_->self() - lattice_->least())
                        : substrate_.smooth_at(0) + shift();
    }
    // Constant added to G so that no force raises other points; then only points above the
    // separation can touch. 0 for a free half-space, bulge() for a free layered body. A solution
    // with this G at Z0' equals the solution with the true G at Z0 = Z0' + shift() N.
    double shift() const { return shift_; }
    // The lattice of periodic boundaries, with G = near() Gamma + shift(), or null.
    const Lattice* lattice() const { return lattice_ ? &*lattice_ : nullptr; }
    Period period() const { return lattice_ ? lattice_->period() : Period{}; }

    // Singular part of G: G - near()/d is bounded. 1/(pi E*), or 0 without interaction.
    double near() const { return near_; }
    bool none() const { return near_ == 0; }
    const Substrate& substrate() const { return substrate_; }
    double modulus() const { return substrate_.modulus(); }           // E*
    const SmoothPart* smooth() const { return substrate_.smooth(); }  // null: none

private:
    Substrate substrate_;
    double near_ = 0, shift_ = 0;
    std::optional<Lattice> lattice_;
};

std::shared_ptr<const Kernel> make_kernel(Interaction interaction, Substrate substrate,
                                          Period period = {});

}  // namespace rsc
