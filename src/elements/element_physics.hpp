// What physics adds to boundary elements: rooms of physics/ make it.
#pragma once

#include "contact/model.hpp"
#include "surface/surface.hpp"

namespace rsc {

// How pressures lower the points of a map for good in the course of a path (physics/wear).
class Lowering {
public:
    virtual ~Lowering() = default;
    // The following levels end a step of this length.
    virtual void step(double length) = 0;
    // Depth by which a unit pressure lowers a point in this step [length/pressure].
    virtual double rate() const = 0;
    // Adds the quantities of the lowered map to an accepted level.
    virtual void measure(Level& level, const HeightMap& map,
                         const std::vector<double>& depths) const = 0;
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
