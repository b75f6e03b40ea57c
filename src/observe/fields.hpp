// Fields of some levels on the points of the surface (&output fields): pressure, gap, contact and heights in a window.
#pragma once

#include "contact/indentation.hpp"
#include "contact/level.hpp"
#include "rough/surface.hpp"

namespace rsc {

// In the order of the names that output%fields may have.
enum class Field { pressure, gap, contact, heights };
inline constexpr std::array kFieldNames = {"pressure", "gap", "contact", "heights"};

struct FieldsAsked {
    bool pressure = false, gap = false, contact = false, heights = false;
    bool any() const { return pressure || gap || contact || heights; }
    std::optional<std::array<double, 4>> window;  // x0, x1, y0, y1 [length]; none: about the contact
};

// What is asked for and computed; what is not asked for is empty.
struct Fields {
    std::vector<std::int32_t> step;     // the levels, from 0
    std::vector<double> x, y;           // of the points in the window [length]
    std::vector<double> pressure, gap;  // [step][y][x] [force/length^2], [length; NaN where nothing is above]
    std::vector<std::int32_t> contact;  // [step][y][x] 1 where the bodies touch
    std::vector<double> heights;        // [y][x] of the surface without load [length]
};

// A level whose fields are wanted. `lowered`: of elements, the points that are lower for good after it.
struct FieldLevel {
    std::int32_t step;
    const Level* level;
    ResidualProfile lowered;
};

// The fields of these levels of one contact. The pressure of elements is theirs; that of an asperity is Hertz's over its spot, or uniform
// where it yields, on the points in the spot (the nearest one, where none is in it), so that their forces add up to the spot's. The gap is
// that between the indenter and the surface as the pressures on its points deform it; asperities do not follow every point of the surface,
// and where it would pass through the indenter their gap is 0. Without a window the fields are about the contact of all levels, with a
// margin, or, between flats that repeat, on the whole surface. Throws Error(bad_input) for a window that holds no points, no_memory.
Fields fields_of(const HeightMap& map, const Indenter& indenter, Interaction interaction, const std::vector<FieldLevel>& levels,
                 const FieldsAsked& asked);

}  // namespace rsc
