// Two rough flats that repeat, by the points of the surface: element_contact.hpp with boundary = 'periodic' (Johnson 1985, chapter 13).
#pragma once

#include "contact/contact.hpp"
#include "rough/surface.hpp"

namespace rsc {

// Separations are from z = 0 of the heights, their mean plane where they have one (made surfaces, detrended maps), to the flat, the mean of
// all deflections being 0. It is the same for asperities: a mode of pressure with the wavenumber k deflects
// the surface by 2/(E* |k|) of itself, the mean pressure by nothing.
class PeriodicElementContact final : public Contact {
public:
    // The heights must outlive the contact, which never changes them; the map is the period. Of the options it takes the tolerance, the
    // number of iterations and the hardness. Throws Error(bad_input) for moduli, radii, heights or options out of range.
    PeriodicElementContact(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);
    ~PeriodicElementContact() override;

    double stiffness() override;
    double energy() const override;  // W = p'Kp dx dy/2, as in element_contact.hpp
    void move_tip(double x0, double y0) override;
    double first_touch() const override;
    const Indenter& indenter() const override;
    bool path_dependent() const override;  // with a hardness, or where it relaxes, as in element_contact.hpp
    bool relaxes() const override;
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& memory, const Level* level) override;
    ResidualProfile residual_profile() const override;

protected:
    void forget_levels() override {}  // a level depends on no other
    // Throw Error(bad_input) where the gap is closed altogether.
    Level solve(double Z0) override;
    std::optional<Level> solve_under(double N) override;
    void accept(Level& level) override;
    void step(double dt) override;
    double closed() const override;
    double tolerance() const override;
    double force_at_most(double depth) override;
    std::optional<double> likely_separation() const override { return std::nullopt; }
    std::size_t levels_since_move() const override { return 0; }

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace rsc
