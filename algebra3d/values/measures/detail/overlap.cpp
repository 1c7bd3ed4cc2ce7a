#include "algebra3d/values/measures/detail/overlap.h"

#include <array>
#include <utility>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/values/measures/detail/bodies.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Result<SolidArrangement> arrangement_of(const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  const std::array<Operand, 2> operands{
      {{&a.mesh(), 0, &a.geometry().hierarchy()}, {&b.mesh(), 1, &b.geometry().hierarchy()}}};
  return SolidArrangement::make(operands, monitor);
}

/// The part of the boundary of one group in the interior of the other.
Result<Surface3d> boundary_in_other(const SolidArrangement& arrangement, std::size_t group) {
  const auto is_inside_other = [group](const WindingVector& front, const WindingVector& back) {
    const bool is_boundary = (front[group] > 0) != (back[group] > 0);
    return is_boundary && front[1 - group] > 0 && back[1 - group] > 0 ? 1 : 0;
  };
  A3D_ASSIGN(TriangleMesh part, arrangement.faces(is_inside_other));
  return Surface3d::trusted(std::move(part));
}

/// True if a body of the solid, which is of one group, is divided by the other one.
Result<bool> is_divided(const Volume3d& solid, const SolidArrangement& arrangement, std::size_t group,
                        const Monitor& monitor) {
  const auto is_left = [group](const WindingVector& windings) {
    return windings[group] > 0 && windings[1 - group] == 0;
  };
  A3D_ASSIGN(const TriangleMesh rest, arrangement.solid(is_left));
  return has_divided_body(solid, rest, monitor);
}

}  // namespace

Result<Overlap> Overlap::of(const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  A3D_ASSIGN(const SolidArrangement arrangement, arrangement_of(a, b, monitor));
  Overlap overlap;
  A3D_ASSIGN(overlap.of_first_in_second, boundary_in_other(arrangement, 0));
  A3D_ASSIGN(overlap.of_second_in_first, boundary_in_other(arrangement, 1));
  A3D_ASSIGN(overlap.is_divided, algebra3d::is_divided(a, arrangement, 0, monitor));
  if (overlap.is_divided) return overlap;
  A3D_ASSIGN(overlap.is_divided, algebra3d::is_divided(b, arrangement, 1, monitor));
  return overlap;
}

}  // namespace algebra3d
