// Equilibrium of elements that attract without a range (the limit of Johnson, Kendall, Roberts).
//
// The bodies touch with a gap of 0 and pressures of either sign, and let go where this releases the
// work of adhesion w. On a grid, the edge of a contact runs through pixels: let a row of pixels
// along a straight edge open by u under the tension t. If the rest of the contact holds its gaps,
// t decreases as t0 - u/S, where S = kRow h/E* is the compliance of the row. With the traction
// t = s0 (1 - u/u0), s0 = sqrt(2 w/S), u0 = S s0, whose work is w, the row is thus in neutral
// equilibrium at each opening, as is a straight edge anywhere under the stress intensity that
// releases w: edges move freely between the pixels, forward and back. Pixels are loaded by this
// traction if they or a neighbour touch. As the grid becomes finer, s0 increases as h^(-1/2) and
// u0 vanishes. The pull-off force of a sphere is too large by 6, 1.5, 1 % with 8, 16, 32 pixels to
// the contact radius at zero force.
#pragma once

#include "elements/cut_map.hpp"

namespace rsc {

class AdhesiveEdges {
public:
    // E* S/h of a pixel in a row at the straight edge of a half-plane of such pixels, of Love's
    // kernel (1.7245) and of Fourier modes (1.731): 1 over the last diagonal element of the inverse
    // of the matrix of strips.
    static constexpr double kRow = 1.7275;

    // For pixels of the map, with the traction s0 (1 - gap/u0); `wraps`: the map repeats.
    AdhesiveEdges(PixelProducts& products, const CutMap& map, bool wraps, double s0, double u0);

    // Selects the pixels of nonzero share and those around them, in addition to those of before if
    // `more`. `p` and `share` are of all points, by CutMap::place().
    void select(const std::vector<double>& p, const std::vector<double>& share, bool more);
    const std::vector<Pixel>& pixels() const { return pixels_; }  // row by row

    struct Outcome {
        bool converged = false, wider = false;  // wider: more pixels must be selected
        int rounds = 0;
        double residual = 0;
    };
    // Finds the shares of s0 and the pressures at the separation Z, for clearances of all points,
    // next to those of the start. A share of 1: the pixel touches. The change of shares in a round
    // is at the end below `tolerance`.
    Outcome balance(const std::vector<double>& clearance, double Z, double tolerance);
    // Of the pixels: shares, pressures and gaps.
    const std::vector<double>& share() const { return share_; }
    const std::vector<double>& pressure() const { return p_; }
    const std::vector<double>& gap() const { return u_; }
    // Sum of the pressures by which touching pixels sink by 1 to this error of each, the other
    // shares being fixed.
    double stiffness(double error);

private:
    bool touches(std::size_t k) const { return share_[k] == 1; }
    bool precondition(const std::vector<double>& r, std::vector<double>& y);
    template <class Done>
    void descend(Done&& done);
    void load(bool exact);
    bool advance(double tolerance);
    double change(std::size_t k) const;

    PixelProducts& products_;
    const CutMap& map_;
    bool wraps_;
    double s0_, u0_;
    PixelStencil inverse_;
    SparsePlane plane_;
    std::vector<std::int32_t> where_;  // index of each point of the map among the pixels, or -1
    std::vector<Pixel> pixels_;
    std::vector<std::array<std::int32_t, 8>> around_;  // neighbours; -1: none, -2: not selected
    std::vector<std::size_t> rows_;
    std::vector<std::int32_t> column_;
    std::vector<double> p_, u_, share_, before_, overlap_, loaded_;
    std::vector<float> from_, to_;
};

}  // namespace rsc
