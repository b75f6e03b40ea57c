// Boundary-element contact of two periodic rough flats: element_contact.hpp with boundary = 'periodic' (Johnson 1985, chapter 13).
#pragma once

#include "contact/contact.hpp"
#include "rough/surface.hpp"

namespace rsc {

// Separations are measured from z = 0 of the heights (the mean plane of synthetic surfaces and detrended maps) to the flat; the mean
// deflection is 0. As for asperities, a pressure mode of wavenumber k deflects the surface by 2/(E* |k|) times itself, the mean pressure by
// nothing.
class PeriodicElementContact final : public Contact {
public:
    // The heights must outlive the contact and are not changed; the map is the period. The options used are the tolerance, the number of
    // iterations and the hardness. Throws Error(bad_input) for moduli, radii, heights or options out of range.
    PeriodicElementContact(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);
    ~PeriodicElementContact() override;

    double stiffness() override;
    double energy() const override;  // W = p'Kp dx dy/2, as in element_contact.hpp
    void move_tip(double x0, double y0) override;
    double first_touch() const override;
    const Indenter& indenter() const override;
    bool path_dependent() const override;  // with a hardness or for relaxing bodies, as in element_contact.hpp
    bool relaxes() const override;
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& memory, const Level* level) override;
    ResidualProfile residual_profile() const override;

protected:
    void forget_levels() override {}  // levels do not depend on each other
    // Throw Error(bad_input) at full contact.
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
