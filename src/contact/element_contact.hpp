// The points of the surface themselves pressed by an indenter: no asperities, every pixel carries a uniform pressure p >= 0 (Johnson 1985,
// section 3.4; Polonsky and Keer, Wear 231, 1999). The asperity model approximates this.
//
// With a hardness H, p <= H: where p = H the gap w may be negative, and -w is pressed out for good: the heights are lowered by it when
// the level is accepted. Then H times the volume pressed out is the work lost, and what is left is elastic: W = p'Kp/2 comes back.
//
// A body that relaxes (solids%relaxation_share) has a level as the elastic problem with a gap that earlier loads have opened
// (load_memory.hpp).
#pragma once

#include "contact/contact.hpp"
#include "rough/surface.hpp"

namespace rsc {

class ElementContact final : public Contact {
public:
    // The heights must outlive the contact, which never changes them. Of the options it takes the tolerance, the number of iterations
    // and the hardness, without a size effect: a pixel has no radius. Throws Error(bad_input) for moduli, radii, heights or options out
    // of range.
    ElementContact(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);
    ~ElementContact() override;
    ElementContact(ElementContact&&) noexcept;

    double stiffness() override;

    // W = p'Kp dx dy/2, evaluated as g0'p - p'Kp/2, which equals it at the solution.
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
    // There is one solution (K is positive definite); earlier levels are a start, and change the answer within the tolerance only.
    // Contacts and their areas: pixel_spots.hpp.
    Level solve(double Z0) override;
    std::optional<Level> solve_under(double N) override;
    void accept(Level& level) override;
    void step(double dt) override;
    double slope() override;
    double tolerance() const override;
    // The smaller of the depths of a smooth indenter, if known, and of a flat punch as wide as the surface: a lower bound for rough surfaces.
    double force_at_most(double depth) override;
    std::optional<double> likely_separation() const override;
    double shift() const override;
    std::size_t levels_since_move() const override;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The contact of elements for an indenter: this one, or with periodic boundaries that of periodic_element_contact.hpp.
std::unique_ptr<Contact> make_element_contact(const HeightMap& heights, const Indenter& indenter, const SolverOptions& options);

}  // namespace rsc
