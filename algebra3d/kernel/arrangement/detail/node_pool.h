#pragma once

#include <cstddef>

#include "algebra3d/kernel/arrangement/detail/ids.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/point_table.h"

namespace algebra3d::arrangement {

/// The nodes of an arrangement: distinct points, numbered from 0 in order of first use, so that ids depend on nothing
/// but the order of the calls.
class NodePool {
 public:
  NodePool() = default;
  /// With capacity for `expected_count` nodes.
  explicit NodePool(std::size_t expected_count) : points_(expected_count) {}

  /// The node at the point, which is added if it is new. Cost: constant expected.
  NodeId intern(const PointRef& point) { return NodeId(points_.intern(point)); }

  /// Frees what finding points takes: no more are added.
  void finish() { points_.finish(); }

  PointRef operator[](NodeId node) const { return points_[node.index()]; }
  std::size_t size() const { return points_.size(); }
  IdRange<NodeId> ids() const { return IdRange<NodeId>(size()); }
  /// The points by the indices of their nodes.
  const PointTable& points() const { return points_; }

  /// The exact point half-way between two nodes.
  ExactPoint middle(NodeId a, NodeId b) const {
    return ExactPoint(Rational(1, 2) * ((*this)[a].rational() + (*this)[b].rational()));
  }

 private:
  PointTable points_;
};

}  // namespace algebra3d::arrangement
