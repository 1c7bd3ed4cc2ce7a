#pragma once

#include <span>
#include <string>

#include "algebra3d/base/monitor.h"
#include "algebra3d/planar/constraints.h"
#include "algebra3d/planar/inside_triangles.h"
#include "algebra3d/planar/plane_points.h"
#include "algebra3d/planar/subdivision.h"

namespace algebra3d::planar {

/// The constrained Delaunay triangulation of the ends of some directed edges, with marks that say which half-edges have
/// the inside to their left (regions.h). Refers to the points and edges, which must outlive it.
class EdgeTriangulation {
 public:
  EdgeTriangulation(const PointArray& points, std::span<const DirectedEdge> edges)
      : edges_(edges), points_(points, ends_of(points, edges)), triangulation_(0) {}

  /// Errors: invalid_value, if edges cross or one is given twice in one direction; interrupted.
  Status build(const Monitor& monitor);
  /// Errors: invalid_value, if an edge is given in both directions.
  Status check_one_direction() const;
  /// Errors: invalid_value, if the edges bound no region.
  Result<InsideTriangles> find_inside() const;

  const PlanePoints& points() const { return points_; }
  const Subdivision& triangulation() const { return triangulation_; }

 private:
  Status insert(std::uint32_t edge, ConstraintInserter& inserter);
  std::string text_of(std::uint32_t edge) const;

  std::span<const DirectedEdge> edges_;
  PlanePoints points_;
  Subdivision triangulation_;
};

}  // namespace algebra3d::planar
