// Steps of time or of sliding between two levels, supplied by the physics that steps.
#pragma once

#include "contact/level.hpp"

namespace rsc {

// What the levels of a body depend on beside their order: time, or the distance of sliding.
enum class PathClock { none, time, distance };

// The way from the last accepted level to the next one, along which the separation, or under force
// control the force, changes linearly.
struct Leg {
    double length;  // of time, or of sliding
    bool by_force;  // the force is prescribed
    double force;   // of the last level
    // Solves at this part (0 to 1) of the way and accepts the solution if it converged. It ends a
    // step of this length; what the bodies then retain is that of a step of length `lasting` at its
    // pressures: another length in a stage of a step.
    std::function<Level(double part, double length, double lasting)> solve;
    std::function<void()> take_back;      // restores the state of the last level
    std::function<double()> first_touch;  // separation [length], of the bodies as they are now
};

class Stepper {
public:
    virtual ~Stepper() = default;
    virtual PathClock clock() const = 0;
    // Follows the leg to its end in as many steps as the accuracy needs. Ends at a level that did
    // not converge.
    virtual Level follow(const Leg& leg) const = 0;
};

}  // namespace rsc
