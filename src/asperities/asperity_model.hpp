// Contact of the asperities of a rough surface with an indenter: the deterministic multi-asperity
// model (paper, section 4).
#pragma once

#include "asperities/asperity_history.hpp"
#include "contact/model.hpp"
#include "surface/asperities.hpp"

namespace rsc {

class AsperityModel final : public Model, private History {
public:
    // The asperities are the summits of the surface and must outlive the model. Laws with summits
    // between grid points use the summits of the difference between surface and indenter instead
    // (shifted_summits.hpp), if options.surface.gentlest_slope is known. Throws Error(bad_input)
    // for moduli, shapes or options out of range.
    AsperityModel(const Asperities& asperities, const Indenter& indenter,
                  const SolverOptions& options, MakeAsperityPhysics physics);
    ~AsperityModel() override;

    const Indenter& indenter() const override;
    std::shared_ptr<const Asperities> asperities() const override;
    History* history() override;

    // The last level is a starting point for the next if its solution is proved unique. Summits of
    // the difference are those of a new contact at this place.
    void move_tip(double x0, double y0) override;
    ContactRange contact_range() const override;
    double shift() const override;

    // The solution depends only on z: earlier ones are used as starting points only if the solution
    // is proved unique. With path-dependent laws the solution continues the accepted levels.
    Level solve(double z, bool trial) override;
    void solve_again(double z, const Level& level) override;
    void forget() override;
    void keep(ArchiveWriter& to) const override;
    void recall(ArchiveReader& from) override;

    double stiffness(Slope which) override;
    // W = sum W_i(u_i) + F'BF/2: the work W_i = int_0^u f du of the asperities plus the interaction
    // energy. Since u + B F = g0, dW/dz = F'dg0/dz = -N. It is evaluated as -E(F) of newton.hpp,
    // which equals W at the solution with an error of the order of the square of the residual.
    double energy() const override;
    double force_at_most(double depth) override;

private:
    void accept(Level& level) override;
    std::vector<double> write() const override;
    void read(const std::vector<double>& numbers) override;
    const Stepper* stepper() const override;
    void step(double dt, double lasting) override;
    Remains remains(const Level& level) const override;

    void move_with_history(double x0, double y0);

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace rsc
