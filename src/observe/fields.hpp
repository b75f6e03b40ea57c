// Fields of selected levels on the points of the surface (&output fields): pressure, gap, contact
// and heights in a window.
#pragma once

#include "contact/indentation.hpp"
#include "contact/level.hpp"
#include "physics/stress/plane_stress.hpp"
#include "surface/surface.hpp"

namespace rsc {

// In the order of the names for output%fields.
enum class Field { pressure, gap, contact, heights, flow, mises, shear, tension, traction };
inline constexpr std::array kFieldNames = {"pressure", "gap",   "contact", "heights", "flow",
                                           "mises",    "shear", "tension", "traction"};
constexpr bool is_stress(Field f) {
    return f == Field::mises || f == Field::shear || f == Field::tension;
}

struct FieldsAsked {
    bool pressure = false, gap = false, contact = false, heights = false, flow = false;
    bool mises = false, shear = false, tension = false;
    bool traction = false;
    bool worn = false;  // heights are those after each level
    bool stresses() const { return mises || shear || tension; }
    bool any() const {
        return pressure || gap || contact || heights || flow || traction || stresses();
    }
    double friction = 0;         // coefficient, for the tractions
    std::vector<double> depths;  // of the stresses [length]
    StressedBody body;           // in which they are
    std::optional<std::array<double, 4>>
        window;  // x0, x1, y0, y1 [length]; absent: around the contact
};

// Slide at which tractions are drawn, over that of full slip.
inline constexpr double kTractionSlide = 0.5;

// The requested fields; others are empty.
struct Fields {
    std::vector<std::int32_t> step;  // the levels, from 0
    std::vector<double> x, y;        // of the points in the window [length]
    // [step][y][x] [force/length^2], [length; NaN where there is no indenter above]
    std::vector<double> pressure, gap;
    std::vector<std::int32_t> contact;  // [step][y][x] 1 in contact, otherwise 0
    std::vector<double>
        heights;  // [y][x], or if worn [step][y][x], of the undeformed surface [length]
    // [step][y][x] magnitude of the flux times viscosity for a mean pressure gradient 1 along x
    // [length^3]
    std::vector<double> flow;
    // [step][y][x] of first sliding, kTractionSlide of the way to full slip [force/length^2]
    std::vector<double> traction;
    std::vector<double> depth;                  // of the stresses [length]
    std::vector<double> mises, shear, tension;  // [step][depth][y][x] [force/length^2]
};

// The stresses in files, one row each.
struct StressQuantity {
    const char *name, *meaning;
    LargestStress::Value LargestStress::*of;
    std::vector<double> Fields::*field;
};
inline constexpr StressQuantity kStressQuantities[] = {
    {"mises", "equivalent stress of von Mises", &LargestStress::mises, &Fields::mises},
    {"shear", "shear stress, half the difference of the principal stresses", &LargestStress::shear,
     &Fields::shear},
    {"tension", "principal stress, negative where all are compressive", &LargestStress::tension,
     &Fields::tension}};

// The points that yielded asperities have lost: those around a summit that are above it less its
// residual depth [length]. `repeats`: the surface is periodic.
ResidualProfile lowered_summits(const HeightMap& map, bool repeats, const Asperities& asperities,
                                const std::vector<double>& depths);

// A level whose fields are requested. `lowered`: plastic residual after the level; `lasting`:
// Path::lasting_loads().
struct FieldLevel {
    std::int32_t step;
    const Level* level;
    ResidualProfile lowered;
    std::optional<Level> lasting = {};
    std::vector<double> flow = {};  // of all points, row by row
    LevelPixels stuck = {};         // FrictionLevels::stuck()
};

// Computes fields of levels of one contact. Pressures are those of boundary elements, or of
// asperities: Hertzian over each spot (the ellipses of Level::spots), uniform if it yields, with
// the tension of adhesion (contact/deflection.hpp), on the points within the spot (or the nearest
// point), scaled to the force of the spot. The gap is that between the indenter and the surface
// deformed by these pressures; for asperities, which do not follow every point of the surface, it
// is 0 where the surface would penetrate the indenter. Without a window the fields cover the
// contact of all levels with a margin, or the whole surface of periodic flats. Throws
// Error(bad_input) if the window contains no points, Error(no_memory).
Fields fields_of(const HeightMap& map, const Indenter& indenter, Interaction interaction,
                 const std::vector<FieldLevel>& levels, const FieldsAsked& asked);

}  // namespace rsc
