#include "contact/answers.hpp"

namespace rsc {
namespace {

// Calls add(dx, dy, f) for every force of a level, with its offset from the tip. The forces are
// those of pixels, if any; for smooth periodic flats those of contacts, which lie within one
// period, and of points that attract without contact.
template <class Add>
void for_each_force(const Indenter& indenter, const Level& level, Add add) {
    const LevelPixels& pixels = level.pixels;
    const bool by_contacts = indenter.period.finite() && indenter.shape->flat();
    pixels.each([&](std::int32_t pixel, double pressure, int contact) {
        if (!by_contacts || contact < 0)
            add(pixels.x_of(pixel) - indenter.x0, pixels.y_of(pixel) - indenter.y0,
                pressure * pixels.dx * pixels.dy);
    });
    if (!by_contacts && !pixels.empty()) return;
    const LevelTractions& t = level.tractions;  // also of asperities that attract before contact
    for (const auto k : indices(t.x))
        add(t.x[k] - indenter.x0, t.y[k] - indenter.y0, t.pressed[k] + t.pulled[k]);
    for (std::size_t k = 0; k < level.f.size() && t.x.empty(); ++k)
        add(level.x[k] - indenter.x0, level.y[k] - indenter.y0, level.f[k]);
}

}  // namespace

Vec2 lateral_force(const Indenter& indenter, const Level& level) {
    Vec2 sum;
    if (indenter.shape->flat()) return sum;
    for_each_force(indenter, level, [&](double dx, double dy, double f) {
        const Vec2 slope = indenter.shape->gradient(dx, dy);
        sum.x -= f * slope.x;
        sum.y -= f * slope.y;
    });
    return sum;
}

Vec2 tip_moment(const Indenter& indenter, const Level& level) {
    Vec2 sum;
    for_each_force(indenter, level, [&](double dx, double dy, double f) {
        const double s = indenter.shape->height(dx, dy);
        const Vec2 slope = indenter.shape->gradient(dx, dy);
        sum.x += f * (dy + s * slope.y);
        sum.y -= f * (dx + s * slope.x);
    });
    return sum;
}

double conductance_length(Path& contact, double stiffness) {
    const Indenter& indenter = contact.indenter();
    if (indenter.layers.count > 0) return kNotComputed;
    return 2 * (contact.pulls() ? contact.clamped_stiffness() : 0 - stiffness) / indenter.E_star;
}

double constriction_resistance(double conductance_length,
                               const std::array<double, 2>& resistivity) {
    const double sum = resistivity[0] + resistivity[1];
    return sum > 0 && conductance_length > 0 ? sum / conductance_length : kNotComputed;
}

const char* compute_stiffness(LevelSource& source) {
    double& known = source.level.stiffness;
    if (std::isnan(known)) known = source.contact.stiffness();
    return nullptr;
}

const char* compute_lateral_force(LevelSource& source) {
    const Vec2 force = lateral_force(source.contact.indenter_at_level(), source.level);
    source.level.lateral_x = force.x;
    source.level.lateral_y = force.y;
    return nullptr;
}

const char* compute_moment(LevelSource& source) {
    const Vec2 moment = tip_moment(source.contact.indenter_at_level(), source.level);
    source.level.moment_x = moment.x;
    source.level.moment_y = moment.y;
    return nullptr;
}

const char* compute_conductance(LevelSource& source) {
    if (source.contact.indenter().layers.count > 0)
        return "conductance is not available for a body with layers";
    (void)compute_stiffness(source);
    double& known = source.level.conductance_length;
    if (std::isnan(known)) known = conductance_length(source.contact, source.level.stiffness);
    return nullptr;
}

const char* compute_conductance_per_area(LevelSource& source) {
    const Period period = source.contact.indenter().period;
    if (!period.finite()) return "only two flats have a conductance per area";
    if (const char* const none = compute_conductance(source)) return none;
    source.level.conductance_per_area = source.level.conductance_length / period.area();
    return nullptr;
}

const char* compute_resistance(LevelSource& source) {
    const auto& resistivity = source.resistivity;
    if (!(resistivity[0] + resistivity[1] > 0))
        return "there is no resistance: solids%resistivity is 0 in the case of this contact";
    if (source.level.contacts == 0) return "there is no contact: the resistance is infinite";
    if (const char* const none = compute_conductance(source)) return none;
    source.level.resistance = constriction_resistance(source.level.conductance_length, resistivity);
    return nullptr;
}

}  // namespace rsc
