// Boundary-element contact of a rough surface with an indenter: every pixel carries a uniform pressure p >= 0 (Johnson 1985, section 3.4;
// Polonsky and Keer, Wear 231, 1999). The asperity model is an approximation of this.
//
// With a hardness H, p <= H. Where p = H the gap w may be negative; the heights are permanently lowered by -w when the level is accepted.
// The plastic work is H times the volume of this residual, and W = p'Kp/2 is recoverable.
//
// For relaxing bodies (solids%relaxation_share) a level is an elastic problem with an additional gap due to earlier loads
// (load_memory.hpp).
#pragma once

#include "contact/contact.hpp"
#include "rough/surface.hpp"

namespace rsc {

class ElementContact final : public Contact {
public:
    // The heights must outlive the contact and are not changed. The options used are the tolerance, the number of iterations and the
    // hardness (without size effect, because pixels have no radius). Throws Error(bad_input) for moduli, radii, heights or options out of
    // range.
    ElementContact(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);
    ~ElementContact() override;
    ElementContact(ElementContact&&) noexcept;

    double stiffness() override;

    // W = p'Kp dx dy/2, evaluated as g0'p - p'Kp/2, which is equal at the solution.
    double energy() const override;
    bool path_dependent() const override;
    bool relaxes() const override;
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& memory, const Level* level) override;
    ResidualProfile residual_profile() const override;

    void move_tip(double x0, double y0) override;
    double first_touch() const override;
    const Indenter& indenter() const override;

protected:
    void forget_levels() override;
    // The solution is unique (K is positive definite); earlier levels are starting points and affect it only within the tolerance. Contacts
    // and their areas: pixel_spots.hpp.
    Level solve(double Z0) override;
    std::optional<Level> solve_under(double N) override;
    void accept(Level& level) override;
    void step(double dt) override;
    double slope() override;
    double tolerance() const override;
    // Bound by the smooth indenter, if known, and by a flat punch as wide as the surface; rough surfaces need at least this depth.
    double force_at_most(double depth) override;
    std::optional<double> likely_separation() const override;
    double shift() const override;
    std::size_t levels_since_move() const override;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Creates an ElementContact, or with periodic boundaries a PeriodicElementContact (periodic_element_contact.hpp).
std::unique_ptr<Contact> make_element_contact(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);

}  // namespace rsc
