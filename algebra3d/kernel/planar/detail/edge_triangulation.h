#pragma once

#include <span>
#include <string>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/planar/detail/constraints.h"
#include "algebra3d/kernel/planar/detail/inside_triangles.h"
#include "algebra3d/kernel/planar/detail/plane_points.h"
#include "algebra3d/kernel/planar/detail/subdivision.h"
#include "base/id_vector.h"

namespace algebra3d::planar {

/// The constrained Delaunay triangulation of directed edges, with marks on the half-edges that have the inside to their
/// left (segment_mark in inside_triangles.h). Refers to the points and edges, which must outlive it.
class EdgeTriangulation {
 public:
  EdgeTriangulation(const PointArray& points, std::span<const DirectedEdge> edges)
      : edges_(edges), points_(points, ends_of(points, edges)), triangulation_(0) {}

  /// Builds the triangulation. Errors: invalid_value, if edges cross or one is given twice in the same direction;
  /// interrupted.
  Status build(const Monitor& monitor);
  /// Checks that no edge is given in both directions. Errors: invalid_value.
  Status check_one_direction() const;
  /// Finds the triangles inside. Errors: invalid_value, if the edges bound no region.
  Result<InsideTriangles> find_inside() const;

  const PlanePoints& points() const { return points_; }
  const Subdivision& triangulation() const { return triangulation_; }

 private:
  Status insert(SegmentId edge, ConstraintInserter& inserter);
  std::string text_of(SegmentId edge) const;

  IdSpan<SegmentId, const DirectedEdge> edges_;
  PlanePoints points_;
  Subdivision triangulation_;
};

}  // namespace algebra3d::planar
