// Values of a contact of the library.
#pragma once

#include <cmath>

#include "check.hpp"
#include "rsc.h"

inline double value(rsc_contact* contact, const char* name) {
    double found = std::nan("");
    CHECK(rsc_contact_value(contact, name, &found) == RSC_SUCCESS);
    return found;
}

inline double force_at(rsc_contact* contact, double Z0) {
    double N = std::nan("");
    CHECK(rsc_contact_indent(contact, Z0, &N) == RSC_SUCCESS);
    return N;
}
