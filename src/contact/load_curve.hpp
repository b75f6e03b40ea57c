// Load curve of a contact as a function of the approach, the only property of a contact that friction uses.
#pragma once

namespace rsc {

class LoadCurve {
public:
    struct Load {
        double force = 0;   // N(delta) [force]
        double energy = 0;  // W(delta), dW/ddelta = N [force length]
    };
    virtual ~LoadCurve() = default;
    // Approach at first touch, at and below which all results are 0; Infinity if nothing can touch.
    virtual double first_touch() const = 0;
    virtual Load load(double delta) = 0;
    virtual double stiffness(double delta) = 0;  // S = dN/ddelta >= 0
    virtual double approach(double force) = 0;   // delta at which N(delta) = force > 0
};

}  // namespace rsc
