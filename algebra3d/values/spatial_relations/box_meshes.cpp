#include "algebra3d/values/spatial_relations/box_meshes.h"

#include <array>
#include <span>
#include <utility>

#include "base/box_corners.h"

namespace algebra3d {
namespace {

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
  for (std::size_t axis = 0; axis < 3; ++axis) dimension += box.min[axis] == box.max[axis] ? 0 : 1;
  return dimension;
}

Volume3d solid_of_box(const Box3& box) {
  constexpr std::array<unsigned, 8> kCorners{0, 1, 2, 3, 4, 5, 6, 7};
  return Volume3d::trusted(mesh_of_corners(box, kCorners, kBoxTriangles));
}

Surface3d surface_of_box(const Box3& box) {
  constexpr std::array<IndexTriangle, 2> kTriangles{{{0, 1, 3}, {0, 3, 2}}};
  // Bits of the corners along the two axes with an extent.
  const unsigned first = box.min.x == box.max.x ? 2U : 1U, second = box.min.z == box.max.z ? 2U : 4U;
  const std::array<unsigned, 4> corners{0, first, second, first | second};
  return Surface3d::trusted(mesh_of_corners(box, corners, kTriangles));
}

}  // namespace algebra3d
