// The classes of bodies whose expected errors by the grid are larger.
#pragma once

#include "contact/level.hpp"

namespace rsc {

// Expected relative errors of N and A at a separation.
struct GridError {
    double force = 0, area = 0;
};

struct GridBodies {
    bool measured = false;  // the heights were measured, and may have waves as short as their grid
    bool edged = false;     // body 2 is a punch or a cone
};

// Factors of the errors of measured heights, of punches and cones, and of yielding contacts.
struct ClassFactors {
    double measured, edged, yielding;

    double of(const LevelValues& level, const GridBodies& bodies) const {
        return (bodies.measured ? measured : 1.0) * (bodies.edged ? edged : 1.0) *
               (level.plastic_contacts > 0 ? yielding : 1.0);
    }
};

}  // namespace rsc
