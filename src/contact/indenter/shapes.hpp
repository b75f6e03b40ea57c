// Table of all indenter shapes.
#pragma once

#include "contact/indenter/shape.hpp"

namespace rsc {

using ShapeMaker = std::shared_ptr<const IndenterShape>(const char* name, const ShapeKeys& keys);
ShapeMaker make_sphere, make_paraboloid, make_cone, make_punch, make_map_shape;

// The functions that make shapes throw Error(bad_input) for keys out of range.
struct ShapeRow {
    const char* name;  // name in &indenter shape
    ShapeMaker* make;
};
inline constexpr std::array kShapes = {
    ShapeRow{"sphere", make_sphere}, ShapeRow{"paraboloid", make_paraboloid}, ShapeRow{"cone", make_cone},
    ShapeRow{"punch", make_punch},   ShapeRow{"map", make_map_shape},
};

// Makes the shape of row `shape` of the table; returns the number of the row with a name.
Shape make_shape(int shape, const ShapeKeys& keys);
int shape_number(const char* name);

}  // namespace rsc
