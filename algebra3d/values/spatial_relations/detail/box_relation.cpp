#include "algebra3d/values/spatial_relations/detail/box_relation.h"

#include <algorithm>
#include <vector>

#include "algebra3d/values/spatial_relations/box_meshes.h"

namespace algebra3d {
namespace {

bool is_flat(const Box3& box, std::size_t axis) {
  return box.min[axis] == box.max[axis];
}

/// True if the insides of the intervals meet; a single point is its own inside.
bool do_insides_meet(const Box3& a, const Box3& b, std::size_t axis) {
  if (is_flat(a, axis) && is_flat(b, axis)) return a.min[axis] == b.min[axis];
  return std::max(a.min[axis], b.min[axis]) < std::min(a.max[axis], b.max[axis]) ||
         (is_flat(a, axis) && b.min[axis] < a.min[axis] && a.min[axis] < b.max[axis]) ||
         (is_flat(b, axis) && a.min[axis] < b.min[axis] && b.min[axis] < a.max[axis]);
}

/// The parts of the boundary of a box: two for each axis along which it has an extent.
std::vector<Box3> sides_of(const Box3& box) {
  std::vector<Box3> result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (is_flat(box, axis)) continue;
    for (const double bound : {box.min[axis], box.max[axis]}) {
      Box3& side = result.emplace_back(box);
      side.min[axis] = side.max[axis] = bound;
    }
  }
  return result;
}

}  // namespace

void relate_boxes(const Box3& first, const Box3& second, Findings& findings) {
  if (!second.contains(first)) findings.add_leaving(Role::first);
  if (!first.contains(second)) findings.add_leaving(Role::second);
  const Box3 common = intersect(first, second);
  if (common.is_empty()) return;
  const bool do_interiors_meet =
      do_insides_meet(first, second, 0) && do_insides_meet(first, second, 1) && do_insides_meet(first, second, 2);
  if (do_interiors_meet)
    findings.add_common_interior(dimension_of(common));
  else
    findings.add_common(dimension_of(common));
  if (findings.wants_witness()) findings.add_witness({ExactPoint(common.min), {}, {}});
  if (!findings.wants_boundaries()) return;
  for (const Box3& a : sides_of(first))
    for (const Box3& b : sides_of(second))
      if (a.intersects(b)) findings.add_common_boundary(dimension_of(intersect(a, b)));
}

}  // namespace algebra3d
