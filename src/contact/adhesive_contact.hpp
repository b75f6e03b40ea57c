// Contact of adhesive asperities (JKR, or with a range of the attraction): the deterministic multi-asperity model with forces of either sign.
//
// A level is the end of a path on which the separation changes quasi-statically from the last accepted level to the requested one. On this
// path asperities attach when they touch, and detach where the equilibrium of the attached ones becomes unstable; this may cause others to
// attach or detach at the same separation (an avalanche, counted as one jump). Each jump is located, so that the result does not depend on
// intermediate levels. A jump dissipates the energy difference of the states before and after it.
#pragma once

#include "contact/contact.hpp"
#include "contact/touching.hpp"
#include "rough/asperities.hpp"

namespace rsc {

class AdhesiveContact final : public Contact {
public:
    // Asperities, indenter and search as for AsperityContact; options.adhesion.work is positive. Throws Error(bad_input) for options that
    // are not available with adhesion.
    AdhesiveContact(const Asperities& asperities, const Indenter& indenter, const SolverOptions& options, SummitSearch search = {});
    ~AdhesiveContact() override;

    double stiffness() override;
    // Elastic energy minus w A, with dW/dZ0 = -N; 0 if nothing is attached.
    double energy() const override;
    // If asperities are attached, their state is followed while the tip moves on a straight line at the separation of the last accepted
    // level; they attach and detach on the way as on a path of separations. The next level includes these jumps. Throws
    // Error(not_converged) if the path is lost; the tip then stays where it was. If none is attached, the next level is approached from
    // above.
    void move_tip(double x0, double y0) override;
    double first_touch() const override;
    const Indenter& indenter() const override;
    const Asperities* asperities() const override;
    bool path_dependent() const override { return true; }
    bool pulls() const override { return true; }
    // Position of the tip, separation, dissipated energy, smallest force, and pairs of an attached asperity and its state.
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& memory, const Level* level) override;

protected:
    void forget_levels() override;
    Level solve(double Z0) override;
    // Follows the path to the first state with the force, towards the surface if it is larger than the present force, otherwise away. If no
    // state has the force, the level is that of the smallest force, with Fallback::held.
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
