#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "algebra3d/kernel/distance/distance.h"
#include "algebra3d/kernel/search/node_slabs.h"

namespace algebra3d::distances {

/// The slabs of a set's nodes, made if they are not there yet; null for sets so small that boxes do.
const NodeSlabs* slabs_if_large(const DistanceOperand& set);

/// How far the parts of a set reach along a direction. Found by branch and bound, from boxes and, in large sets, the
/// slabs of nodes; kept for the direction.
class Reach {
 public:
  explicit Reach(const DistanceOperand& set);

  /// The direction to use from now on, of length 1 but for rounding. All that was kept is dropped.
  void turn(const Vec3& direction);
  /// The largest product of a corner with the direction, but for roundings below 2^-48 of the largest coordinate.
  double of_face(std::uint32_t face) const;
  /// The largest product of the corners of all faces of a node if it is above `floor`, else `floor`.
  double of_node(BoxHierarchy::Node node, double floor);
  double of_all() { return of_node(set_.hierarchy->root(), -std::numeric_limits<double>::infinity()); }
  /// An upper bound, without a search.
  double at_most(BoxHierarchy::Node node);
  /// An upper bound along any direction of length 1 but for rounding, without a search.
  double at_most_along(const Vec3& direction, BoxHierarchy::Node node);
  /// About the middle of the faces of a node.
  Vec3 middle(BoxHierarchy::Node node) const;
  /// Number of nodes that have been looked at.
  std::int64_t work() const { return work_; }

 private:
  struct Known {
    BoxHierarchy::Node node{};
    std::uint32_t turn = 0;  // they count from 1
    bool is_exact = false;   // else the reach is an upper bound
    double reach = 0;
  };

  double bound(BoxHierarchy::Node node);
  double bound(const Vec3& direction, double origin, BoxHierarchy::Node node) const;
  double farthest(BoxHierarchy::Node node, double floor);
  double farthest_of_leaf(BoxHierarchy::Node leaf, double floor) const;
  Known& known(BoxHierarchy::Node node);
  bool is_known(const Known& kept, BoxHierarchy::Node node) const { return kept.turn == turn_ && kept.node == node; }

  DistanceOperand set_;
  const NodeSlabs* slabs_;  // null for small sets
  Vec3 direction_;
  double unit_, origin_ = 0;  // of the frame: the length in coordinates, and how far its origin reaches
  std::uint32_t turn_ = 0;
  std::int64_t work_ = 0;
  std::vector<Known> known_;  // each node has one place, where it displaces others
};

/// Keeps parts of two sets apart along a direction: between the farthest points of the first one's part and the nearest
/// points of the second one's. Boxes along the axes separate slanted surfaces badly; the direction from one set to the
/// other separates nearly all parts if the sets are near each other in one place only. Parallel parts are separated by
/// their distance along the direction and by their offset across it. Where few parts are separated, no more time is
/// spent on it.
class Separation {
 public:
  Separation(const DistanceOperand& a, const DistanceOperand& b);

  /// The direction to use from now on, of length 1 but for rounding; 0 for none.
  void turn(const Vec3& direction);
  /// True if two faces, or all faces of two nodes, are certainly farther apart than `distance`, in coordinate units.
  bool keeps_apart(FaceId first, FaceId second, double distance) const;
  bool keeps_apart(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance);

 private:
  /// Nodes that may be looked at for each pair of nodes that is separated, and before the first one.
  static constexpr std::int64_t kWorkForAPair = 64, kFirstWork = 16384;

  double between(double first, double second) const;
  Vec3 across(const Vec3& way) const;
  static bool is_farther(double along, double across, double distance);
  bool are_beside(FaceId first, FaceId second, double along, double distance) const;
  bool are_beside(BoxHierarchy::Node first, BoxHierarchy::Node second, double along, double distance);
  bool are_apart(BoxHierarchy::Node first, BoxHierarchy::Node second, double distance);

  Reach first_, second_;  // the second one in the opposite direction
  const TriangleMesh &first_mesh_, &second_mesh_;
  Vec3 direction_;
  bool is_usable_, has_direction_ = false;
  double error_;
  std::int64_t credit_ = kFirstWork;
};

}  // namespace algebra3d::distances
