#include "physics/wear/wear.hpp"

#include "base/error.hpp"
#include "surface/form.hpp"

namespace rsc {
namespace {

// Change of N, or under a force of the depth below first touch, when the steps to a level are
// halved; of the area and the largest pressure, whose smallest change is a pixel; and a change
// of N that no longer matters, relative to N before the level.
constexpr double kAccuracy = 2e-3, kCoarse = 0.05, kWornOff = 1e-6;
constexpr int kMostSteps = 64;  // to a level

// A step has two implicit stages (SDIRK2: Alexander, SIAM J. Numer. Anal. 14, 1977): it is of
// second order, exact for the volume under a force that changes linearly, never adds material, and
// damps at once the pressures that a step before left uneven. The number of steps is doubled until
// the values change by less than their accuracy. Where wear takes the force off, its change is
// relative to that before the level.
class SlidingSteps final : public Stepper {
public:
    PathClock clock() const override { return PathClock::distance; }
    Level follow(const Leg& leg) const override {
        constexpr double stage = 1 - 1 / std::numbers::sqrt2;
        std::optional<LevelValues> last;
        for (int n = 1;; n *= 2) {
            if (last) leg.take_back();
            const double length = leg.length / n;
            Level level;
            const auto solve = [&](double part, double lasting) {
                level = leg.solve(part / n, stage * length, lasting * length);
                return level.converged;
            };
            for (const int k : indices(n))
                if (!solve(k + stage, 1 - stage) || !solve(k + 1, stage)) return level;
            if (last && (settled(leg, *last, level) || n >= kMostSteps)) return level;
            last = level;
        }
    }

private:
    // Compares a level with that of half as many steps, which is stored with it.
    static bool settled(const Leg& leg, const LevelValues& half, Level& level) {
        const double value = leg.by_force ? level.separation : level.force,
                     other = leg.by_force ? half.separation : half.force,
                     whole = leg.by_force ? leg.first_touch() - value : level.force;
        level.sliding_error = std::abs(value - other) / std::abs(whole);
        level.with_half_the_steps = half;
        const auto near = [](double a, double b) { return std::abs(a - b) <= kCoarse * b; };
        return (level.sliding_error <= kAccuracy ||
                (!leg.by_force && std::abs(value - other) <= kWornOff * leg.force)) &&
               near(half.area, level.area) && near(half.pressure_max, level.pressure_max);
    }
};

// rms height of the points that are worn, without their form: a quadratic surface, for two flats
// their mean. NaN where too few points are worn to have a form.
double worn_rms(const HeightMap& map, const std::vector<double>& depths, bool flats) {
    HeightMap worn = map.copy();
    worn.periodic = false;
    for (const int j : indices(map.ny))
        for (const int i : indices(map.nx)) {
            const double depth = depths.empty() ? 0.0 : depths[at(j) * at(map.nx) + at(i)];
            double& z = worn.row(j)[i];
            z = depth > 0 || flats ? z - depth : kNotComputed;
        }
    try {
        return detrend(worn, flats ? Detrend::mean : Detrend::quadratic).rms;
    } catch (const Error&) {
        return kNotComputed;
    }
}

class WornPoints final : public Lowering {
public:
    explicit WornPoints(double coefficient) : coefficient_(coefficient) {}

    void step(double length, double lasting) override {
        rate_ = coefficient_ * length;
        lasting_rate_ = coefficient_ * lasting;
    }
    double rate() const override { return rate_; }
    double lasting_rate() const override { return lasting_rate_; }
    const Stepper& stepper() const override { return steps_; }

    void measure(Level& level, const HeightMap& map, const Indenter& indenter,
                 const std::vector<double>& depths,
                 const std::vector<double>& yielded) const override {
        double volume = 0, deepest = 0;
        for (const auto k : indices(depths)) {
            const double worn = depths[k] - (yielded.empty() ? 0.0 : yielded[k]);
            volume += worn;
            deepest = std::max(deepest, worn);
        }
        level.worn_volume = volume * map.dx * map.dy;
        level.wear_depth_max = deepest;
        level.worn_rms = worn_rms(map, depths, indenter.shape->flat());
    }

private:
    SlidingSteps steps_;
    double coefficient_, rate_ = 0, lasting_rate_ = 0;
};

std::vector<Key> wear_keys() {
    using namespace keys;
    return {
        number(RSC_KEY(solids, wear_coefficient), "length^2/force", kNotNegative,
               "Archard's k: a pressure p that slides a distance ds wears off the depth k p ds, of "
               "both bodies together if body 2 is smooth; for elements, with "
               "indentation%sliding or distances"),
        number(RSC_KEY(indentation, sliding), "length", kPositive,
               "for a body that wears, distance of sliding from the first to the last level, in "
               "equal steps; the first level is reached without sliding",
               "none"),
        list(RSC_KEY(indentation, distances), 10000, "length", kNotNegative, "none",
             "distance of sliding of each level, increasing, instead of `sliding`; separations, or "
             "forces, change linearly in between"),
    };
}

void require_distances(const PreparedFacts& facts) {
    if (!facts.settings.indentation.slides())
        bad_input(
            "indentation%sliding: body 1 wears (solids%wear_coefficient), and the levels have no "
            "distances of sliding; give sliding or distances");
}

void check_wear(const Case& settings, const Complain& complain) {
    if (settings.solids.wear_coefficient > 0 && !settings.indenter.file.empty())
        complain({"solids%wear_coefficient", "indenter%shape"},
                 "not available together with indenter%shape; the heights of body 2 would have to "
                 "move over body 1 and wear, too");
}

// The integral of N over the distance has the error of N; it is known where N is prescribed.
double error_of_worn_volume(const LevelValues& level, std::size_t) {
    const bool by_force = level.area_error_expected >= 0 && std::isnan(level.force_error_expected);
    return by_force ? 0.0 : level.force_error_expected;
}

std::vector<LevelQuantity> wear_quantities() {
    using V = LevelValues;
    return {
        {.name = "distance",
         .member = &V::distance,
         .length_power = 1,
         .of_step = true,
         .meaning = "sliding distance of the level",
         .comment =
             "the load changes linearly between levels; the first level is reached without sliding",
         .always = false,
         .shown = [](const Case& c) { return c.indentation.slides(); },
         .heading = "distance",
         .width = 11,
         .digits = 6},
        {.name = "worn_volume",
         .member = &V::worn_volume,
         .length_power = 3,
         .meaning = "volume that is worn off",
         .comment = "solids%wear_coefficient times the integral of the force over the sliding "
                    "distance, of both bodies",
         .own_error = error_of_worn_volume,
         .always = false,
         .shown = [](const Case& c) { return c.solids.wear_coefficient > 0; },
         .answers = true,
         .statistics = true,
         .plain = "worn volume",
         .heading = "worn",
         .width = 12,
         .digits = 6},
        {.name = "wear_depth_max",
         .member = &V::wear_depth_max,
         .length_power = 1,
         .meaning = "largest depth that is worn off",
         .always = false,
         .answers = true,
         .statistics = true,
         .plain = "largest depth of wear"},
        {.name = "worn_rms",
         .member = &V::worn_rms,
         .length_power = 1,
         .meaning = "rms height of the worn points",
         .comment =
             "of the worn points, without their form: a quadratic surface, for two flats the mean",
         .always = false,
         .statistics = true,
         .plain = "rms height of the worn points"},
        {.name = "sliding_error",
         .member = &V::sliding_error,
         .unit = "1",
         .meaning = "error by the steps in which the level was reached",
         .comment =
             "relative change of N by halving the steps; under a force that of the separation, "
             "relative to its depth below first touch of the worn surface; without the errors of "
             "earlier levels",
         .always = false},
    };
}

void print_worn(std::ostream& out, const RunFacts& run) {
    const auto& units = run.settings.run;
    if (units.realizations > 1 || run.levels.empty()) return;
    const char* const l = units.length_unit.c_str();
    const LevelValues& last = run.levels.back();
    out << format(
        "  %.4g %s3 have worn off, up to %.4g %s deep, and the rms height of the surface is %.4g "
        "%s. Results depend on the loading history.\n",
        last.worn_volume, l, last.wear_depth_max, l, last.worn_rms, l);
}

}  // namespace

const Physics kWear = {
    .name = "wear",
    .key = "solids%wear_coefficient",
    .keys = wear_keys,
    .take = [](const Case& c,
               BodyPhysics& bodies) { bodies.of<Wear>() = {c.solids.wear_coefficient}; },
    .asked = [](const BodyPhysics& bodies) { return bodies.of<Wear>().coefficient != 0; },
    .excludes = {{"adhesion"},
                 {"relaxation"},
                 {"solids%layer_thickness", "wear would thin the layers",
                  [](const Combination& c) { return c.layers; }},
                 {"friction", "it is for surfaces that remain as they are"},
                 {"solver%model",
                  "points of the surface wear, not asperities; use model = 'elements'",
                  [](const Combination& c) { return !c.elements; }}},
    .check = check_wear,
    .needs_elements = [](const Case&) { return "solids%wear_coefficient needs them"; },
    .path = "the surface remains as it is worn",
    .quantities = wear_quantities(),
    .lowers = true,
    .reshapes = true,
    .require_feasible = require_distances,
    // How far Z0 of a worn surface changes with the grid was not studied.
    .further_approach =
        [](const Level& level, const HeightMap&, const Indenter&, const BodyPhysics&) {
            return level.worn_volume > 0 ? kNotComputed : 0.0;
        },
    .bytes_per_point = 58,  // depths, with those of the level before
    .remark = print_worn,
    .lowering = make_wear,
};

std::unique_ptr<Lowering> make_wear(const BodyPhysics& bodies) {
    const double k = bodies.of<Wear>().coefficient;
    if (!(k > 0 && std::isfinite(k)))
        bad_input("the coefficient of wear must be positive and finite");
    return std::make_unique<WornPoints>(k);
}

}  // namespace rsc
