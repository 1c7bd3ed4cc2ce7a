#include "algebra3d/values/constructions/mesh_conversions.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/coplanar_facets.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/soup/mesh_triangulation.h"
#include "algebra3d/kernel/soup/weld.h"
#include "base/indices.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Faces that are added one after the other, over points of which only the used ones are kept.
class PolygonCollector {
 public:
  void add_corner(std::uint32_t vertex) { corners_.push_back(vertex); }
  void end_face() { starts_.push_back(static_cast<std::uint32_t>(corners_.size())); }

  PolygonMesh mesh_over(const PointArray& points) && {
    std::vector<std::uint32_t> numbers(points.size(), kNone);
    for (const std::uint32_t corner : corners_) numbers[corner] = 0;
    PointArray used;
    for (std::size_t v = 0; v < points.size(); ++v) {
      poll_interruption_at(v);
      if (numbers[v] == kNone) continue;
      numbers[v] = static_cast<std::uint32_t>(used.size());
      used.push_back(points[v]);
    }
    for (std::uint32_t& corner : corners_) corner = numbers[corner];
    return {std::move(used), PolygonLayout(std::move(starts_)), std::move(corners_)};
  }

 private:
  LargeVector<std::uint32_t> starts_{0}, corners_;
};

/// Joins the triangles of coplanar facets.
class FacetMerger {
 public:
  explicit FacetMerger(const TriangleMesh& mesh)
      : mesh_(mesh), facets_(mesh), outgoing_(mesh.vertex_count(), kNone), needed_(mesh.vertex_count(), false) {}

  Result<PolygonMesh> merge(const Monitor& monitor) {
    std::vector<std::vector<HalfedgeId>> outlines;
    for (const CoplanarFacetId facet : facets_.ids()) {
      if (outlines.size() % 4096 == 0) A3D_TRY(monitor.check());
      outlines.push_back(outline_of(facet));
    }
    for (const VertexId v : vertices(mesh_)) needed_[v.index()] = needed_[v.index()] || !is_within_line(v);
    PolygonCollector polygons;
    std::vector<bool> is_done(outlines.size(), false);
    for (const FaceId f : faces(mesh_)) {
      poll_interruption_at(f.index());
      const std::size_t facet = facets_.of(f).index();
      if (outlines[facet].empty()) {
        for (const std::uint32_t corner : mesh_.triangle(f)) polygons.add_corner(corner);
        polygons.end_face();
      } else if (!is_done[facet]) {
        is_done[facet] = true;
        add_polygon(outlines[facet], polygons);
      }
    }
    return std::move(polygons).mesh_over(mesh_.points());
  }

 private:
  /// The boundary of a facet, from its first half-edge on; empty if it is not one loop that meets each vertex once.
  /// The vertices of such a facet are needed then.
  std::vector<HalfedgeId> outline_of(CoplanarFacetId facet) {
    std::vector<HalfedgeId> boundary;
    for (const FaceId f : facets_.faces(facet))
      for (std::uint32_t i = 0; i < 3; ++i)
        if (const HalfedgeId h = TriangleMesh::halfedge(f, i); facets_.is_boundary(h)) boundary.push_back(h);
    std::ranges::sort(boundary);
    std::vector<HalfedgeId> outline = loop_of(boundary);
    for (const HalfedgeId h : boundary) outgoing_[mesh_.origin(h).index()] = kNone;
    if (outline.size() == boundary.size()) return outline;
    for (const FaceId f : facets_.faces(facet))
      for (const std::uint32_t corner : mesh_.triangle(f)) needed_[corner] = true;
    return {};
  }

  /// The loop that begins with the first half-edge; not all of them if they are more loops, or meet a vertex twice.
  std::vector<HalfedgeId> loop_of(const std::vector<HalfedgeId>& boundary) {
    for (std::size_t i = 0; i < boundary.size(); ++i) {
      std::uint32_t& outgoing = outgoing_[mesh_.origin(boundary[i]).index()];
      if (outgoing != kNone) return {};
      outgoing = static_cast<std::uint32_t>(i);
    }
    std::vector<HalfedgeId> loop;
    std::uint32_t next = 0;
    do {
      loop.push_back(boundary[next]);
      next = outgoing_[mesh_.target(boundary[next]).index()];
    } while (next != 0 && next != kNone && loop.size() <= boundary.size());
    return loop;
  }

  /// True if the vertex has exactly two edges between facets or on the boundary, and these are in one line.
  bool is_within_line(VertexId v) const {
    std::array<VertexId, 2> ends;
    std::size_t count = 0;
    const auto add = [&](VertexId end) {
      if (std::ranges::find(ends, end) != ends.end()) return;
      if (count < 2) ends[count] = end;
      ++count;
    };
    for (const HalfedgeId h : outgoing_halfedges(mesh_, v)) {
      if (facets_.is_boundary(h)) add(mesh_.target(h));
      if (facets_.is_boundary(TriangleMesh::prev(h))) add(mesh_.origin(TriangleMesh::prev(h)));
    }
    return count == 2 && collinear(mesh_.point(ends[0]), mesh_.point(v), mesh_.point(ends[1]));
  }

  void add_polygon(const std::vector<HalfedgeId>& outline, PolygonCollector& polygons) const {
    for (const HalfedgeId h : outline)
      if (needed_[mesh_.origin(h).index()]) polygons.add_corner(mesh_.origin(h).index());
    polygons.end_face();
  }

  const TriangleMesh& mesh_;
  CoplanarFacets facets_;
  std::vector<std::uint32_t> outgoing_;  // per vertex: place in a boundary; unset between calls
  std::vector<bool> needed_;             // per vertex
};

/// Where the elements of the triangles of a mesh come from; edges between triangles of one face are new.
ElementSources sources_of_triangles(const PolygonMesh& mesh, const PolygonMesh& polygons,
                                    std::span<const CornerTriangle> triangles) {
  ElementSources sources;
  sources.vertices.resize(mesh.vertex_count());
  std::iota(sources.vertices.begin(), sources.vertices.end(), 0U);
  std::vector<std::uint32_t> along;
  for (const CornerTriangle& triangle : triangles) {
    sources.faces.push_back(polygons.face(triangle[0]).index());
    for (std::size_t i = 0; i < 3; ++i) {
      sources.halfedges.push_back(triangle[i].index());
      const bool is_old = polygons.target(triangle[i]) == polygons.origin(triangle[(i + 1) % 3]);
      along.push_back(is_old ? triangle[i].index() : kNone);
    }
  }
  sources.edges = edge_sources(mesh, polygons, along);
  return sources;
}

}  // namespace

Result<PolygonMesh> polygon_mesh_of(const TriangleMesh& mesh, Merging merging, const Monitor& monitor) {
  if (merging == Merging::coplanar_facets) return FacetMerger(mesh).merge(monitor);
  if (std::ranges::none_of(vertices(mesh), [&](VertexId v) { return mesh.is_isolated(v); }))
    return PolygonMesh(mesh.points(), mesh.is_empty() ? PolygonLayout() : PolygonLayout::of_degree(3), mesh.origins());
  PolygonCollector polygons;
  for (const FaceId f : faces(mesh)) {
    poll_interruption_at(f.index());
    for (const std::uint32_t corner : mesh.triangle(f)) polygons.add_corner(corner);
    polygons.end_face();
  }
  return std::move(polygons).mesh_over(mesh.points());
}

Result<TriangleMesh> welded_triangles_of(const PolygonMesh& mesh, const Monitor& monitor) {
  A3D_ASSIGN(const std::vector<CornerTriangle> corners, triangulate_faces(mesh, monitor));
  if (corners.size() > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "{} triangles; at most {} can be joined", corners.size(),
                 TriangleMesh::kMaxFaces};
  if (mesh.points().exact_count() == 0) {
    std::vector<TriangleMesh::Triangle> triangles;
    triangles.reserve(corners.size());
    for (const auto& [a, b, c] : corners)
      triangles.push_back({mesh.origin(a).index(), mesh.origin(b).index(), mesh.origin(c).index()});
    WeldedTriangles welded = weld(mesh.points().approx(), triangles);
    return TriangleMesh(std::move(welded.points), welded.triangles);
  }
  std::vector<std::array<ExactPoint, 3>> triangles;
  triangles.reserve(corners.size());
  const auto point = [&](HalfedgeId h) { return ExactPoint(mesh.point(mesh.origin(h))); };
  for (const auto& [a, b, c] : corners) triangles.push_back({point(a), point(b), point(c)});
  WeldedTriangles welded = weld(triangles);
  return TriangleMesh(std::move(welded.points), welded.triangles);
}

Result<Mesh3d> triangulated(const Mesh3d& mesh, const Monitor& monitor) {
  const PolygonMesh& polygons = mesh.mesh();
  if (polygons.common_degree() == 3 || polygons.is_empty()) return mesh;
  A3D_ASSIGN(const std::vector<CornerTriangle> triangles, triangulate_faces(polygons, monitor));
  LargeVector<std::uint32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const CornerTriangle& triangle : triangles)
    for (const HalfedgeId h : triangle) corners.push_back(polygons.origin(h).index());
  PolygonLayout layout = corners.empty() ? PolygonLayout() : PolygonLayout::of_degree(3);
  PolygonMesh result(polygons.points(), std::move(layout), std::move(corners));
  if (mesh.attributes().is_empty()) return Mesh3d(std::move(result));
  MeshAttributes attributes = taken_over(mesh.attributes(), sources_of_triangles(result, polygons, triangles));
  return Mesh3d(std::move(result), std::move(attributes));
}

}  // namespace algebra3d
