// Table of all indenter shapes.
#pragma once

#include "contact/shape.hpp"

namespace rsc {

using ShapeMaker = std::shared_ptr<const IndenterShape>(const char* name, const ShapeKeys& keys);
ShapeMaker make_sphere, make_paraboloid, make_cone, make_punch, make_map_shape;

// The functions that make shapes throw Error(bad_input) for keys out of range.
struct ShapeRow {
    const char* name;  // name in &indenter shape
    ShapeMaker* make;
    std::array<std::string_view, 2>
        keys;  // other keys of &indenter that the shape takes; "!": must be given
};
inline constexpr std::array kShapes = {
    ShapeRow{"sphere", make_sphere, {}},
    ShapeRow{"paraboloid", make_paraboloid, {"radii", "angle"}},
    ShapeRow{"cone", make_cone, {"slope!"}},
    ShapeRow{"punch", make_punch, {"radius!", "rim_radius"}},
    ShapeRow{"map", make_map_shape, {"file!", "channel"}},
};

// Makes the shape of row `shape` of the table; returns the number of the row with a name.
Shape make_shape(int shape, const ShapeKeys& keys);
int shape_number(const char* name);

}  // namespace rsc
