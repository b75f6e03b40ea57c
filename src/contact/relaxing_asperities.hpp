// Asperities of a body that relaxes, by their law (law/relaxing.hpp): what its rests and energies mean for their interaction. What
// asperity_contact.hpp asks beside the law.
#pragma once

#include "contact/candidates.hpp"
#include "contact/interaction/products.hpp"
#include "contact/law/relaxing.hpp"
#include "contact/working_set.hpp"

namespace rsc {

class RelaxingAsperities {
public:
    // The asperities and the law must outlive it. Deflections are accurate to `tolerance`, that of the levels.
    RelaxingAsperities(const Asperities& asperities, RelaxingLaw& law, const Creep& creep, double tolerance);

    void step(double dt);
    // Forces of the law are so many times the true ones.
    double scale() const { return 1 / law_.modulus(); }
    // The sum of all rests: between flats the surface rises by the kernel's shift times it.
    double rest() const { return rest_; }

    // Takes what earlier loads have left off the gaps of candidates, and drops those that cannot touch then.
    void lower(Candidates& candidates, Products& products);
    // The solution over the candidates is accepted; a step of no time follows.
    void accept(const WorkingSet& candidates, const Solution& solution, Products& products);

    // What the springs hold and what the interaction adds: f'Bf/2 and that of each retardation; and what has been lost [force length].
    double stored() const { return law_.stored() + stored_; }
    double lost() const { return law_.lost() + lost_; }

    void write(std::vector<double>& numbers) const;
    void read(std::span<const double> numbers);

private:
    void add_places(std::vector<double>& x, std::vector<double>& y, const std::vector<int>& places) const;

    const Asperities& asperities_;
    RelaxingLaw& law_;
    Creep creep_;
    double tolerance_;
    // Of the last accepted level, in the order of touched(): forces f, loads that act elsewhere, f + sum y_k; energies.
    std::vector<double> force_, load_;
    double stored_ = 0, lost_ = 0, held_ = 0;  // held_: f'B load
    std::vector<double> rests_;
    double rest_ = 0;
    // Of this step: how far earlier loads lower each asperity; NaN: not known.
    std::vector<double> lowered_;
    std::vector<int> known_;
};

}  // namespace rsc
