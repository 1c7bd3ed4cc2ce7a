#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

/// A slab around the faces of each node of a hierarchy: two parallel planes across about their mean normal. A box along
/// the axes around a patch of a smooth surface that lies aslant is about as thick as the patch is wide, s; its slab is
/// some s^2 thick. So, judged by box and slab, few nodes extend beyond the farthest face along a direction, while the
/// boxes of some sqrt(n) of n nodes do.
///
/// Immutable, refers to nothing. Memory: 5 bytes per face. Source: oriented boxes as in [larsen2000], of which only the
/// shortest side is kept, and that turned for each node.
class NodeSlabs {
 public:
  /// The slabs of a hierarchy over faces of `mesh`. Cost: linear, some 30 nanoseconds per face.
  NodeSlabs(const TriangleMesh& mesh, const BoxHierarchy& hierarchy);

  /// How far a node's faces reach along a direction from the middle of its box, whose place is given, in the frame of
  /// the hierarchy: an upper bound of the product with the direction, but for roundings below 2^-48 of the largest
  /// coordinate. Cost: some nanoseconds.
  double reach(BoxHierarchy::Node node, const BoxHierarchy::Place& place, const Vec3& direction) const;

  /// The direction across a node's slab, of length 1 but for rounding to float; 0 if it has none.
  Vec3 normal(BoxHierarchy::Node node) const { return vector_of(levels_[node.level][node.index].normal); }

 private:
  /// The products of a node's points, from the middle of its box, with the normal are from `low` to `high`. The normal
  /// has length 1 but for rounding to float, or 0: no slab.
  struct Slab {
    std::array<float, 3> normal{};
    float low = 0, high = 0;
  };

  static Vec3 vector_of(const std::array<float, 3>& normal) { return {normal[0], normal[1], normal[2]}; }

  /// Normals times twice the areas of the faces below each node, added up without regard to their signs.
  using Areas = std::vector<Vec3>;
  Areas make_leaves(const TriangleMesh& mesh, const BoxHierarchy& hierarchy);
  Areas make_level(const BoxHierarchy& hierarchy, std::uint32_t level, const Areas& below);

  std::vector<std::vector<Slab>> levels_;  // parallel to the nodes
};

// The direction is a multiple of the normal and a rest, along which the box has to do.
inline double NodeSlabs::reach(BoxHierarchy::Node node, const BoxHierarchy::Place& place, const Vec3& direction) const {
  const Slab& slab = levels_[node.level][node.index];
  const Vec3 normal = vector_of(slab.normal);
  const double along = dot(normal, direction);
  const double of_slab = along * (along > 0 ? slab.high : slab.low) + place.reach(direction - along * normal);
  return std::min(of_slab, place.reach(direction));
}

}  // namespace algebra3d
