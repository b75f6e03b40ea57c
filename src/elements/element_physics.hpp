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
    // accepted (Path: the stages of a step).
    virtual void step(double length, double lasting) = 0;
    // Depth by which a unit pressure lowers a point in this step, and for good [length/pressure].
    virtual double rate() const = 0;
    virtual double lasting_rate() const = 0;
    // Adds the quantities of the lowered map, under this indenter, to an accepted level. `depths`:
    // by which the points were lowered, of these `yielded` by yielding; empty: nowhere.
    virtual void measure(Level& level, const HeightMap& map, const Indenter& indenter,
                         const std::vector<double>& depths,
                         const std::vector<double>& yielded) const = 0;
    // As History.
    virtual PathClock clock() const = 0;
    virtual double accuracy() const = 0;
};

// What physics adds to elements.
struct ElementPhysics {
    std::unique_ptr<Lowering> lowering = nullptr;
    double highest = kInfinity;  // limit of the pressures [force/length^2]
};

}  // namespace rsc
