// What is subtracted from a surface before its summits are looked for: the face of the body above it, whose difference from the surface is
// what touches.
#pragma once

namespace rsc {

class BodyAbove {
public:
    // Height, derivatives and nabla^4 at a place.
    struct Form {
        double height = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, biharmonic = 0;
    };
    virtual ~BodyAbove() = default;
    // Heights at the places (x0 + k dx, y), k = 0 ... n-1; Infinity where there is none. The face does not repeat, whatever the surface does,
    // unless periodic().
    virtual void row(int n, double x0, double dx, double y, double* height) const = 0;
    virtual Form at(double x, double y) const = 0;
    virtual bool periodic() const = 0;
};

}  // namespace rsc
