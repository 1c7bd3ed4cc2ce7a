#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d {

/// Decides whether nodes of two hierarchies are apart although their boxes meet, or are near each other: each face of
/// one of them is compared with the box around the other. Boxes along the axes say little of long triangles that lie
/// aslant; a small set within such a box would be compared with the triangle face by face. For one search by one
/// thread; refers to its operands.
///
/// Its work is bounded by that of the search: each pair of faces that is visited pays for some comparisons, except the
/// first few of each pair of leaves. So a search that boxes guide well does not pay for it.
class NodeGaps {
 public:
  /// Nodes up to this level are compared: of up to 256 faces.
  static constexpr std::uint32_t kMaxLevel = 5;

  /// The hierarchies are those over the meshes, or over some of their faces.
  NodeGaps(const TriangleMesh& first, const BoxHierarchy& of_first, const TriangleMesh& second,
           const BoxHierarchy& of_second);

  /// To be called for each pair of faces that is visited.
  void note_visit() { credit_ += kComparisonsForAVisit; }
  /// True if the faces of two nodes are certainly farther apart than `distance`, in coordinate units. Rounded
  /// arithmetic with bounds. To be called for each pair of leaves that is reached. Cost: some 50 nanoseconds per face
  /// at most.
  bool exceed(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance) {
    if (first.level == 0 && second.level == 0) note_leaves();
    return credit_ >= 0 && std::max(first.level, second.level) <= kMaxLevel && are_far(first, second, distance);
  }

 private:
  static constexpr std::int64_t kComparisonsForAVisit = 4, kLeastCredit = -4096;
  /// Visits that cost a pair of leaves nothing. A pair of leaves has 64 pairs of faces. About one is visited where
  /// boxes guide a search well, and about eight where two surfaces nearly coincide.
  static constexpr std::int64_t kUsualVisits = 8;

  struct Side {
    const TriangleMesh& mesh;
    const BoxHierarchy& hierarchy;
  };
  bool are_far(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance);
  /// Whether all faces of a node of `side` are farther than `distance` from a box.
  bool are_far(const Side& side, BoxHierarchy::Node node, const Box3& box, double distance);
  void note_leaves() { credit_ = std::max(credit_ - kUsualVisits * kComparisonsForAVisit, kLeastCredit); }

  Side first_, second_;
  double error_;
  std::int64_t credit_ = kLeastCredit;  // comparisons that visits have paid for; the first visits pay for none
};

/// A lower bound of the distance of a triangle and a box: of the gaps between their projections to thirteen axes, the
/// first one that exceeds `wanted`, or the largest; negative if all projections overlap. `error` is 2^-46 of the
/// largest coordinate or more. Source: [akenine2001], with lengths in place of signs.
double gap_between(std::span<const Vec3, 3> triangle, const Box3& box, double wanted, double error);

}  // namespace algebra3d
