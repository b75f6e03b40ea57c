#include "physics/stress/stress_row.hpp"

#include "base/error.hpp"
#include "base/format.hpp"
#include "case/units.hpp"
#include "physics/stress/plane_stress.hpp"
#include "physics/stress/spot_stress.hpp"
#include "physics/stress/stress_error_table.hpp"

namespace rsc {
namespace {

using Value = LargestStress::Value;

struct Measure {
    const char *name, *meaning, *heading;
    Value LargestStress::*largest;
    std::vector<double> StressPlane::*plane;
};
constexpr Measure kMeasures[] = {
    {"mises", "equivalent stress of von Mises", "von Mises", &LargestStress::mises,
     &StressPlane::mises},
    {"shear", "shear stress, half the difference of the principal stresses", "shear    ",
     &LargestStress::shear, &StressPlane::shear},
    {"tension", "principal stress, negative where all are compressive", "tension  ",
     &LargestStress::tension, &StressPlane::tension}};
// The curves of a measure, in this order.
constexpr double Value::*kParts[] = {&Value::value, &Value::error, &Value::x, &Value::y};
constexpr std::size_t kCurves = std::size(kParts);

std::vector<Key> stress_keys() {
    using namespace keys;
    return {
        or_word(
            kStressDepthsNames, [](Case& c) { return slot_of(c.output.automatic_depths); },
            list(RSC_KEY(output, stress_depths), 1000, "length", kNotNegative, "",
                 "depths below the surface of body 1 at which the largest stresses of each level "
                 "are computed. auto: 0 and 15 depths from a step between points to a quarter of "
                 "the surface")),
        number(
            RSC_KEY(output, sliding_direction), "degree", between(-360, 360),
            "direction from the x axis in which body 2 slides over body 1: with stress_depths the "
            "stresses include those of sliding, mu times the pressure; of cycles of friction",
            "stresses without sliding; cycles along x"),
    };
}

void check_stresses(const Case& c, const Complain& complain) {
    const Case::Output& o = c.output;
    const auto require = [&](bool right, std::initializer_list<std::string_view> keys,
                             const char* text) {
        if (!right) complain(keys, text);
    };
    require(!o.sliding_direction || o.stresses() || c.solids.friction > 0,
            {"output%sliding_direction", "output%stress_depths"},
            "it is for the stresses at output%stress_depths, or for friction; give some");
    if (!o.stresses()) return;
    const bool elements = by_elements(c);
    require(std::ranges::is_sorted(o.stress_depths, std::less_equal<>()), {"output%stress_depths"},
            "must increase");
    require(c.solids.layer_thickness.empty(), {"output%stress_depths", "solids%layer_thickness"},
            "stresses below the surface are not available in layers");
    require(std::isfinite(c.solids.E[0]), {"output%stress_depths", "solids%E"},
            "stresses are those of body 1, which is rigid here; give the elastic body first");
    require(elements || !any_physics(c, &Physics::pulls), {"output%stress_depths", "solver%model"},
            "of asperities that attract there are none; use model = 'elements'");
    if (!o.sliding_direction) return;
    require(c.solids.friction > 0, {"output%sliding_direction", "solids%friction"},
            "needs solids%friction > 0");
    require(elements, {"output%sliding_direction", "solver%model"},
            "the stresses of sliding asperities are not available; use model = 'elements'");
}

std::vector<LevelCurve> stress_curves() {
    std::vector<LevelCurve> all;
    for (const Measure& m : kMeasures) {
        const std::string name = m.name + std::string("_max"), error = name + "_error_expected";
        all.push_back({.name = name,
                       .length_power = -2,
                       .force_power = 1,
                       .meaning = std::string("largest ") + m.meaning,
                       .comment = "below the contact and around it",
                       .error = error});
        all.push_back({.name = error,
                       .meaning = "expected relative error of " + name,
                       .comment = "not exceeded in nine of ten cases; follows from border_share",
                       .if_known = true});
        for (const std::string axis : {"x", "y"})
            all.push_back({.name = joined(name, "_", axis),
                           .length_power = 1,
                           .meaning = joined(axis, " of ", name)});
    }
    return all;
}

CurveAxis depths_of(const PreparedFacts& facts) {
    CurveAxis axis{"depth", "depth below the surface of body 1"};
    axis.values = facts.settings.output.stress_depths;
    if (axis.values.empty()) {
        if (!(facts.step > 0))
            bad_input(
                "output%stress_depths = 'auto' needs the points of a surface, and "
                "source = 'asperities' has none; list the depths");
        constexpr int count = 15;
        const double deepest = 0.25 * facts.width;
        axis.values = {0};
        for (const int k : indices(count))
            axis.values.push_back(facts.step * std::pow(deepest / facts.step, k / (count - 1.0)));
    }
    axis.size = axis.values.size();
    return axis;
}

class StressRecorder final : public LevelRecorder {
public:
    explicit StressRecorder(const RecordedBodies& bodies)
        : map_(bodies.map), depths_(bodies.axis.begin(), bodies.axis.end()) {
        const Case& settings = bodies.settings;
        body_.period = bodies.indenter.period;
        body_.nu = settings.solids.nu[0];
        if (!settings.output.sliding_direction) return;
        const double angle = *settings.output.sliding_direction * pi / 180;
        body_.sliding = {settings.solids.friction * std::cos(angle),
                         settings.solids.friction * std::sin(angle)};
    }

    bool record(const Level& level, std::vector<double>& curves) override {
        std::vector<LargestStress> all;
        for (const double depth : depths_) all.push_back(largest_at(depth, level));
        for (const Measure& m : kMeasures)
            for (const auto part : kParts)
                for (const LargestStress& s : all) curves.push_back(s.*m.largest.*part);
        return true;
    }

    FieldValues fields_below(const WindowPressures& on) override {
        FieldValues fields(std::size(kMeasures));
        const GridWindow window{on.window.columns.first, on.window.rows.first,
                                on.window.columns.size(), on.window.rows.size()};
        for (const double depth : depths_) {
            StressPlane plane;
            stress_below(on.map, on.pixels, body_, depth, window, memory_, &plane);
            for (const auto k : indices(fields)) append(fields[k], plane.*kMeasures[k].plane);
        }
        return fields;
    }

private:
    LargestStress largest_at(double depth, const Level& level) {
        if (std::isnan(level.force)) return {};
        const Period& period = body_.period;
        if (map_)
            return stress_below(*map_, level.pixels, body_, depth,
                                stressed_window(*map_, level.pixels, period, depth), memory_);
        const SpotPressures spots =
            pressures_of_spots(level, period, {0, 0, period.x, period.y}, depth);
        return stress_below(spots.grid, spots.pixels, body_, depth,
                            {0, 0, spots.grid.nx, spots.grid.ny}, memory_);
    }

    const HeightMap* map_;
    std::vector<double> depths_;
    StressedBody body_;
    StressMemory memory_;
};

void state_stress_errors(std::span<double> curves, std::span<const double> depths, double step,
                         const Case& settings, const LevelValues& level, const GridBodies& bodies) {
    const std::size_t n = depths.size();
    const auto curve = [&](std::size_t measure, std::size_t part) {
        return curves.subspan((measure * kCurves + part) * n, n);
    };
    for (const auto k : indices(depths)) {
        const auto error = [&](const StressError& e) {
            return e.factor * std::pow(level.border_share, e.power) *
                   std::pow(1 + 2 * depths[k] / step, -e.deeper) * e.factors.of(level, bodies);
        };
        curve(0, 1)[k] = error(kMisesError);
        curve(1, 1)[k] = error(kShearError);
        const double tension = std::abs(curve(2, 0)[k]);
        double of_tension = error(kTensionError) * curve(0, 0)[k];
        if (settings.output.sliding_direction && settings.solids.friction > 0)
            of_tension += error(kSlidingEdgeError) * tension;
        curve(2, 1)[k] = of_tension / tension;
    }
}

// Says where each stress of the last level is largest.
void print_stresses(std::ostream& out, const RunFacts& run) {
    const std::size_t n = run.axis.size();
    if (run.curves.empty()) return;
    const std::string length = run.settings.run.length_unit,
                      unit = unit_of(length, -2, run.settings.run.force_unit, 1);
    out << "largest stresses at the last level:\n";
    for (const auto m : indices(std::size(kMeasures))) {
        const auto part = [&](std::size_t k) {
            return run.curves.subspan((m * kCurves + k) * n, n);
        };
        std::size_t most = n;
        for (const auto k : indices(n))
            if (const double v = part(0)[k]; v > 0 && (most == n || v > part(0)[most])) most = k;
        if (most == n) continue;
        const double error = part(1)[most];
        out << format("  %s %.4g %s%s at (%.5g, %.5g) %s, depth %.4g %s\n", kMeasures[m].heading,
                      part(0)[most], unit.c_str(),
                      error > 0 ? joined(" +- ", percent(error)).c_str() : "", part(2)[most],
                      part(3)[most], length.c_str(), run.axis[most], length.c_str());
    }
}

}  // namespace

const Physics kStress = {
    .name = "stress",
    .key = "output%stress_depths",
    .keys = stress_keys,
    .take = [](const Case& c,
               BodyPhysics& bodies) { bodies.of<StressesAsked>() = {c.output.stresses()}; },
    .asked = [](const BodyPhysics& bodies) { return bodies.of<StressesAsked>().asked; },
    .check = check_stresses,
    .curves = stress_curves(),
    .axis = depths_of,
    .fields = {{"mises", kMeasures[0].meaning, -2, 1, true},
               {"shear", kMeasures[1].meaning, -2, 1, true},
               {"tension", kMeasures[2].meaning, -2, 1, true}},
    .recorder = [](const RecordedBodies& bodies) -> std::unique_ptr<LevelRecorder> {
        return std::make_unique<StressRecorder>(bodies);
    },
    .curve_errors = state_stress_errors,
    .calibrated = [](const BodyPhysics&, bool) { return true; },  // levels do not depend on it
    // pressures and six components on a plane that holds the surface beside its surroundings
    .bytes = [](double points) { return 7 * double(sizeof(double)) * points; },
    .remark = print_stresses,
};

}  // namespace rsc
