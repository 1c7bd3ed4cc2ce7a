#include "algebra3d/values/display/shape_of_value.h"

#include <algorithm>
#include <cassert>

#include "algebra3d/values/display/detail/mesh_shapes.h"
#include "algebra3d/values/display/detail/nested_shapes.h"
#include "algebra3d/values/display/detail/shape_parts.h"
#include "algebra3d/values/display/detail/small_shapes.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using ShapeMaker = Result<DrawnShape> (*)(const Value& value, const Monitor& monitor);

template <typename Solid>
Result<DrawnShape> of_triangles(const Value& value, const Monitor& monitor) {
  return detail::shape_of_mesh(value.get<Solid>().mesh(), value.get<Solid>().box(), monitor);
}

/// Makes the shape of a small value, which needs no monitor.
template <typename T, Result<DrawnShape> (*make)(const T&)>
Result<DrawnShape> of_small(const Value& value, const Monitor& /*monitor*/) {
  return make(value.get<T>());
}

/// The maker of the shapes of a type; null if it is not drawable.
ShapeMaker maker_for(const Type& type) {
  struct Row {
    const Type* type;
    ShapeMaker maker;
  };
  static const std::array<Row, 11> rows = {{
      {&TypeOf<Point3d>::type(), of_small<Point3d, detail::shape_of_point>},
      {&TypeOf<Points3d>::type(), of_small<Points3d, detail::shape_of_points>},
      {&TypeOf<Vector3d>::type(), of_small<Vector3d, detail::shape_of_vector>},
      {&TypeOf<Plane3d>::type(), of_small<Plane3d, detail::shape_of_plane>},
      {&TypeOf<Box3>::type(), of_small<Box3, detail::shape_of_box>},
      {&TypeOf<Surface3d>::type(), of_triangles<Surface3d>},
      {&TypeOf<Volume3d>::type(), of_triangles<Volume3d>},
      {&TypeOf<Mesh3d>::type(), of_triangles<Mesh3d>},
      {&TypeOf<Point2d>::type(), of_small<Point2d, detail::shape_of_point_in_plane>},
      {&TypeOf<Rect>::type(), of_small<Rect, detail::shape_of_rect>},
      {&TypeOf<Region>::type(),
       [](const Value& value, const Monitor& monitor) {
         return detail::shape_of_region(value.get<Region>(), monitor);
       }},
  }};
  for (const Row& row : rows)
    if (row.type == &type) return row.maker;
  return nullptr;
}

/// The shapes of all drawable values in a nested relation, as one. Recursion follows the nesting of its type.
Result<DrawnShape> shape_of_nested(const Value& value, const Monitor& monitor) {
  const auto& relation = value.get<NestedRelation>();
  std::vector<DrawnShape> shapes;
  for (std::size_t i = 0; i < relation.size(); ++i) {
    A3D_TRY(monitor.check());
    for (const Value& attribute : relation.tuple(i)) {
      if (!attribute.is_defined() || !is_drawable(attribute.type())) continue;
      A3D_ASSIGN(DrawnShape shape, shape_of(attribute, monitor.silent()));
      if (!shape.is_empty()) shapes.push_back(std::move(shape));
    }
  }
  return detail::joined(shapes);
}

}  // namespace

bool is_drawable(const Type& type) {
  const NestedRelationType* const nested = as_nested_relation(type);
  if (nested == nullptr) return maker_for(type) != nullptr;
  return std::ranges::any_of(nested->attributes(), [](const auto& attribute) { return is_drawable(*attribute.type); });
}

Result<DrawnShape> shape_of(const Value& value, const Monitor& monitor) {
  const ShapeMaker maker = as_nested_relation(value.type()) != nullptr ? shape_of_nested : maker_for(value.type());
  assert(maker != nullptr);
  DrawnShape shape;
  if (value.is_defined()) {
    A3D_ASSIGN(const Value loaded, value.loaded());
    A3D_ASSIGN(shape, maker(loaded, monitor));
  }
  detail::draw_as_point_if_tiny(shape);
  shape.kind = value.type().name();
  return shape;
}

}  // namespace algebra3d
