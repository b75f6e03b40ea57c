// Adhesive boundary elements, free or periodic: the Maugis-Dugdale traction s0 = w/z0 acts across all gaps below z0, where w is the work of
// adhesion (Maugis, J. Colloid Interface Sci. 150, 1992).
//
// A pixel is in contact (gap w = 0, p >= -s0), cohesive (0 < w < z0, p = -s0) or free (p = 0). For a given set C of attracting pixels, q =
// p + s0 >= 0 solves the problem without adhesion for heights raised by s0 K 1_C: one convex solve. C is renewed, starting from that of the
// last accepted level, until it contains exactly the pixels with gaps below z0. The state thus follows the previous one at a given
// separation; if there is none nearby, the contact jumps: pixels enter or leave C in an avalanche.
//
// The error is of first order in h/z0, where h is the side of a pixel: a range below two pixels causes a warning, below half a pixel an
// error.
#pragma once

#include "contact/contact.hpp"
#include "rough/surface.hpp"

namespace rsc {

class AdhesiveElements final : public Contact {
public:
    // The heights must outlive the contact. The options used are the tolerance, the number of iterations and the adhesion with a positive
    // range. Throws Error(bad_input) for options that are not available with adhesion, and for a range below half a pixel.
    AdhesiveElements(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);
    ~AdhesiveElements() override;

    // dN/dZ0 for fixed attracting points.
    double stiffness() override;
    // Elastic energy minus s0 (z0 - w) integrated over the attracting points.
    double energy() const override;
    // Throws Error(bad_input) if any point attracts.
    void move_tip(double x0, double y0) override;
    double first_touch() const override;
    const Indenter& indenter() const override;
    bool path_dependent() const override { return true; }
    bool pulls() const override { return true; }
    // Separation, force, work done, smallest force, dissipated energy, then the attracting points.
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& memory, const Level* level) override;

protected:
    void forget_levels() override;
    // The dissipated energy is the work done since the first level (trapezoidal rule over the levels) minus the change of the energy.
    Level solve(double Z0) override;
    // Searches a separation with the force, towards the surface if it is larger than the present force, otherwise away. If there is none,
    // the level is that of the smallest force found, with Fallback::held.
    std::optional<Level> solve_under(double N) override;
    void accept(Level& level) override;
    double tolerance() const override;
    double closed() const override;
    double force_at_most(double) override { return 0; }
    std::optional<double> likely_separation() const override { return std::nullopt; }
    std::size_t levels_since_move() const override { return 0; }

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace rsc
