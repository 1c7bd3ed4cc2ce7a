#include "algebra3d/kernel/repair/detail/split_selection.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/repair/detail/boundary_edges.h"
#include "base/equal_span.h"

namespace algebra3d {
namespace {

/// A straight part of a boundary edge, from one vertex to another.
using EdgePart = std::pair<VertexId, VertexId>;

/// A boundary edge with the vertices that it is to be led through, in order.
struct SplitEdge {
  BoundaryEdge edge;
  std::vector<VertexId> inner;

  template <typename Visit>
  void for_each_part(Visit visit) const {
    VertexId from = edge.from;
    for (const VertexId vertex : inner) visit(EdgePart(std::exchange(from, vertex), vertex));
    visit(EdgePart(from, edge.to));
  }
};

std::vector<SplitEdge> split_boundary(const IndexedSoup& soup, const std::vector<EdgeSplit>& sorted) {
  std::vector<SplitEdge> result;
  for (const BoundaryEdge& edge : BoundaryEdges(soup).edges) {
    SplitEdge& split = result.emplace_back(SplitEdge{edge, {}});
    for (const EdgeSplit& at : equal_span(sorted, edge.halfedge, &EdgeSplit::edge)) split.inner.push_back(at.vertex);
  }
  return result;
}

std::vector<EdgePart> sorted_parts(const std::vector<SplitEdge>& edges) {
  std::vector<EdgePart> parts;
  for (const SplitEdge& edge : edges) edge.for_each_part([&](const EdgePart& part) { parts.push_back(part); });
  std::ranges::sort(parts);
  return parts;
}

/// True if each part of the edge is there once, and once the other way.
bool stitches(const SplitEdge& edge, const std::vector<EdgePart>& parts) {
  const auto is_there_once = [&](const EdgePart& part) { return equal_span(parts, part).size() == 1; };
  bool result = true;
  edge.for_each_part([&](const EdgePart& part) {
    result = result && is_there_once(part) && is_there_once({part.second, part.first});
  });
  return result;
}

/// Takes back the splits of edges that stitch nothing; false if there are none.
bool take_back_once(std::vector<SplitEdge>& edges) {
  const std::vector<EdgePart> parts = sorted_parts(edges);
  bool has_changed = false;
  for (SplitEdge& edge : edges) {
    if (edge.inner.empty() || stitches(edge, parts)) continue;
    edge.inner.clear();
    has_changed = true;
  }
  return has_changed;
}

}  // namespace

std::vector<EdgeSplit> splits_that_stitch(const IndexedSoup& soup, std::vector<EdgeSplit> splits) {
  std::ranges::sort(splits);
  std::vector<SplitEdge> edges = split_boundary(soup, splits);
  while (take_back_once(edges)) {
  }
  const auto halfedge_of = [](const SplitEdge& edge) { return edge.edge.halfedge; };
  std::erase_if(splits, [&](const EdgeSplit& split) {
    return std::ranges::lower_bound(edges, split.edge, {}, halfedge_of)->inner.empty();
  });
  return splits;
}

}  // namespace algebra3d
