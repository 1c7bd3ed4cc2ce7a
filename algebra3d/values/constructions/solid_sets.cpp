#include "algebra3d/values/constructions/solid_sets.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/arrangement/divide_and_conquer.h"
#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/arrangement/winding_vector.h"
#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/halfedge/mesh_image.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/box_corners.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The largest magnitude of coordinates for which a box can be enlarged within the range of doubles.
constexpr double kMaxBoxCoordinate = 0x1p1000;

std::size_t dominant_axis(const RationalVec3& normal) {
  std::size_t axis = normal.y.abs() > normal.x.abs() ? 1 : 0;
  if (normal.z.abs() > normal[axis].abs()) axis = 2;
  return axis;
}

/// A power of two above the magnitude of all coordinates.
double bound_of(const Box3& box) {
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    size = std::max({size, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return std::max(std::exp2(std::ilogb(size) + 1), 0x1p-1000);
}

RationalVec3 with_axes(std::size_t axis, const Rational& along, const Rational& next, const Rational& after) {
  std::array<Rational, 3> coordinates;
  coordinates[axis] = along;
  coordinates[(axis + 1) % 3] = next;
  coordinates[(axis + 2) % 3] = after;
  return {coordinates[0], coordinates[1], coordinates[2]};
}

/// The side of the plane on which a box lies: 1 in front (or touching), -1 behind, 0 both. Exact.
int side_of(const Box3& box, const ExactPlane& plane) {
  bool is_in_front = false, is_behind = false;
  for (unsigned i = 0; i < 8; ++i) {
    const int sign = plane.evaluate(RationalVec3(corner_of(box, i))).sign();
    is_in_front = is_in_front || sign > 0;
    is_behind = is_behind || sign < 0;
  }
  return is_in_front && is_behind ? 0 : is_behind ? -1 : 1;
}

/// A prism that contains the part of the box behind the plane and nothing in front of it. One face lies exactly in the
/// plane, with the same front. Domain: the plane cuts the box (side_of is 0); coordinates of the box are at most eight
/// times kMaxBoxCoordinate.
TriangleMesh half_space_within(const Box3& box, const ExactPlane& plane) {
  const std::size_t axis = dominant_axis(plane.normal), next = (axis + 1) % 3, after = (axis + 2) % 3;
  const double size = bound_of(box);
  // The plane passes the box and rises by at most 1 along the other axes, so over the square of twice the bound it
  // stays within five times the bound.
  const double floor = 8 * size;
  const bool is_behind_below = plane.normal[axis].sign() > 0;
  PointArray points;
  for (unsigned i = 0; i < 8; ++i) {
    // The prism has the corners of a box; those with bit 0 are in the plane.
    const Rational u((i & 2U) != 0 ? size : -size), v((i & 4U) != 0 ? size : -size);
    const Rational in_plane = (plane.offset - plane.normal[next] * u - plane.normal[after] * v) / plane.normal[axis];
    const Rational beyond(is_behind_below ? -floor : floor);
    points.push_back(ExactPoint(with_axes(axis, (i & 1U) != 0 ? in_plane : beyond, u, v)));
  }
  std::vector<TriangleMesh::Triangle> triangles(kBoxTriangles.begin(), kBoxTriangles.end());
  if (!is_behind_below)
    for (auto& [a, b, c] : triangles) std::swap(b, c);
  return {std::move(points), triangles};
}

/// The box as a solid. Domain: a box with positive volume.
TriangleMesh solid_of(const Box3& box) {
  std::vector<Vec3> points;
  for (unsigned i = 0; i < 8; ++i) points.push_back(corner_of(box, i));
  return {PointArray(std::move(points)), kBoxTriangles};
}

Operand operand_of(const Volume3d& solid, std::uint32_t group) {
  return {&solid.mesh(), group, &solid.geometry().hierarchy()};
}

/// One set operation on two solids, that of the second group last.
Result<Volume3d> combined(Context& context, const Volume3d& a, const Volume3d& b, const KeepRule& rule) {
  A3D_ASSIGN(TriangleMesh mesh,
             combine_solids(std::array<Operand, 2>{operand_of(a, 0), operand_of(b, 1)}, rule, context.monitor()));
  return Volume3d::trusted(std::move(mesh));
}

std::vector<Operand> operands_of(std::span<const Volume3d> solids) {
  std::vector<Operand> operands;
  for (const Volume3d& solid : solids) operands.push_back(operand_of(solid, 0));
  return operands;
}

// A solid that reaches near to the ends of the range of doubles has no room round it there for the cutting solid. Its
// image under this map has; the result is mapped back. Both maps are exact for all coordinates.
constexpr double kReduction = 0x1p-24;

AffineMap scaling(double factor) {
  const Rational f(factor);
  return AffineMap::scaling(RationalVec3(), RationalVec3(f, f, f));
}

bool has_room(const Volume3d& solid) {
  const auto is_within = [](const Vec3& corner) {
    return std::abs(corner.x) <= kMaxBoxCoordinate && std::abs(corner.y) <= kMaxBoxCoordinate &&
           std::abs(corner.z) <= kMaxBoxCoordinate;
  };
  return is_within(solid.box().min) && is_within(solid.box().max);
}

/// The exact image, of which it is known that it stays within the range of doubles.
template <typename T>
Result<T> image_in_range(Context& context, const AffineMap& map, const T& geometry) {
  A3D_ASSIGN(auto image, exact_image(map, geometry.mesh(), context.cancel));
  if (!image) return Error{ErrorCode::internal, "cutting a solid: {}", image.reason()};
  return T::trusted(*std::move(image));
}

Result<SolidParts> split_reduced(Context& context, const Volume3d& solid, const ExactPlane& plane) {
  const AffineMap reduction = scaling(kReduction), back = scaling(1 / kReduction);
  A3D_ASSIGN(const Volume3d reduced, image_in_range(context, reduction, solid));
  A3D_ASSIGN(const SolidParts parts, split(context, reduced, reduction.apply(plane)));
  A3D_ASSIGN(Volume3d in_front, image_in_range(context, back, parts.in_front));
  A3D_ASSIGN(Volume3d behind, image_in_range(context, back, parts.behind));
  return SolidParts{std::move(in_front), std::move(behind)};
}

Result<Surface3d> section_reduced(Context& context, const Volume3d& solid, const ExactPlane& plane) {
  const AffineMap reduction = scaling(kReduction);
  A3D_ASSIGN(const Volume3d reduced, image_in_range(context, reduction, solid));
  A3D_ASSIGN(const Surface3d found, section(context, reduced, reduction.apply(plane)));
  return image_in_range(context, scaling(1 / kReduction), found);
}

}  // namespace

Result<Volume3d> united(Context& context, std::span<const Volume3d> solids) {
  A3D_ASSIGN(TriangleMesh mesh, unite_solids(operands_of(solids), context.monitor()));
  return Volume3d::trusted(std::move(mesh));
}

Result<Volume3d> intersected(Context& context, std::span<const Volume3d> solids) {
  Box3 common = solids.front().box();
  for (const Volume3d& solid : solids) common = intersect(common, solid.box());
  if (common.is_empty()) return Volume3d();
  A3D_ASSIGN(TriangleMesh mesh, intersect_solids(operands_of(solids), context.monitor()));
  return Volume3d::trusted(std::move(mesh));
}

Result<Volume3d> without(Context& context, const Volume3d& solid, const Volume3d& other) {
  if (!solid.box().intersects(other.box())) return solid;
  return combined(context, solid, other,
                  [](const WindingVector& windings) { return windings[0] > 0 && windings[1] == 0; });
}

Result<Volume3d> in_either(Context& context, const Volume3d& solid, const Volume3d& other) {
  return combined(context, solid, other, [](const WindingVector& windings) { return windings[0] != windings[1]; });
}

Result<Surface3d> combined(Context& context, const Surface3d& a, const Surface3d& b, SurfaceRule rule) {
  A3D_ASSIGN(TriangleMesh mesh, combine_surfaces({&a.mesh(), 0, &a.geometry().hierarchy()},
                                                 {&b.mesh(), 0, &b.geometry().hierarchy()}, rule, context.monitor()));
  return Surface3d::trusted(std::move(mesh));
}

Result<SolidParts> split(Context& context, const Volume3d& solid, const ExactPlane& plane) {
  const int side = solid.box().is_empty() ? 1 : side_of(solid.box(), plane);
  if (side > 0) return SolidParts{solid, Volume3d()};
  if (side < 0) return SolidParts{Volume3d(), solid};
  if (!has_room(solid)) return split_reduced(context, solid, plane);
  const TriangleMesh behind = half_space_within(solid.box(), plane);
  const std::array<Operand, 2> operands{{operand_of(solid, 0), {&behind, 1}}};
  A3D_ASSIGN(const SolidArrangement arrangement, SolidArrangement::make(operands, context.monitor()));
  A3D_ASSIGN(TriangleMesh front, arrangement.solid([](const WindingVector& h) { return h[0] > 0 && h[1] == 0; }));
  A3D_ASSIGN(TriangleMesh back, arrangement.solid([](const WindingVector& h) { return h[0] > 0 && h[1] > 0; }));
  return SolidParts{Volume3d::trusted(std::move(front)), Volume3d::trusted(std::move(back))};
}

Result<Surface3d> section(Context& context, const Volume3d& solid, const ExactPlane& plane) {
  if (solid.box().is_empty()) return Surface3d();
  if (!has_room(solid)) return section_reduced(context, solid, plane);
  // A solid that lies on the plane with a face has this as its section, so the box is made larger than the solid.
  Box3 room = solid.box();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double margin = 1 + (room.max[axis] - room.min[axis]);
    room.min[axis] -= margin;
    room.max[axis] += margin;
  }
  if (side_of(room, plane) != 0) return Surface3d();
  const TriangleMesh behind = half_space_within(room, plane);
  const std::array<Operand, 2> operands{{operand_of(solid, 0), {&behind, 1}}};
  A3D_ASSIGN(const SolidArrangement arrangement, SolidArrangement::make(operands, context.monitor()));
  A3D_ASSIGN(TriangleMesh mesh, arrangement.faces([](const WindingVector& front, const WindingVector& back) {
    return front[0] > 0 || back[0] > 0 ? back[1] - front[1] : 0;
  }));
  return Surface3d::trusted(std::move(mesh));
}

Result<Volume3d> clipped(Context& context, const Volume3d& solid, const Box3& box) {
  if (box.contains(solid.box())) return solid;
  if (!box.intersects(solid.box())) return Volume3d();
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (box.min[axis] == box.max[axis]) return Volume3d();
  return combined(context, solid, Volume3d::trusted(solid_of(box)),
                  [](const WindingVector& windings) { return windings[0] > 0 && windings[1] > 0; });
}

}  // namespace algebra3d
