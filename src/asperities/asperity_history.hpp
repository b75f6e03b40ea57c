// Physics of asperities beyond an elastic contact: a law, and what accepted levels leave. Rooms of
// physics/ derive from these classes.
#pragma once

#include "asperities/asperity_level.hpp"
#include "asperities/candidates.hpp"
#include "contact/stepper.hpp"
#include "interaction/products.hpp"

namespace rsc {

// Nothing: elastic asperities.
class AsperityHistory {
public:
    virtual ~AsperityHistory() = default;

    // Accepts the solution over the candidates, and adds the dissipated work to its level.
    virtual void accept(const WorkingSet&, const Solution&, Products&, Level&) {}
    // As History::write() and read().
    virtual void write(std::vector<double>&) const {}
    virtual void read(std::span<const double>) {}
    // Energy stored in the bodies, where it is not that of the last solution.
    virtual std::optional<double> stored() const { return std::nullopt; }
    // As History.
    virtual Remains remains(const Level&) const { return {}; }

    // Bodies that relax: begins a step of time; the ratio of the forces of the law to the true ones
    // at its end; the sum of the loads that earlier levels leave; and the deflection by them, which
    // is subtracted from g0 of the candidates.
    virtual void step(double) {}
    virtual const Stepper* stepper() const { return nullptr; }
    virtual double scale() const { return 1; }
    virtual double rest() const { return 0; }
    virtual void lower(Candidates&, Products&) {}
};

struct AsperityPhysics {
    std::unique_ptr<Law> law;
    std::unique_ptr<AsperityHistory> history;  // of that law
};
// Makes the physics of unloaded asperities under the tip; the bodies outlive it.
using MakeAsperityPhysics = AsperityPhysics (*)(const ContactBodies& bodies);

}  // namespace rsc
