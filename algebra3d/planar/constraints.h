#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/planar/plane_points.h"
#include "algebra3d/planar/subdivision.h"

namespace algebra3d::planar {

/// Makes straight lines edges of a Delaunay triangulation, one after the other, and keeps it Delaunay but for what the
/// marked edges hide: a half-edge with a mark stays. What comes out depends on the vertices and the marked edges alone,
/// not on their order. Refers to the triangulation and its points, which must outlive it.
/// Source: [anglada1997] for filling what a line opens.
class ConstraintInserter {
 public:
  ConstraintInserter(const PlanePoints& points, Subdivision& triangulation)
      : points_(points), triangulation_(triangulation) {}

  /// Makes the line between different vertices an edge, or several that end in the vertices through which it passes.
  /// False if a marked edge crosses it. Cost: that of finding an edge at its first end if it is there; else
  /// that of the edges that cross it, times how deep their ends lie.
  bool insert(std::uint32_t from, std::uint32_t to);
  /// The half-edges along the line, in its direction. Valid until the next call.
  const std::vector<std::uint32_t>& along() const { return along_; }
  /// After a failure: a half-edge with a mark that crosses the line.
  std::uint32_t crossing() const { return crossing_; }

 private:
  std::uint32_t find_edge(std::uint32_t from, std::uint32_t to) const;
  std::uint32_t find_wedge(std::uint32_t from, std::uint32_t to) const;
  bool cut(std::uint32_t& from, std::uint32_t to);
  void fill(std::uint32_t base);
  std::uint32_t find_apex(std::uint32_t base) const;
  bool is_seen(std::uint32_t arriving, std::uint32_t vertex) const;

  const PlanePoints& points_;
  Subdivision& triangulation_;
  std::vector<std::uint32_t> along_, crossed_, open_;
  std::uint32_t crossing_ = kNone;
};

}  // namespace algebra3d::planar
