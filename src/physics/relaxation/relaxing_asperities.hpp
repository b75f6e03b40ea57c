// Interaction of asperities of a relaxing body: effect of the rests of their law
// (relaxing.hpp), and energies. Used by AsperityModel.
#pragma once

#include "physics/physics.hpp"
#include "physics/relaxation/relaxing.hpp"

namespace rsc {

extern const Physics kRelaxation;

class RelaxingAsperities final : public AsperityHistory {
public:
    // The asperities, the indenter, whose tip may move, and the law must outlive this object.
    // Deflections are accurate to `tolerance`, that of the levels.
    RelaxingAsperities(const Asperities& asperities, const Indenter& indenter, RelaxingLaw& law,
                       const Relaxation& body, double tolerance);

    void step(double dt) override;
    const Stepper* stepper() const override { return &steps_; }
    // Ratio of the forces of the law to the true ones.
    double scale() const override { return 1 / law_.modulus(); }
    // Sum of all rests: for periodic flats the surface rises by the kernel's shift times this sum.
    double rest() const override { return rest_; }

    // Subtracts the deflection by earlier loads from g0 of the candidates, and drops those that can
    // no longer touch.
    void lower(Candidates& candidates, Products& products) override;
    // Accepts the solution over the candidates; the next step has zero duration until step() is
    // called.
    void accept(const WorkingSet& candidates, const Solution& solution, Products& products,
                Level& level) override;

    // Stored energy of the springs and of the interaction (f'Bf/2 and that of each retardation),
    // and dissipated energy [force length].
    std::optional<double> stored() const override { return law_.stored() + stored_; }

    // The loads act on the spots of the level, and where it has no contact on circles of the
    // largest area so far.
    Remains remains(const Level& level) const override;

    void write(std::vector<double>& numbers) const override;
    void read(std::span<const double> numbers) override;

private:
    void add_places(std::vector<double>& x, std::vector<double>& y,
                    const std::vector<int>& places) const;

    const Asperities& asperities_;
    const Indenter& indenter_;
    RelaxingLaw& law_;
    Creep creep_;
    double tolerance_;
    TimeSteps steps_;
    // Last accepted level: forces f and interaction loads f + sum y_k, in the order of touched();
    // energies.
    std::vector<double> force_, load_;
    double stored_ = 0, lost_ = 0, held_ = 0;  // held_: f'B load
    std::vector<double> rests_;
    double rest_ = 0;
    // Current step: deflection of each asperity by earlier loads; NaN: unknown.
    std::vector<double> lowered_;
    std::vector<int> known_;
};

// The elastic law `law` of bodies that relax, and their history.
AsperityPhysics make_relaxing_asperities(const ContactBodies& bodies, std::unique_ptr<Law> law);

}  // namespace rsc
