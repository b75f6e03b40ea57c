// Effect of earlier loads on a relaxing body (relaxation.hpp): the deflection under loads f at
// the end of a step is
//     K [compliance f + r],   r the rest of earlier loads,
// where K f are the deflections of the instantaneous body. A step is thus an elastic problem with a
// known gap. Exact if loads change linearly within each step.
#pragma once

#include "physics/relaxation/relaxation.hpp"

namespace rsc {

class LoadMemory {
public:
    explicit LoadMemory(const Creep& creep);

    // Sets the duration dt of the step that begins with the last accepted loads; may be called
    // again until loads are accepted.
    void step(double dt) { passage_ = Passage(creep_, dt); }
    double compliance() const { return passage_.compliance; }

    // Points that have ever carried a load, in increasing order, and the rest of each at the end of
    // the step.
    const std::vector<std::int32_t>& places() const { return places_; }
    std::vector<double> rest() const;
    // f + sum y_k after the last accepted loads: K times it are the deflections.
    std::vector<double> lasting() const;

    // Accepts loads f at the end of the step, > 0 at `where` (increasing) and 0 elsewhere.
    // `deflect` returns K f over all places(), including `where`.
    using Deflect = std::function<std::vector<double>(const std::vector<double>& f)>;
    void accept(std::span<const std::int32_t> where, std::span<const double> f,
                const Deflect& deflect);

    // Stored energy (f'Kf/2 and that of each retardation) and energy dissipated since the first
    // load, in units of load times deflection.
    double stored() const;
    double lost() const { return lost_; }

    void forget();
    // Writes the state as numbers, and restores it; read() returns how many numbers it used and
    // throws Error(bad_input) if they are invalid.
    void write(std::vector<double>& numbers) const;
    std::size_t read(std::span<const double> numbers);

private:
    Creep creep_;
    Passage passage_;
    std::vector<std::int32_t> places_;
    std::vector<double> f_;
    std::vector<std::vector<double>> y_;  // loads of each retardation
    // f'Kf, y_k'Kf, y_k'Ky_k.
    double ff_ = 0, lost_ = 0;
    std::vector<double> yf_, yy_;
};

}  // namespace rsc
