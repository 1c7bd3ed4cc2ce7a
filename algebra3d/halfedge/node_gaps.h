#pragma once

#include <cstdint>
#include <span>

#include "algebra3d/base/box3.h"
#include "algebra3d/halfedge/box_hierarchy.h"
#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// Tells nodes of two hierarchies apart whose boxes meet, or are near each other: each face of one of them is compared
/// with the box around the other. Boxes along the axes say little of long triangles that lie aslant; a small set within
/// such a box would be compared with the triangle face by face. For one search by one thread; refers to its operands.
///
/// It answers only after a while, so that short searches do not pay for it, and seldom where it hardly ever helps.
class NodeGaps {
 public:
  /// Nodes up to this level are compared: of up to 64 faces.
  static constexpr std::uint32_t kMaxLevel = 3;

  /// The hierarchies are those over the meshes, or over some of their faces.
  NodeGaps(const TriangleMesh& first, const BoxHierarchy& of_first, const TriangleMesh& second,
           const BoxHierarchy& of_second);

  /// True if the faces of two nodes are certainly farther apart than `distance`, in coordinate units. Rounded
  /// arithmetic with bounds. Cost: some 50 nanoseconds per face at most.
  bool exceed(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance);

 private:
  struct Side {
    const TriangleMesh& mesh;
    const BoxHierarchy& hierarchy;
  };
  /// Whether all faces of a node of `side` are farther than `distance` from a box.
  bool are_far(const Side& side, BoxHierarchy::Node node, const Box3& box, double distance) const;
  bool is_asked();

  Side first_, second_;
  double error_;
  std::uint64_t questions_ = 0, answers_ = 0, successes_ = 0;
};

/// A lower bound of the distance of a triangle and a box: of the gaps between their projections to thirteen axes, the
/// first one that exceeds `wanted`, or the largest; negative if all projections overlap. `error` is 2^-46 of the
/// largest coordinate or more. Source: [akenine2001], with lengths in place of signs.
double gap_between(std::span<const Vec3, 3> triangle, const Box3& box, double wanted, double error);

}  // namespace algebra3d
