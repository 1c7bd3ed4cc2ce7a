#pragma once

#include <functional>
#include <vector>

#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {

/// A split of a boundary edge at a vertex.
struct EdgeSplit {
  HalfedgeId edge;
  double parameter;  ///< where the vertex projects onto the edge: 0 at the start, 1 at the end
  VertexId vertex;

  friend auto operator<=>(const EdgeSplit&, const EdgeSplit&) = default;
};

/// A predicate: whether a vertex counts as lying on the edge from one point to another.
using LiesOnEdge = std::function<bool(const Vec3& from, const Vec3& vertex, const Vec3& to)>;

/// All splits of boundary edges at boundary vertices that lie on them. Tests the vertices no farther than `reach` (in
/// coordinate units) from the edge's box. Cost: n log n in the boundary edges.
std::vector<EdgeSplit> find_splits(const IndexedSoup& soup, double reach, const LiesOnEdge& lies_on);

/// Splits edges and their triangles. At most one edge of each triangle is split per call, since the parts have other
/// edges; returns false if splits were skipped for that reason: call again with new splits. Reports the distances of
/// the vertices from their edges.
bool split_edges(IndexedSoup& soup, std::vector<EdgeSplit> splits, RepairReport& report);

/// True if the point lies within the segment between two others. Exact.
bool is_exactly_on(const Vec3& from, const Vec3& p, const Vec3& to);

}  // namespace algebra3d
