#include "algebra3d/kernel/search/node_slabs.h"

#include <algorithm>

#include "algebra3d/kernel/search/detail/node_extents.h"
#include "base/scheduler.h"

namespace algebra3d {

using node_extents::add_unsigned;
using node_extents::Children;
using node_extents::direction_along;
using node_extents::Extent;
using node_extents::kNodesPerTask;

NodeSlabs::NodeSlabs(const TriangleMesh& mesh, const BoxHierarchy& hierarchy) : levels_(hierarchy.level_count()) {
  if (levels_.empty()) return;
  Areas areas = make_leaves(mesh, hierarchy);
  for (std::uint32_t level = 1; level < hierarchy.level_count(); ++level) areas = make_level(hierarchy, level, areas);
}

NodeSlabs::Areas NodeSlabs::make_leaves(const TriangleMesh& mesh, const BoxHierarchy& hierarchy) {
  const std::vector<Vec3>& points = mesh.points().approx();
  Areas areas(hierarchy.leaf_count());
  levels_[0].resize(areas.size());
  parallel_for(areas.size(), kNodesPerTask, [&](std::size_t leaf) {
    const Vec3 middle = hierarchy.place({0, static_cast<std::uint32_t>(leaf)}).middle;
    std::array<Vec3, 3 * BoxHierarchy::kLeafSize> corners;
    std::size_t count = 0;
    for (const auto face : hierarchy.leaf_faces(leaf)) {
      for (const auto corner : mesh.triangle(FaceId(face)))
        corners[count++] = hierarchy.frame().place_of(points[corner]) - middle;
      const Vec3& last = corners[count - 1];
      add_unsigned(areas[leaf], cross(corners[count - 3] - last, corners[count - 2] - last));
    }
    Slab& slab = levels_[0][leaf];
    slab.normal = direction_along(areas[leaf]);
    Extent extent;
    for (std::size_t i = 0; i < count; ++i) {
      const double product = dot(vector_of(slab.normal), corners[i]);
      extent.extend(product, product);
    }
    slab.low = extent.rounded_low();
    slab.high = extent.rounded_high();
  });
  return areas;
}

NodeSlabs::Areas NodeSlabs::make_level(const BoxHierarchy& hierarchy, std::uint32_t level, const Areas& below) {
  Areas areas(hierarchy.node_count(level));
  levels_[level].resize(areas.size());
  parallel_for(areas.size(), kNodesPerTask, [&](std::size_t index) {
    const BoxHierarchy::Node node{level, static_cast<std::uint32_t>(index)};
    const Children children(hierarchy, node);
    children.for_each([&](BoxHierarchy::Node child) { add_unsigned(areas[index], below[child.index]); });
    Slab& slab = levels_[level][index];
    slab.normal = direction_along(areas[index]);
    const Vec3 normal = vector_of(slab.normal), middle = hierarchy.place(node).middle;
    Extent extent;
    children.for_each([&](BoxHierarchy::Node child) {
      const BoxHierarchy::Place place = hierarchy.place(child);
      const double offset = dot(normal, place.middle - middle);
      extent.extend(offset - reach(child, place, -1 * normal), offset + reach(child, place, normal));
    });
    slab.low = extent.rounded_low();
    slab.high = extent.rounded_high();
  });
  return areas;
}

}  // namespace algebra3d
