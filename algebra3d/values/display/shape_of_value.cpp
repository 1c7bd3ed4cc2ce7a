#include "algebra3d/values/display/shape_of_value.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/planar/constrained_delaunay.h"
#include "algebra3d/values/display/detail/mesh_shapes.h"
#include "algebra3d/values/display/detail/shape_parts.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

constexpr DrawnShape::Normal kUp = {0, 0, 127, 0};

Result<DrawnShape> single_point(const ExactPoint& position) {
  A3D_ASSIGN(DrawnShape shape, detail::shape_in(box_of(position)));
  shape.points.push_back(detail::add_position(shape, position.approx()));
  return shape;
}

/// Unit vectors u and v that make a right-handed frame with a unit vector w.
std::array<Vec3, 2> frame_around(const Vec3& w) {
  // The axis that is farthest from w.
  const Vec3 size{std::abs(w.x), std::abs(w.y), std::abs(w.z)};
  Vec3 axis;
  axis[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1;
  const Vec3 across = cross(axis, w);
  const Vec3 u = 1 / length(across) * across;
  return {u, cross(w, u)};
}

/// The lines of an arrow, as pairs of ends. Its head takes an eighth of it.
std::vector<std::array<Vec3, 2>> arrow(const Vec3& from, const Vec3& to) {
  std::vector<std::array<Vec3, 2>> lines{{from, to}};
  const Vec3 along = to - from;
  const double size = length(along);
  if (!(size > 0)) return lines;
  const auto [u, v] = frame_around(1 / size * along);
  const Vec3 neck = to - 0.125 * along;
  for (const Vec3& side : {u, v})
    for (const double width : {-size / 24, size / 24}) lines.push_back({to, neck + width * side});
  return lines;
}

void add_lines(DrawnShape& shape, const std::vector<std::array<Vec3, 2>>& lines) {
  for (const auto& [from, to] : lines) {
    const std::uint32_t first = detail::add_position(shape, from);
    shape.lines.push_back({first, detail::add_position(shape, to)});
  }
}

/// A plane by its normal of length 1 and its point nearest to the origin.
struct RoundedPlane {
  Vec3 normal, foot;
};

RoundedPlane rounded(const ExactPlane& plane) {
  // Components may be beyond the range of doubles; their ratios are not.
  Rational largest;
  for (const Rational& component : {plane.normal.x, plane.normal.y, plane.normal.z})
    largest = std::max(largest, component.sign() < 0 ? -component : component);
  const auto ratio = [&](const Rational& component) { return (component / largest).nearest_double(); };
  const Vec3 direction{ratio(plane.normal.x), ratio(plane.normal.y), ratio(plane.normal.z)};
  const RationalVec3 foot = (plane.offset / dot(plane.normal, plane.normal)) * plane.normal;
  return {1 / length(direction) * direction,
          {foot.x.nearest_double(), foot.y.nearest_double(), foot.z.nearest_double()}};
}

/// Triangles of corners at z = 0, added as positions one after the other.
void add_flat_face(DrawnShape& shape, std::span<const Vec3> corners, std::span<const IndexTriangle> triangles) {
  for (const Vec3& corner : corners) detail::add_position(shape, corner);
  shape.normals.assign(shape.positions.size(), kUp);
  shape.triangles.assign(triangles.begin(), triangles.end());
  shape.triangle_count = triangles.size();
}

constexpr std::array<IndexTriangle, 2> kSquare = {{{0, 1, 2}, {0, 2, 3}}};

Result<DrawnShape> shape_of_point(const Point3d& point) {
  return single_point(point.position);
}

Result<DrawnShape> shape_of_point_in_plane(const Point2d& point) {
  return single_point(point.position);
}

Result<DrawnShape> shape_of_points(const Points3d& points) {
  Box3 box;
  for (const ExactPoint& point : points.points()) box.extend(box_of(point));
  A3D_ASSIGN(DrawnShape shape, detail::shape_in(box));
  shape.positions.reserve(points.points().size());
  for (const ExactPoint& point : points.points()) detail::add_position(shape, point.approx());
  shape.points.resize(shape.positions.size());
  std::iota(shape.points.begin(), shape.points.end(), 0U);
  return shape;
}

Result<DrawnShape> shape_of_vector(const Vector3d& vector) {
  Box3 box = box_of(vector.components);
  box.extend(Vec3{});
  A3D_ASSIGN(DrawnShape shape, detail::shape_in(box));
  const Vec3 tip = vector.components.approx();
  if (tip == Vec3{})
    shape.points.push_back(detail::add_position(shape, tip));
  else
    add_lines(shape, arrow({}, tip));
  return shape;
}

Result<DrawnShape> shape_of_plane(const Plane3d& plane) {
  const auto [normal, foot] = rounded(plane.plane);
  const double reach = std::max(1.0, length(foot));
  const auto [u, v] = frame_around(normal);
  const std::array<Vec3, 4> corners = {foot - reach * u - reach * v, foot + reach * u - reach * v,
                                       foot + reach * u + reach * v, foot - reach * u + reach * v};
  const Vec3 tip = foot + 0.5 * reach * normal;
  Box3 box = Box3::around(corners);
  box.extend(tip);
  A3D_ASSIGN(DrawnShape shape, detail::shape_in(box));
  add_flat_face(shape, corners, kSquare);
  detail::add_loop(shape, 0, 4);
  add_lines(shape, arrow(foot, tip));
  shape.normals.assign(shape.positions.size(), detail::packed_normal(normal));
  return shape;
}

Result<DrawnShape> shape_of_box(const Box3& box) {
  A3D_ASSIGN(DrawnShape shape, detail::shape_in(box));
  // Corner 4i + 2j + k is at the end of the axes whose digit is 1. A flat box has fewer corners.
  std::array<std::uint32_t, 8> numbers{};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Vec3 point;
    std::size_t same = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t digit = std::size_t{4} >> axis;
      const bool is_at_end = (corner & digit) != 0 && box.min[axis] < box.max[axis];
      point[axis] = is_at_end ? box.max[axis] : box.min[axis];
      same |= is_at_end ? digit : 0;
    }
    numbers[corner] = same == corner ? detail::add_position(shape, point) : numbers[same];
  }
  for (const std::size_t digit : {4U, 2U, 1U})
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const DrawnShape::Line line = {numbers[corner], numbers[corner | digit]};
      if ((corner & digit) == 0 && line[0] != line[1] && std::ranges::find(shape.lines, line) == shape.lines.end())
        shape.lines.push_back(line);
    }
  if (shape.lines.empty() && !shape.is_empty()) shape.points.push_back(0);
  return shape;
}

Result<DrawnShape> shape_of_rect(const Rect& rect) {
  A3D_ASSIGN(DrawnShape shape, shape_of_box(rect.box()));
  if (shape.positions.size() < 4) return shape;
  // The corners are numbered by x, then y.
  shape.normals.assign(4, kUp);
  shape.triangles = {{0, 2, 3}, {0, 3, 1}};
  shape.triangle_count = 2;
  return shape;
}

Result<DrawnShape> shape_of_region(const Region& region, const Monitor& monitor) {
  const Polygons& polygons = region.polygons();
  A3D_ASSIGN(DrawnShape shape, detail::shape_in(region.box()));
  A3D_ASSIGN(const std::vector<IndexTriangle> triangles, triangulate(polygons, monitor));
  add_flat_face(shape, polygons.corners.approx(), triangles);
  for (std::size_t cycle = 0; cycle < polygons.cycle_count(); ++cycle)
    detail::add_loop(shape, polygons.first_corner(cycle), polygons.cycle_ends[cycle]);
  return shape;
}

Vec3 position_of(const DrawnShape& shape, const DrawnShape::Position& position) {
  return shape.origin + Vec3{position[0], position[1], position[2]};
}

/// Appends lists of numbers of positions, raised by `offset`.
template <typename Lists>
void append_raised(const Lists& from, std::uint32_t offset, Lists& to) {
  for (auto list : from) {
    for (auto& number : list) number += offset;
    to.push_back(list);
  }
}

void append_shape(const DrawnShape& from, DrawnShape& to) {
  const auto offset = static_cast<std::uint32_t>(to.positions.size());
  for (const DrawnShape::Position& position : from.positions)
    to.positions.push_back(detail::position_in(to, position_of(from, position)));
  // Normals stand per position, also of those that no triangle has.
  if (!from.normals.empty() || !to.normals.empty()) {
    to.normals.resize(offset);
    to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
    to.normals.resize(to.positions.size());
  }
  append_raised(from.triangles, offset, to.triangles);
  append_raised(from.edges, offset, to.edges);
  append_raised(from.boundary, offset, to.boundary);
  append_raised(from.nonmanifold, offset, to.nonmanifold);
  append_raised(from.lines, offset, to.lines);
  for (const std::uint32_t point : from.points) to.points.push_back(point + offset);
  to.triangle_count += from.triangle_count;
}

/// One shape with everything that the shapes draw, around the middle of them all. Faces and vertices are numbered anew:
/// those of several values have no numbers in common. Errors: limit_exceeded for more positions than 32 bits count, or
/// a box beyond the range of floats. Cost: linear.
Result<DrawnShape> joined(std::span<const DrawnShape> shapes) {
  Box3 box;
  std::size_t position_count = 0;
  for (const DrawnShape& shape : shapes) {
    box.extend(shape.box);
    position_count += shape.positions.size();
  }
  if (position_count > std::numeric_limits<std::uint32_t>::max())
    return Error(ErrorCode::limit_exceeded, "a relation of {} vertices cannot be drawn as one shape", position_count);
  A3D_ASSIGN(DrawnShape all, detail::shape_in(box));
  all.positions.reserve(position_count);
  for (const DrawnShape& shape : shapes) append_shape(shape, all);
  return all;
}

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
      {&TypeOf<Point3d>::type(), of_small<Point3d, shape_of_point>},
      {&TypeOf<Points3d>::type(), of_small<Points3d, shape_of_points>},
      {&TypeOf<Vector3d>::type(), of_small<Vector3d, shape_of_vector>},
      {&TypeOf<Plane3d>::type(), of_small<Plane3d, shape_of_plane>},
      {&TypeOf<Box3>::type(), of_small<Box3, shape_of_box>},
      {&TypeOf<Surface3d>::type(), of_triangles<Surface3d>},
      {&TypeOf<Volume3d>::type(), of_triangles<Volume3d>},
      {&TypeOf<Mesh3d>::type(), of_triangles<Mesh3d>},
      {&TypeOf<Point2d>::type(), of_small<Point2d, shape_of_point_in_plane>},
      {&TypeOf<Rect>::type(), of_small<Rect, shape_of_rect>},
      {&TypeOf<Region>::type(),
       [](const Value& value, const Monitor& monitor) { return shape_of_region(value.get<Region>(), monitor); }},
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
  return joined(shapes);
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
