// What physics adds to boundary elements: rooms of physics/ make it.
#pragma once

#include "contact/model.hpp"
#include "surface/surface.hpp"

namespace rsc {

// How pressures lower the points of a map for good in the course of a path (physics/wear).
class Lowering {
public:
    virtual ~Lowering() = default;
    // The following levels end a step of this length, of which `lasting` remains when they are
    // accepted (Leg::solve).
    virtual void step(double length, double lasting) = 0;
    // Depth by which a unit pressure lowers a point in this step, and for good [length/pressure].
    virtual double rate() const = 0;
    virtual double lasting_rate() const = 0;
    // Adds the quantities of the lowered map, under this indenter, to an accepted level. `depths`:
    // how far each point of the surface was lowered in all; `yielded`: the part of it that is due
    // to yielding. An empty vector stands for zeros.
    virtual void measure(Level& level, const HeightMap& map, const Indenter& indenter,
                         const std::vector<double>& depths,
                         const std::vector<double>& yielded) const = 0;
    virtual const Stepper& stepper() const = 0;  // of the distance of sliding
};

// How earlier loads on the points of a map act on in a body that relaxes (physics/relaxation). The
// deflection under loads f at the end of a step is K [compliance f + r], where r is the rest of
// earlier loads and K f are the deflections of the instantaneous body. A step is thus an elastic
// problem with a known gap.
class LastingLoads {
public:
    virtual ~LastingLoads() = default;
    // Sets the duration dt of the step that begins with the last accepted loads; may be called
    // again until loads are accepted.
    virtual void step(double dt) = 0;
    virtual double compliance() const = 0;
    virtual const Stepper& stepper() const = 0;  // of time
    // Points that have ever carried a load, in increasing order, and the rest of each at the end of
    // the step.
    virtual const std::vector<std::int32_t>& places() const = 0;
    virtual std::vector<double> rest() const = 0;
    // The loads whose deflections by K are those after the last accepted loads.
    virtual std::vector<double> lasting() const = 0;
    // Accepts loads f at the end of the step, > 0 at `where` (increasing) and 0 elsewhere.
    // `deflect` returns K f over all places(), including `where`.
    using Deflect = std::function<std::vector<double>(const std::vector<double>& f)>;
    virtual void accept(std::span<const std::int32_t> where, std::span<const double> f,
                        const Deflect& deflect) = 0;
    // Stored energy, and energy dissipated since the first load, in units of load times deflection.
    virtual double stored() const = 0;
    virtual double lost() const = 0;
    virtual void forget() = 0;
    // Writes the state as numbers, and restores it; read() returns how many numbers it used and
    // throws Error(bad_input) if they are invalid.
    virtual void write(std::vector<double>& numbers) const = 0;
    virtual std::size_t read(std::span<const double> numbers) = 0;
};

// What physics adds to elements.
struct ElementPhysics {
    std::unique_ptr<Lowering> lowering = nullptr;
    std::unique_ptr<LastingLoads> loads = nullptr;
    double highest = kInfinity;  // limit of the pressures [force/length^2]
};

}  // namespace rsc
