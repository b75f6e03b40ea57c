// The points of a surface that attract: Maugis and Dugdale's traction s0 = w/z0 across every gap below z0 (Maugis, J. Colloid Interface
// Sci. 150, 1992), w the work of adhesion, free and between flats.
//
// A pixel is in contact (gap w = 0, p >= -s0), cohesive (0 < w < z0, p = -s0) or free (p = 0). For a given set C of pixels that attract,
// q = p + s0 is bounded by q >= 0 and the problem is that of elements without adhesion with heights raised by s0 K 1_C: one convex solve. C is
// renewed, from that of the last accepted level, until it holds all gaps below z0 and no others. So the state follows from the one before at
// fixed grips, and where none is near, the contact jumps: pixels then enter or leave C in an avalanche.
//
// The error is of first order in the side h of a pixel over z0: fewer than two pixels within the range are told, half a one is refused.
#pragma once

#include "contact/contact.hpp"
#include "rough/surface.hpp"

namespace rsc {

class AdhesiveElements final : public Contact {
public:
    // The heights must outlive the contact. Of the options it takes the tolerance, the number of iterations and the adhesion, whose range is
    // positive. Throws Error(bad_input) for what cannot be had together with adhesion, and for a range below half a pixel.
    AdhesiveElements(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);
    ~AdhesiveElements() override;

    // dN/dZ0 with the points that attract as they are.
    double stiffness() override;
    // The elastic energy less s0 (z0 - w) over the points that attract.
    double energy() const override;
    // Only while nothing attracts: throws Error(bad_input) otherwise.
    void move_tip(double x0, double y0) override;
    double first_touch() const override;
    const Indenter& indenter() const override;
    bool path_dependent() const override { return true; }
    bool pulls() const override { return true; }
    // Separation, force, work done, the smallest force, what is lost, then the points that attract.
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& memory, const Level* level) override;

protected:
    void forget_levels() override;
    // The energy lost is the work done, by the trapezoidal rule over the levels from the first one on, less the change of the energy.
    Level solve(double Z0) override;
    // A separation that carries the force, towards the surface if it is more than now, away from it otherwise. Where none does, the level is
    // the one of the smallest force met on the way, and says so (Fallback::held).
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
