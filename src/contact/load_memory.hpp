// What a body that relaxes remembers of the loads on its places (law/relaxation.hpp): loads f at the end of a step deflect
//     K [compliance f + r],   r the rest of earlier loads,
// K being the instantaneous body's deflections, so that a step is an elastic problem with a known gap. Exact where loads change linearly
// within each step, up or down.
#pragma once

#include "contact/law/relaxation.hpp"
#include "rough/surface.hpp"

namespace rsc {

class LoadMemory {
public:
    explicit LoadMemory(const Creep& creep);

    // The step that begins with the last accepted loads and takes dt. May be told anew until loads are accepted.
    void step(double dt) { passage_ = Passage(creep_, dt); }
    double compliance() const { return passage_.compliance; }

    // Places that ever carried a load, increasing, and the rest of each at the end of the step: never negative where loads never were.
    const std::vector<std::int32_t>& places() const { return places_; }
    std::vector<double> rest() const;

    // Loads f at the end of the step, > 0 at `where` (increasing) and 0 elsewhere. `deflect` gives K f over the places, those of `where`
    // among them.
    using Deflect = std::function<std::vector<double>(const std::vector<double>& f)>;
    void accept(std::span<const std::int32_t> where, std::span<const double> f, const Deflect& deflect);

    // In units of load times deflection: what is stored, f'Kf/2 and that of each retardation, and what has been lost since the first load.
    double stored() const;
    double lost() const { return lost_; }

    void forget();
    // All of it, as numbers, and back; returns how many numbers were its own. Throws Error(bad_input) for what is none.
    void write(std::vector<double>& numbers) const;
    std::size_t read(std::span<const double> numbers);

private:
    Creep creep_;
    Passage passage_;
    std::vector<std::int32_t> places_;
    std::vector<double> f_;
    std::vector<std::vector<double>> y_;  // of each retardation
    // f'Kf, y_k'Kf, y_k'Ky_k.
    double ff_ = 0, lost_ = 0;
    std::vector<double> yf_, yy_;
};

// Of the pixels of a map, behind a first number. Throws Error(bad_input) where they do not lie on it.
void recall_loads(LoadMemory& loads, const std::vector<double>& memory, const HeightMap& map);

}  // namespace rsc
