#include "algebra3d/spatial_relations/detail/box_relation.h"

#include <algorithm>
#include <vector>

#include "algebra3d/base/box_corners.h"

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

TriangleMesh mesh_of_corners(const Box3& box, std::span<const unsigned> corners,
                             std::span<const IndexTriangle> triangles) {
  PointArray points;
  points.reserve(corners.size());
  for (const unsigned corner : corners) points.push_back(PointRef(ExactPoint(corner_of(box, corner))));
  return {std::move(points), triangles};
}

}  // namespace

int dimension_of(const Box3& box) {
  int dimension = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) dimension += is_flat(box, axis) ? 0 : 1;
  return dimension;
}

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

Volume3d solid_of_box(const Box3& box) {
  constexpr std::array<unsigned, 8> kCorners{0, 1, 2, 3, 4, 5, 6, 7};
  return Volume3d::trusted(mesh_of_corners(box, kCorners, kBoxTriangles));
}

Surface3d surface_of_box(const Box3& box) {
  constexpr std::array<IndexTriangle, 2> kTriangles{{{0, 1, 3}, {0, 3, 2}}};
  // Bits of the corners along the two axes with an extent.
  const unsigned first = is_flat(box, 0) ? 2U : 1U, second = is_flat(box, 2) ? 2U : 4U;
  const std::array<unsigned, 4> corners{0, first, second, first | second};
  return Surface3d::trusted(mesh_of_corners(box, corners, kTriangles));
}

}  // namespace algebra3d
