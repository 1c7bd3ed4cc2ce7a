#include "algebra3d/kernel/search/node_slabs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// Leaves of one task.
constexpr std::size_t kNodesPerTask = 1024;

/// Two sides of a thin wall have one normal.
void add_area(Vec3& sum, const Vec3& area) {
  sum = dot(sum, area) < 0 ? sum - area : sum + area;
}

std::array<float, 3> normal_along(const Vec3& area) {
  const double length = std::sqrt(dot(area, area));
  if (length == 0) return {};
  const Vec3 normal = (1 / length) * area;
  return {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)};
}

/// An interval of products, which is rounded outward.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  void extend(double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  }
  float rounded_low() const { return std::nextafter(static_cast<float>(low), -std::numeric_limits<float>::infinity()); }
  float rounded_high() const {
    return std::nextafter(static_cast<float>(high), std::numeric_limits<float>::infinity());
  }
};

/// The children of a node.
struct Children {
  BoxHierarchy::Node first;
  std::uint32_t end;

  Children(const BoxHierarchy& hierarchy, BoxHierarchy::Node node)
      : first{node.level - 1, 2 * node.index}, end(std::min(first.index + 2, hierarchy.node_count(first.level))) {}

  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (std::uint32_t child = first.index; child < end; ++child) visit(BoxHierarchy::Node{first.level, child});
  }
};

}  // namespace

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
    for (const std::uint32_t face : hierarchy.leaf_faces(leaf)) {
      for (const std::uint32_t corner : mesh.triangle(FaceId(face)))
        corners[count++] = hierarchy.frame().place_of(points[corner]) - middle;
      const Vec3& last = corners[count - 1];
      add_area(areas[leaf], cross(corners[count - 3] - last, corners[count - 2] - last));
    }
    Slab& slab = levels_[0][leaf];
    slab.normal = normal_along(areas[leaf]);
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
    children.for_each([&](BoxHierarchy::Node child) { add_area(areas[index], below[child.index]); });
    Slab& slab = levels_[level][index];
    slab.normal = normal_along(areas[index]);
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
