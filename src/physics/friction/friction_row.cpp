#include "physics/friction/friction_row.hpp"

#include "base/format.hpp"
#include "contact/equivalent.hpp"
#include "physics/friction/contact_curve.hpp"
#include "physics/friction/load_table.hpp"

namespace rsc {
namespace {

std::vector<Key> friction_keys() {
    using namespace keys;
    return {
        number(RSC_KEY(solids, friction), "1", kNotNegative,
               "coefficient of friction mu; if above 0, the result has the tangential force at "
               "each level (one realization only)"),
    };
}

void check_friction(const Case& settings, const Complain& complain) {
    if (!(settings.solids.friction > 0)) return;
    if (settings.run.realizations > 1)
        complain({"run%realizations"}, "only one with solids%friction > 0");
    if (has_field(settings, "traction") && !by_elements(settings))
        complain({"output%fields", "solver%model"},
                 "'traction' is for elements; of asperities the picture `stick` shows the spots");
}

constexpr int kSteps = 40;              // of first loading
constexpr double kTractionSlide = 0.5;  // at which tractions are drawn, over that of full slip

CurveAxis points_of_slides(const PreparedFacts&) {
    const auto first = std::int32_t(kSteps) + 1, all = std::int32_t(slide_cycle_points(kSteps));
    return {.name = "point",
            .meaning = "point of a slide at constant separation",
            .size = at(all),
            .parts = {{"first_loading", {1, first}}, {"cycle", {first + 1, all}}},
            .comment =
                "first and last point of the first loading, from 0 to full slip, and of the "
                "cycle at 90 % of it, closed"};
}

std::vector<LevelCurve> friction_curves() {
    const std::string none = "missing without contact";
    return {
        {.name = "tangential_displacement",
         .length_power = 1,
         .meaning = "tangential displacement of the indenter",
         .comment = none,
         .of_single = true},
        {.name = "tangential_force",
         .force_power = 1,
         .meaning = "tangential force",
         .comment = "partial slip with the coefficient solids%friction at every point; at full "
                    "slip the coefficient times the normal force; " +
                    none,
         .of_single = true},
        {.name = "tangential_stiffness",
         .along = false,
         .length_power = -1,
         .force_power = 1,
         .meaning = "tangential stiffness in full stick",
         .comment = "4 G*/E* times -dN/dZ0; " + none,
         .of_single = true},
        {.name = "cycle_work",
         .along = false,
         .length_power = 1,
         .force_power = 1,
         .meaning = "friction work of a cycle",
         .comment = "the area of the loop; " + none,
         .of_single = true},
    };
}

// First loading and a cycle at each level, on copies of the contact. Asperities solve each load of
// the curve, boundary elements interpolate it (load_table.hpp).
class SlideRecorder final : public LevelRecorder {
public:
    explicit SlideRecorder(const RecordedBodies& bodies)
        : friction_{bodies.settings.solids.friction,
                    tangential_ratio(bodies.settings.solids.E, bodies.settings.solids.nu)} {
        copies_[0] = bodies.another();
        if (bodies.map) {
            table_.emplace(*copies_[0]);
        } else {
            copies_[1] = bodies.another();
            curve_.emplace(*copies_[0], *copies_[1]);
        }
    }

    bool in_order() const override { return true; }

    bool record(const Level& level, std::vector<double>& values) override {
        const double delta = -level.separation;
        const long before = failed();
        LoadCurve* curve = curve_ ? static_cast<LoadCurve*>(&*curve_) : &*table_;
        const bool touches = level.converged && delta > curve->first_touch();
        if (table_ && touches) {
            table_->add(level);
            table_->prepare(delta);
        }
        SlideCycle cycle;
        if (touches)
            cycle = slide_cycle(*curve, friction_, delta, kSteps);
        else
            cycle.displacement = cycle.force =
                std::vector<double>(slide_cycle_points(kSteps), kNotComputed);
        append(values, cycle.displacement);
        append(values, cycle.force);
        append(values, {touches ? -friction_.ratio * level.stiffness : kNotComputed,
                        touches ? cycle.work : kNotComputed});
        return failed() == before;
    }

    // The pixels that stick at a share of the slide of full slip have the pressures below which
    // nothing slips; the traction of a pixel is mu times what its pressure is above.
    FieldValues fields_at(LevelSource& source) override {
        const Level& level = source.level;
        std::vector<double> traction(at(source.map->nx) * at(source.map->ny), 0.0);
        const auto add = [&](const LevelPixels& pixels, double factor) {
            for (const auto k : indices(pixels.index))
                traction[at(pixels.index[k])] += factor * pixels.pressure[k];
        };
        add(level.pixels, friction_.coefficient);
        const double delta = -level.separation, touch = copies_[0]->first_touch();
        if (delta > -touch)
            add(copies_[0]->at_separation(-(delta - kTractionSlide * (delta + touch))).pixels,
                -friction_.coefficient);
        return {std::move(traction)};
    }

private:
    long failed() const { return table_ ? table_->failed() : curve_ ? curve_->failed() : 0; }

    Friction friction_;
    std::unique_ptr<Path> copies_[2];
    std::optional<ContactCurve> curve_;
    std::optional<LoadTable> table_;
};

// Dundurs' second parameter, which couples the normal and the tangential problem; 0 for equal
// bodies.
double coupling(const Case::Solids& s) {
    const auto compliance = [&](int i) {
        return std::isinf(s.E[i]) ? 0.0 : 2 * (1 + s.nu[i]) / s.E[i];
    };  // 1/G
    const double above = (1 - 2 * s.nu[0]) * compliance(0) - (1 - 2 * s.nu[1]) * compliance(1);
    const double below = 2 * ((1 - s.nu[0]) * compliance(0) + (1 - s.nu[1]) * compliance(1));
    return above / below;
}

// What a slide needs at the last level.
void print_slide(std::ostream& out, const RunFacts& run) {
    if (run.curves.size() < slide_cycle_points(kSteps) * 2 + 2) return;
    const auto& units = run.settings.run;
    const char *l = units.length_unit.c_str(), *f = units.force_unit.c_str();
    const std::size_t points = slide_cycle_points(kSteps), full = kSteps;
    const double stiffness = run.curves[2 * points], work = run.curves[2 * points + 1];
    if (std::isnan(stiffness)) return;
    out << format(
        "  sliding at the last level: all spots slip at Q = %.4g %s after %.4g %s; tangential "
        "stiffness %.4g %s/%s before slip; a cycle of 90 %% of this displacement takes %.4g %s %s "
        "of friction work.\n",
        run.curves[points + full], f, run.curves[full], l, stiffness, f, l, work, f, l);
}

void print_friction(std::ostream& out, const RunFacts& run) {
    print_slide(out, run);
    constexpr double much = 0.05;
    const double beta = coupling(run.settings.solids);
    if (std::abs(beta) > much)
        out << format(
            "  friction between unlike bodies: the coupling of pressure and tangential "
            "displacement (Dundurs' beta = %.2f) is neglected in the tangential forces.\n",
            beta);
}

}  // namespace

const Physics kFriction = {
    .name = "friction",
    .key = "solids%friction",
    .keys = friction_keys,
    .take = [](const Case& c,
               BodyPhysics& bodies) { bodies.of<Friction>().coefficient = c.solids.friction; },
    .asked = [](const BodyPhysics& bodies) { return bodies.of<Friction>().coefficient > 0; },
    .excludes = {{"solids%layer_thickness", "it is not for layers",
                  [](const Combination& c) { return c.layers; }}},
    .check = check_friction,
    .curves = friction_curves(),
    .axis = points_of_slides,
    .fields = {{"traction",
                "tangential traction of friction after first sliding, half-way to full slip", -2,
                1}},
    .recorder = [](const RecordedBodies& bodies) -> std::unique_ptr<LevelRecorder> {
        return std::make_unique<SlideRecorder>(bodies);
    },
    .calibrated = [](const BodyPhysics&, bool) { return true; },  // levels do not depend on it
    .remark = print_friction,
};

}  // namespace rsc
