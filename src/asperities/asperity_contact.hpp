// Contact of the asperities of a rough surface with an indenter: the deterministic multi-asperity
// model (paper, section 4).
#pragma once

#include "contact/contact.hpp"
#include "surface/asperities.hpp"

namespace rsc {

class AsperityContact final : public Contact {
public:
    // The asperities are the summits of the surface and must outlive the contact. Laws with summits
    // between grid points use the summits of the difference between surface and indenter instead
    // (shifted_summits.hpp), if options.gentlest_slope is known. Throws Error(bad_input) for moduli,
    // shapes or options out of range.
    AsperityContact(const Asperities& asperities, const Indenter& indenter,
                    const SolverOptions& options);
    ~AsperityContact() override;
    AsperityContact(AsperityContact&&) noexcept;

    double stiffness() override;

    // W = sum W_i(u_i) + F'BF/2: the work W_i = int_0^u f du of the asperities plus the interaction
    // energy. Since u + B F = g0, dW/dZ0 = F'dg0/dZ0 = -N. It is evaluated as -E(F) of
    // solver/newton.hpp, which equals W at the solution with an error of the order of the square of
    // the residual.
    double energy() const override;

    // The last level is a starting point for the next if its solution is proved unique. Summits of
    // the difference are those of a new contact at this place.
    void move_tip(double x0, double y0) override;
    double first_touch() const override;
    const Indenter& indenter() const override;
    std::shared_ptr<const Asperities> asperities() const override;
    bool path_dependent() const override;
    bool relaxes() const override;
    double shortest_time() const override;
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& memory, const Level* level) override;
    std::optional<Level> lasting_loads(const Level& level) const override;
    std::vector<double> residual_depths() const override;

protected:
    void forget_levels() override;
    // The solution depends only on Z0: earlier levels are used as starting points only if the
    // solution is proved unique. With path-dependent laws the solution continues the accepted
    // levels.
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
    void move_with_memory(double x0, double y0);

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Creates an AsperityContact, or with adhesion the contact of adhesive_contact.hpp. The asperities
// must outlive it.
std::unique_ptr<Contact> make_asperity_contact(const Asperities& asperities,
                                               const Indenter& indenter,
                                               const SolverOptions& options);
std::unique_ptr<Contact> make_asperity_contact(Asperities&&, const Indenter&,
                                               const SolverOptions&) = delete;

}  // namespace rsc
