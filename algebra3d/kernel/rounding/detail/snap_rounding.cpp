#include "algebra3d/kernel/rounding/detail/snap_rounding.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/kernel/planar/sweep_triangulation.h"
#include "algebra3d/kernel/rounding/detail/facet_outlines.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// After so many facets cancellation is looked for.
constexpr std::uint32_t kFacetsPerLook = 1024;

/// The triangles of all facets, with the outlines that they have now.
class SnapRounding {
 public:
  SnapRounding(const TriangleMesh& mesh, const MovedVertices& moved, const Monitor& monitor)
      : monitor_(monitor), outlines_(mesh, moved, monitor) {}

  Result<SnappedMesh> run();

 private:
  void add(const IndexTriangle& triangle);
  void add(PointId a, PointId b, PointId c) { add({a.index(), b.index(), c.index()}); }
  bool fill(Projection plane, const FacetOutline& outline, const std::vector<IndexTriangle>& triangles) const;
  std::vector<IndexTriangle> old_triangles(CoplanarFacetId facet) const;
  bool add_triangulated(CoplanarFacetId facet);
  void add_moved(CoplanarFacetId facet);
  TriangleMesh mesh_of_used_points();

  const Monitor& monitor_;
  FacetOutlines outlines_;
  std::vector<IndexTriangle> triangles_;
};

/// True if none of the triangles turns over, and all together have this boundary and the slits as edges.
bool SnapRounding::fill(Projection plane, const FacetOutline& outline,
                        const std::vector<IndexTriangle>& triangles) const {
  std::vector<DirectedEdge> sides;
  for (const auto& [a, b, c] : triangles) {
    if (outlines_.orientation(plane, PointId(a), PointId(b), PointId(c)) <= 0) return false;
    sides.insert(sides.end(), {{a, b}, {b, c}, {c, a}});
  }
  if (!outline.slits.empty()) std::ranges::sort(sides);
  const auto is_side = [&](const DirectedEdge& slit) { return std::ranges::binary_search(sides, slit); };
  return std::ranges::all_of(outline.slits, is_side) && without_opposites(std::move(sides)) == outline.boundary;
}

void SnapRounding::add(const IndexTriangle& triangle) {
  const auto& [a, b, c] = triangle;
  if (a != b && b != c && c != a) triangles_.push_back(triangle);
}

/// The triangles that the facet had, between the new points; counter-clockwise in the projection.
std::vector<IndexTriangle> SnapRounding::old_triangles(CoplanarFacetId facet) const {
  std::vector<IndexTriangle> triangles;
  for (const FaceId face : outlines_.facets().faces(facet)) {
    const auto [a, b, c] = outlines_.triangle(face);
    triangles.push_back(outlines_.facets().is_flipped(facet) ? IndexTriangle{a, c, b} : IndexTriangle{a, b, c});
  }
  return triangles;
}

/// Adds the old triangles if they still fill the outline, or else new ones. False if the outline bounds no region.
bool SnapRounding::add_triangulated(CoplanarFacetId facet) {
  const Projection plane = outlines_.facets().projection(facet);
  const bool is_flipped = outlines_.facets().is_flipped(facet);
  FacetOutline outline = outlines_.outline(facet);
  if (is_flipped) outline.reverse();
  std::vector<IndexTriangle> triangles = old_triangles(facet);
  if (!fill(plane, outline, triangles)) {
    triangles.clear();
    std::vector<DirectedEdge> edges = outline.boundary;
    edges.insert(edges.end(), outline.slits.begin(), outline.slits.end());
    const bool is_region = triangulate_by_sweep(outlines_.points().table, plane, edges, triangles);
    if (!is_region || !fill(plane, outline, triangles)) return false;
  }
  for (const auto& [a, b, c] : triangles) triangles_.push_back(is_flipped ? std::array{a, c, b} : std::array{a, b, c});
  return true;
}

/// Adds the old triangles between the new points, and others between their edges and the chains of these.
void SnapRounding::add_moved(CoplanarFacetId facet) {
  for (const FaceId face : outlines_.facets().faces(facet)) add(outlines_.triangle(face));
  for (const OutlineChain& side : outlines_.outline_chains(facet)) {
    const auto chain = std::as_const(outlines_).chains()[side.chain];
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
      if (side.is_reversed)
        add(chain[0], chain[i + 1], chain[i]);
      else
        add(chain[0], chain[i], chain[i + 1]);
    }
  }
}

TriangleMesh SnapRounding::mesh_of_used_points() {
  const PointTable& table = outlines_.points().table;
  PointArray used;
  IdVector<PointId, VertexId> vertices(table.size());
  for (IndexTriangle& triangle : triangles_)
    for (std::uint32_t& corner : triangle) {
      VertexId& vertex = vertices[PointId(corner)];
      if (!vertex.is_valid()) {
        vertex = VertexId(used.size());
        used.push_back(table[corner]);
      }
      corner = vertex.index();
    }
  return {std::move(used), triangles_};
}

Result<SnappedMesh> SnapRounding::run() {
  for (const CoplanarFacetId facet : outlines_.facets().ids()) {
    if (facet.index() % kFacetsPerLook == 0) A3D_TRY(monitor_.check());
    const bool keeps_triangles = !outlines_.is_moved(facet) || !outlines_.is_simple(facet);
    if (keeps_triangles || !add_triangulated(facet)) add_moved(facet);
  }
  return SnappedMesh{mesh_of_used_points(), outlines_.chains().largest_detour()};
}

}  // namespace

Result<SnappedMesh> moved_mesh(const TriangleMesh& mesh, PointArray points, const Monitor& monitor) {
  const std::size_t count = points.size();
  // Vertices that have not moved pass over nothing.
  return snap_round(mesh, {std::move(points), std::vector<double>(count)}, monitor);
}

Result<SnappedMesh> snap_round(const TriangleMesh& mesh, const MovedVertices& moved, const Monitor& monitor) {
  return SnapRounding(mesh, moved, monitor).run();
}

}  // namespace algebra3d
