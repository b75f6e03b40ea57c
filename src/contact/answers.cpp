#include "contact/answers.hpp"

namespace rsc {

double conductance_length(double stiffness, double E_star) { return 0 - 2 * stiffness / E_star; }

double constriction_resistance(double conductance_length, const double (&resistivity)[2]) {
    const double sum = resistivity[0] + resistivity[1];
    return sum > 0 && conductance_length > 0 ? sum / conductance_length : kNotComputed;
}

void add_answers(Contact& contact, Level& level, const double (&resistivity)[2]) {
    if (std::isnan(level.force)) return;  // there is no valid state
    const Indenter& indenter = contact.indenter();
    level.stiffness = contact.stiffness();
    level.energy = contact.energy();
    const Vec2 force = lateral_force(indenter, level), moment = tip_moment(indenter, level);
    level.lateral_x = force.x, level.lateral_y = force.y;
    level.moment_x = moment.x, level.moment_y = moment.y;
    if (indenter.layers.count == 0) level.conductance_length = conductance_length(level.stiffness, indenter.E_star);
    level.resistance = constriction_resistance(level.conductance_length, resistivity);
}

}  // namespace rsc
