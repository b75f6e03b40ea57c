// The asperities of a rough surface pressed by an indenter: the deterministic multi-asperity model (paper, section 4).
#pragma once

#include "contact/contact.hpp"
#include "contact/touching.hpp"
#include "rough/asperities.hpp"

namespace rsc {

class AsperityContact final : public Contact {
public:
    // The asperities are the summits of the surface and must outlive the contact. Laws that take summits between the points, given a
    // search, are applied to the summits of the difference between surface and indenter: found by the search where the indenter is steeper
    // than kMostSlopeRatio of options.rms_slope above what it may touch, elsewhere moved from those of the surface. Otherwise the
    // asperities are taken as they are. Throws Error(bad_input) for moduli, shapes or options out of range.
    AsperityContact(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options, SummitSearch search = {});
    ~AsperityContact() override;
    AsperityContact(AsperityContact&&) noexcept;

    double stiffness() override;

    // W = sum W_i(u_i) + F'BF/2 with the work W_i = int_0^u f du of the asperities and the interaction energy: since u + B F = g0,
    // dW/dZ0 = F'dg0/dZ0 = -N, the contact is conservative. Evaluated as -E(F) of solver/newton.hpp, which equals W at the solution
    // and is in error only by the square of the residual.
    double energy() const override;

    // The last level goes on as a start for the next where the solution is proved unique. Summits of the difference are found anew once
    // the tip has moved by a tenth of a summit's size, and by as much as tilts the indenter by a fiftieth of the surface's rms slope; then
    // the contact goes on as one newly made. Those that remember their path keep their summits.
    void move_tip(double x0, double y0) override;
    double first_touch() const override;
    const Indenter& indenter() const override;
    const Asperities* asperities() const override;
    bool path_dependent() const override;
    bool relaxes() const override;
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& memory, const Level* level) override;
    std::vector<double> residual_depths() const override;

protected:
    void forget_levels() override;
    // The answer depends on Z0 alone: earlier levels are used as a start where the solution is proved unique, and not otherwise. Where the
    // law remembers its path, the answer is the one to which the accepted levels lead.
    Level solve(double Z0) override;
    Level pass(double Z0) override;
    Level settle(const Level& passed) override;
    double slope() override;
    void accept(Level& level) override;
    void step(double dt) override;
    double shift() const override;
    double tolerance() const override;
    double force_at_most(double depth) override;
    std::optional<double> likely_separation() const override;
    std::size_t levels_since_move() const override;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The contact of asperities that the options ask for: this one, or with adhesion the one of adhesive_contact.hpp.
std::unique_ptr<Contact> make_asperity_contact(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options,
                                               SummitSearch search = {});

}  // namespace rsc
