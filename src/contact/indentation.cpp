#include "contact/indentation.hpp"

#include "interaction/layers.hpp"

#include "base/error.hpp"

namespace rsc {

void require_sound(const Indenter& indenter) {
    if (!(indenter.E_star > 0) || std::isinf(indenter.E_star))
        bad_input("E* must be positive and finite");
    if (!indenter.shape) bad_input("the indenter has no shape");
    const Period& period = indenter.period;
    if (period.line() && !indenter.shape->repeats(period.x, period.y))
        bad_input("line contact requires an indenter that repeats along ",
                  period.along_x() ? "x" : "y", ", for example a cylinder with this axis");
    if (indenter.period.finite() && !indenter.shape->repeats(indenter.period.x, indenter.period.y))
        bad_input("periodic boundaries require two flats: both radii must be Infinity");
}

Substrate substrate_of(const Indenter& indenter) {
    return {indenter.E_star, layers_of(indenter.layers, indenter.E_star)};
}

}  // namespace rsc
