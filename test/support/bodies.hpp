// Bodies with some physics.
#pragma once

#include "contact/indentation.hpp"
#include "physics/adhesion/sticking.hpp"
#include "physics/hardness/hardness.hpp"
#include "physics/relaxation/relaxation.hpp"
#include "physics/wear/wear.hpp"

// With these parameters.
template <class... Parameters>
rsc::BodyPhysics bodies_with(const Parameters&... parameters) {
    rsc::BodyPhysics all;
    ((all.of<Parameters>() = parameters), ...);
    return all;
}
