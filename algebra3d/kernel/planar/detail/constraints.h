#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/kernel/planar/detail/plane_points.h"
#include "algebra3d/kernel/planar/detail/subdivision.h"

namespace algebra3d::planar {

/// Inserts constraints into a Delaunay triangulation, one by one: the result is the constrained Delaunay triangulation
/// of the marked edges. It depends only on the vertices and the marked edges, not on their order. Refers to the
/// triangulation and its points, which must outlive it. Source: [anglada1997] for retriangulating the region that a
/// constraint opens.
class ConstraintInserter {
 public:
  ConstraintInserter(const PlanePoints& points, Subdivision& triangulation)
      : points_(points), triangulation_(triangulation) {}

  /// Inserts the segment between two different vertices, divided at the vertices on it. False if a marked edge crosses
  /// it. Cost: that of finding the edge at its first end if it exists; else the number of edges that cross it, times
  /// the depth of their ends.
  bool insert(VertexId from, VertexId to);
  /// The half-edges along the inserted segment, in its direction. Valid until the next call.
  const std::vector<HalfedgeId>& along() const { return along_; }
  /// After a failure: a marked half-edge that crosses the segment.
  HalfedgeId crossing() const { return crossing_; }

 private:
  HalfedgeId find_edge(VertexId from, VertexId to) const;
  HalfedgeId find_wedge(VertexId from, VertexId to) const;
  bool cut(VertexId& from, VertexId to);
  void fill(HalfedgeId base);
  HalfedgeId find_apex(HalfedgeId base) const;
  bool is_seen(HalfedgeId arriving, VertexId vertex) const;

  const PlanePoints& points_;
  Subdivision& triangulation_;
  std::vector<HalfedgeId> along_, crossed_, open_;
  HalfedgeId crossing_;
};

}  // namespace algebra3d::planar
