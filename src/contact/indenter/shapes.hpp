// All shapes an indenter may have: a row each.
#pragma once

#include "contact/indenter/shape.hpp"

namespace rsc {

using ShapeMaker = std::shared_ptr<const IndenterShape>(const char* name, const ShapeKeys& keys);
ShapeMaker make_sphere, make_paraboloid, make_cone, make_punch, make_map_shape;

// Makers throw Error(bad_input) for keys out of range.
struct ShapeRow {
    const char* name;  // as &indenter shape spells it
    ShapeMaker* make;
};
inline constexpr std::array kShapes = {
    ShapeRow{"sphere", make_sphere}, ShapeRow{"paraboloid", make_paraboloid}, ShapeRow{"cone", make_cone},
    ShapeRow{"punch", make_punch},   ShapeRow{"map", make_map_shape},
};

// Row `shape` of the table, made from keys; and the row with that name.
Shape make_shape(int shape, const ShapeKeys& keys);
int shape_number(const char* name);

}  // namespace rsc
