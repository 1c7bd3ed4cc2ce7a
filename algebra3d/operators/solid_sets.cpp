#include "algebra3d/operators/solid_sets.h"

#include <vector>

#include "algebra3d/arrangement/arrangement.h"
#include "algebra3d/arrangement/reduction.h"
#include "algebra3d/operators/half_space.h"

namespace algebra3d {
namespace {

Operand operand_of(const Volume3d& solid, std::uint32_t group) {
  return {&solid.mesh(), group, &solid.geometry().hierarchy()};
}

/// One set operation on two solids, that of the second group last.
Result<Volume3d> combined(Context& context, const Volume3d& a, const Volume3d& b, const KeepRule& rule) {
  ASSIGN_OR_RETURN(TriangleMesh mesh,
                   combine_solids(std::array<Operand, 2>{operand_of(a, 0), operand_of(b, 1)}, rule, context.monitor()));
  return Volume3d::trusted(std::move(mesh));
}

std::vector<Operand> operands_of(std::span<const Volume3d> solids) {
  std::vector<Operand> operands;
  for (const Volume3d& solid : solids) operands.push_back(operand_of(solid, 0));
  return operands;
}

}  // namespace

Result<Volume3d> united(Context& context, std::span<const Volume3d> solids) {
  ASSIGN_OR_RETURN(TriangleMesh mesh, unite_solids(operands_of(solids), context.monitor()));
  return Volume3d::trusted(std::move(mesh));
}

Result<Volume3d> intersected(Context& context, std::span<const Volume3d> solids) {
  Box3 common = solids.front().box();
  for (const Volume3d& solid : solids) common = intersect(common, solid.box());
  if (common.is_empty()) return Volume3d();
  ASSIGN_OR_RETURN(TriangleMesh mesh, intersect_solids(operands_of(solids), context.monitor()));
  return Volume3d::trusted(std::move(mesh));
}

Result<Volume3d> without(Context& context, const Volume3d& solid, const Volume3d& other) {
  if (!solid.box().intersects(other.box())) return solid;
  return combined(context, solid, other, [](const Holding& holding) { return holding[0] > 0 && holding[1] == 0; });
}

Result<Volume3d> in_either(Context& context, const Volume3d& solid, const Volume3d& other) {
  return combined(context, solid, other, [](const Holding& holding) { return holding[0] != holding[1]; });
}

Result<Surface3d> combined(Context& context, const Surface3d& a, const Surface3d& b, SurfaceRule rule) {
  ASSIGN_OR_RETURN(TriangleMesh mesh,
                   combine_surfaces({&a.mesh(), 0, &a.geometry().hierarchy()},
                                    {&b.mesh(), 0, &b.geometry().hierarchy()}, rule, context.monitor()));
  return Surface3d::trusted(std::move(mesh));
}

Result<Maybe<std::pair<Volume3d, Volume3d>>> split(Context& context, const Volume3d& solid, const ExactPlane& plane) {
  using Parts = std::pair<Volume3d, Volume3d>;
  const int side = solid.box().is_empty() ? 1 : side_of(solid.box(), plane);
  if (side > 0) return Maybe<Parts>(Parts{solid, Volume3d()});
  if (side < 0) return Maybe<Parts>(Parts{Volume3d(), solid});
  const auto behind = half_space_within(solid.box(), plane);
  if (!behind) return Maybe<Parts>(Undefined{behind.reason()});
  const std::array<Operand, 2> operands{{operand_of(solid, 0), {&*behind, 1}}};
  ASSIGN_OR_RETURN(const SolidArrangement arrangement, SolidArrangement::make(operands, context.monitor()));
  return Maybe<Parts>(
      Parts{Volume3d::trusted(arrangement.solid([](const Holding& h) { return h[0] > 0 && h[1] == 0; })),
            Volume3d::trusted(arrangement.solid([](const Holding& h) { return h[0] > 0 && h[1] > 0; }))});
}

Result<Maybe<Surface3d>> section(Context& context, const Volume3d& solid, const ExactPlane& plane) {
  if (solid.box().is_empty()) return Maybe<Surface3d>(Surface3d());
  // A solid that lies on the plane with a face has this as its section, so the box is made larger than the solid.
  Box3 room = solid.box();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double margin = 1 + (room.max[axis] - room.min[axis]);
    room.min[axis] -= margin;
    room.max[axis] += margin;
  }
  if (side_of(room, plane) != 0) return Maybe<Surface3d>(Surface3d());
  const auto behind = half_space_within(room, plane);
  if (!behind) return Maybe<Surface3d>(Undefined{behind.reason()});
  const std::array<Operand, 2> operands{{operand_of(solid, 0), {&*behind, 1}}};
  ASSIGN_OR_RETURN(const SolidArrangement arrangement, SolidArrangement::make(operands, context.monitor()));
  return Maybe<Surface3d>(Surface3d::trusted(arrangement.faces(
      [](const Holding& front, const Holding& back) { return front[0] > 0 || back[0] > 0 ? back[1] - front[1] : 0; })));
}

Result<Volume3d> clipped(Context& context, const Volume3d& solid, const Box3& box) {
  if (box.contains(solid.box())) return solid;
  if (!box.intersects(solid.box())) return Volume3d();
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (box.min[axis] == box.max[axis]) return Volume3d();
  return combined(context, solid, Volume3d::trusted(solid_of(box)),
                  [](const Holding& holding) { return holding[0] > 0 && holding[1] > 0; });
}

}  // namespace algebra3d
