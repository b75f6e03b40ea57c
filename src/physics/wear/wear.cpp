#include "physics/wear/wear.hpp"

#include "base/error.hpp"

namespace rsc {
namespace {

// Error of N, or of the depth, by the steps of sliding to a level.
constexpr double kAccuracy = 2e-3;

class WornPoints final : public Lowering {
public:
    explicit WornPoints(double coefficient) : coefficient_(coefficient) {}

    void step(double length) override { rate_ = coefficient_ * length; }
    double rate() const override { return rate_; }
    PathClock clock() const override { return PathClock::distance; }
    double accuracy() const override { return kAccuracy; }

    void measure(Level& level, const HeightMap& map,
                 const std::vector<double>& depths) const override {
        double volume = 0, deepest = 0, sum = 0, squares = 0;
        const auto each = [&](auto&& visit) {
            for (const int j : indices(map.ny))
                for (const int i : indices(map.nx))
                    visit(map(i, j), depths.empty() ? 0.0 : depths[at(j) * at(map.nx) + at(i)]);
        };
        each([&](double height, double depth) {
            volume += depth;
            deepest = std::max(deepest, depth);
            sum += height - depth;
        });
        const double points = double(map.nx) * map.ny, mean = sum / points;
        each([&](double height, double depth) {
            squares += (height - depth - mean) * (height - depth - mean);
        });
        level.worn_volume = volume * map.dx * map.dy;
        level.wear_depth_max = deepest;
        level.worn_rms = std::sqrt(squares / points);
    }

private:
    double coefficient_, rate_ = 0;
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
         .heading = "distance",
         .width = 11,
         .digits = 6},
        {.name = "worn_volume",
         .member = &V::worn_volume,
         .length_power = 3,
         .meaning = "volume that is worn off",
         .comment = "solids%wear_coefficient times the integral of the force over the sliding "
                    "distance, of both bodies",
         .always = false,
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
         .statistics = true,
         .plain = "largest depth of wear"},
        {.name = "worn_rms",
         .member = &V::worn_rms,
         .length_power = 1,
         .meaning = "rms height of the worn surface",
         .comment = "of all points about their mean",
         .always = false,
         .statistics = true,
         .plain = "rms height of the worn surface"},
        {.name = "sliding_error",
         .member = &V::sliding_error,
         .unit = "1",
         .meaning = "error by the steps in which the level was reached",
         .comment =
             "change of N, relative to the larger N of the two levels, by halving the steps; "
             "under a force that of the separation, relative to its depth below first touch of "
             "the worn surface; without the errors of earlier levels",
         .always = false},
    };
}

void print_worn(std::ostream& out, const RunFacts& run) {
    const auto& units = run.settings.run;
    if (units.realizations > 1 || run.levels.empty()) return;
    const char* const l = units.length_unit.c_str();
    const LevelValues& last = run.levels.back();
    out << format(
        "  %.4g %s3 are worn off, up to %.4g %s deep, and the surface has the rms height %.4g "
        "%s. Results depend on the loading history.\n",
        last.worn_volume, l, last.wear_depth_max, l, last.worn_rms, l);
}

}  // namespace

const Physics kWear = {
    .name = "wear",
    .key = "solids%wear_coefficient",
    .keys = wear_keys,
    .take = [](const Case& c, BodyPhysics& bodies) { bodies.wear = {c.solids.wear_coefficient}; },
    .asked = [](const BodyPhysics& bodies) { return bodies.wear.coefficient != 0; },
    .excludes = {{"adhesion"},
                 {"relaxation"},
                 {"hardness"},
                 {"solids%layer_thickness", "wear would thin the layers",
                  [](const Combination& c) { return c.layers; }},
                 {"friction", "it is for surfaces that remain as they are"},
                 {"solver%model",
                  "points of the surface wear, not asperities; use model = 'elements'",
                  [](const Combination& c) { return !c.elements; }}},
    .needs_elements = [](const Case&) { return "solids%wear_coefficient needs them"; },
    .path = "the surface remains as it is worn",
    .quantities = wear_quantities(),
    .lowers = true,
    .reshapes = true,
    .require_feasible = require_distances,
    .bytes_per_point = 58,  // depths, with those of the level before
    .remark = print_worn,
    .lowering = make_wear,
};

std::unique_ptr<Lowering> make_wear(const BodyPhysics& bodies) {
    const double k = bodies.wear.coefficient;
    if (!(k > 0 && std::isfinite(k)))
        bad_input("the coefficient of wear must be positive and finite");
    return std::make_unique<WornPoints>(k);
}

}  // namespace rsc
