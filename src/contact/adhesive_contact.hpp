// The asperities of a rough surface that stick to the indenter (JKR): the deterministic multi-asperity model with forces of either sign.
//
// A level is the end of a path: from the last accepted level the separation changes slowly, at fixed grips, to the one asked for. On the
// way asperities attach where they touch, and let go where the equilibrium of the attached ones ceases to be stable; either may make others
// do the same at once (an avalanche, counted as one jump). Each jump is found where it happens, so that the answer does not depend on the
// levels passed. A jump loses the energy by which the states before and after it differ.
#pragma once

#include "contact/contact.hpp"
#include "contact/touching.hpp"
#include "rough/asperities.hpp"

namespace rsc {

class AdhesiveContact final : public Contact {
public:
    // Asperities, indenter and search as for AsperityContact; options.adhesion.work is positive. Throws Error(bad_input) for what cannot
    // be had together with adhesion.
    AdhesiveContact(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options, SummitSearch search = {});
    ~AdhesiveContact() override;

    double stiffness() override;
    // The elastic energy less w A, with dW/dZ0 = -N; 0 where nothing is attached.
    double energy() const override;
    // Only while nothing is attached: throws Error(bad_input) otherwise.
    void move_tip(double x0, double y0) override;
    double first_touch() const override;
    const Indenter& indenter() const override;
    const Asperities* asperities() const override;
    bool path_dependent() const override { return true; }
    bool pulls() const override { return true; }
    // The separation, what has been lost, the smallest force, then pairs: an attached asperity, its state.
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& memory, const Level* level) override;

protected:
    void forget_levels() override;
    Level solve(double Z0) override;
    // Along the path to the first state that carries the force: towards the surface if it is more than now, away from it otherwise. Where
    // no state carries it, the level is the one with the smallest force met, and says so (Fallback::held).
    std::optional<Level> solve_under(double N) override;
    void accept(Level& level) override;
    double tolerance() const override;
    double force_at_most(double) override { return 0; }
    std::optional<double> likely_separation() const override { return std::nullopt; }
    std::size_t levels_since_move() const override { return 0; }

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace rsc
