// Fields of selected levels on the points of the surface (&output fields): pressure, gap, contact
// and heights in a window.
#pragma once

#include "contact/indentation.hpp"
#include "contact/level.hpp"
#include "physics/physics.hpp"
#include "surface/surface.hpp"

namespace rsc {

struct FieldsAsked {
    bool pressure = false, gap = false, contact = false, heights = false;
    bool worn = false;  // heights are those after each level
    // Those of a physics, by their numbers in Physics::fields.
    struct OfPhysics {
        const AskedCurves* of;
        LevelRecorder* recorder;
        std::vector<std::size_t> rows;
    };
    std::vector<OfPhysics> physics = {};
    std::optional<std::array<double, 4>>
        window;  // x0, x1, y0, y1 [length]; absent: around the contact
    bool any() const { return pressure || gap || contact || heights || !physics.empty(); }
};

// The requested fields; others are empty.
struct Fields {
    std::vector<std::int32_t> step;  // the levels, from 0
    std::vector<double> x, y;        // of the points in the window [length]
    // [step][y][x] [force/length^2], [length; NaN where there is no indenter above]
    std::vector<double> pressure, gap;
    std::vector<std::int32_t> contact;  // [step][y][x] 1 in contact, otherwise 0
    std::vector<double>
        heights;  // [y][x], or if worn [step][y][x], of the undeformed surface [length]
    // Those of physics: [step][y][x], or along an axis [step][axis][y][x].
    struct OfPhysics {
        const PointField* row;
        const char* axis;
        std::vector<double> values;
    };
    std::vector<OfPhysics> physics;
};

// The points that yielded asperities have lost: those around a summit that are above it less its
// residual depth [length]. `repeats`: the surface is periodic.
ResidualProfile lowered_summits(const HeightMap& map, bool repeats, const Asperities& asperities,
                                const std::vector<double>& depths);

// A level whose fields are requested. `lowered`: plastic residual after the level; `lasting`:
// Remains::lasting_loads.
struct FieldLevel {
    std::int32_t step;
    const Level* level;
    ResidualProfile lowered;
    std::optional<Level> lasting = {};
    std::vector<FieldValues> physics = {};  // LevelRecorder::fields_at(), as FieldsAsked::physics
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
