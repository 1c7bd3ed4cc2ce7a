#include "algebra3d/kernel/repair/detail/edge_splits.h"

#include <algorithm>
#include <span>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/repair/detail/boundary_edges.h"

namespace algebra3d {
namespace {

std::uint32_t corner_of(HalfedgeId edge) {
  return edge.index() % 3;
}

/// The splits of the first edge among sorted ones.
std::span<const EdgeSplit> splits_of_first_edge(std::span<const EdgeSplit> splits) {
  const HalfedgeId edge = splits.front().edge;
  const auto end = std::ranges::find_if(splits, [&](const EdgeSplit& s) { return s.edge != edge; });
  return splits.first(static_cast<std::size_t>(end - splits.begin()));
}

void report_splits(const IndexedSoup& soup, std::span<const EdgeSplit> splits, RepairReport& report) {
  const HalfedgeId edge = splits.front().edge;
  const FaceId triangle = TriangleMesh::face(edge);
  const Vec3 &from = soup.corner(triangle, corner_of(edge)), &to = soup.corner(triangle, (corner_of(edge) + 1) % 3);
  for (const EdgeSplit& split : splits) {
    const Vec3& vertex = soup.point(split.vertex);
    const bool is_on_edge = is_exactly_on(from, vertex, to);
    const Vec3 foot = from + split.parameter * (to - from);
    report.add(RepairStep::t_junctions, vertex, is_on_edge ? 0 : length(vertex - foot));
  }
}

/// Replaces the triangle of one edge by a fan of triangles around its opposite corner.
void split_triangle(IndexedSoup& soup, std::span<const EdgeSplit> splits) {
  const HalfedgeId edge = splits.front().edge;
  TriangleMesh::Triangle& triangle = soup.triangles[TriangleMesh::face(edge)];
  const std::uint32_t end = triangle[(corner_of(edge) + 1) % 3], apex = triangle[(corner_of(edge) + 2) % 3];
  // The first part keeps the number, and with it the edge at its corner.
  triangle[(corner_of(edge) + 1) % 3] = splits.front().vertex.index();
  std::vector<TriangleMesh::Triangle> others;
  for (std::size_t i = 0; i < splits.size(); ++i)
    others.push_back({splits[i].vertex.index(), i + 1 < splits.size() ? splits[i + 1].vertex.index() : end, apex});
  soup.add(others);
}

}  // namespace

bool is_exactly_on(const Vec3& from, const Vec3& p, const Vec3& to) {
  return collinear(from, p, to) && compare(from, p) == compare(p, to);
}

std::vector<EdgeSplit> find_splits(const IndexedSoup& soup, double reach, const LiesOnEdge& lies_on) {
  const BoundaryEdges boundary(soup);
  const auto tree = boundary.vertex_tree(soup);
  std::vector<EdgeSplit> result;
  for (const BoundaryEdge& edge : boundary.edges) {
    const Vec3 &from = soup.point(edge.from), &to = soup.point(edge.to);
    Box3 box = Box3::of(from);
    box.extend(to);
    const TriangleMesh::Triangle& triangle = soup.triangles[TriangleMesh::face(edge.halfedge)];
    for (const std::uint32_t v : tree.window(widened(box, reach))) {
      if (std::ranges::find(triangle, v) != triangle.end() || !lies_on(from, soup.points[v], to)) continue;
      const Vec3 along = to - from;
      result.push_back({edge.halfedge, dot(soup.points[v] - from, along) / dot(along, along), VertexId(v)});
    }
  }
  return result;
}

bool split_edges(IndexedSoup& soup, std::vector<EdgeSplit> splits, RepairReport& report) {
  std::ranges::sort(splits);
  FaceId last;
  bool is_all = true;
  for (std::span<const EdgeSplit> left = splits; !left.empty();) {
    const auto of_edge = splits_of_first_edge(left);
    left = left.subspan(of_edge.size());
    const FaceId triangle = TriangleMesh::face(of_edge.front().edge);
    if (triangle == last) {
      is_all = false;
      continue;
    }
    last = triangle;
    report_splits(soup, of_edge, report);
    split_triangle(soup, of_edge);
  }
  return is_all;
}

}  // namespace algebra3d
