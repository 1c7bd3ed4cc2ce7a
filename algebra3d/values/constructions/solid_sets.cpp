#include "algebra3d/values/constructions/solid_sets.h"

#include <cmath>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/arrangement/divide_and_conquer.h"
#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/arrangement/winding_vector.h"
#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/halfedge/mesh_image.h"
#include "algebra3d/values/constructions/detail/half_space.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

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
