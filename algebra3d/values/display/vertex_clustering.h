#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"
#include "base/indices.h"

namespace algebra3d {

/// Sums over the original triangles and vertices that fell together in a vertex.
struct ClusterSums {
  /// Squared distance from the planes of the triangles, weighted by their areas: x.Ax - 2 b.x + const. A by
  /// rows, upper half.
  std::array<double, 6> a{};
  Vec3 b;
  Vec3 positions;    ///< of the vertices
  double count = 0;  ///< of the vertices

  ClusterSums& operator+=(const ClusterSums& other);
};

/// Triangles to be made fewer. Positions are relative to an origin that is the same for all levels.
struct TrianglesView {
  std::span<const Vec3> points;
  std::span<const IndexTriangle> triangles;
  std::span<const ClusterSums> sums = {};  ///< per point of a level; empty for original triangles
  std::span<const double> moved = {};      ///< per point of a level, likewise
};

/// A level of detail.
struct ClusteredTriangles {
  std::vector<Vec3> points;
  std::vector<IndexTriangle> triangles;  ///< in the order of those that they were made of, with their orientation
  std::vector<ClusterSums> sums;         ///< per point
  std::vector<double> moved;             ///< per point: no original vertex in it was moved farther
  std::vector<std::uint32_t> point_of;   ///< per point of the finer level: its point here; kNone if it had no triangle

  TrianglesView view() const { return {points, triangles, sums, moved}; }
  /// The largest of `moved`.
  double deviation() const;
};

/// The triangles with the vertices in each cell of a grid drawn together into one; those that collapse, and repetitions
/// with the same orientation, are dropped. The grid is the finest, up to some percent, that leaves at most
/// `max_triangles`. A vertex is placed where the sum of squared distances from the planes of its original triangles is
/// least, held near the mean of its vertices where these planes do not determine it, and within the cell. Rounded; for
/// the eye only: the result may cross itself and have edges with more than two triangles. Does not depend on the number
/// of threads. Errors: interrupted. Cost: linear; some hundred nanoseconds per triangle of the result, some dozens per
/// triangle before. Source: [rossignac1993] for the clusters, [lindstrom2000] for the sums and the places.
Result<ClusteredTriangles> clustered(const TrianglesView& fine, std::size_t max_triangles, const Monitor& monitor = {});

}  // namespace algebra3d
