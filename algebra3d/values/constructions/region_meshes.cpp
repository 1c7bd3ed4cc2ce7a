#include "algebra3d/values/constructions/region_meshes.h"

#include <array>
#include <utility>
#include <vector>

#include "algebra3d/kernel/autorefinement/valid_parts.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/planar/boundary_polygons.h"
#include "algebra3d/kernel/planar/constrained_delaunay.h"
#include "algebra3d/kernel/planar/noding.h"
#include "algebra3d/kernel/soup/spatial_order.h"
#include "algebra3d/kernel/soup/weld.h"
#include "algebra3d/values/constructions/detail/heights.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

/// The triangles that look up, pressed flat; equal points become one.
TriangleMesh pressed_flat(const TriangleMesh& mesh) {
  std::vector<std::array<ExactPoint, 3>> triangles;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    const auto corners = mesh.corners(FaceId(f));
    if (orient2d(Projection::xy, corners[0], corners[1], corners[2]) > 0)
      triangles.push_back({at_height(corners[0], 0), at_height(corners[1], 0), at_height(corners[2], 0)});
  }
  WeldedTriangles welded = weld(triangles);
  return {std::move(welded.points), welded.triangles};
}

}  // namespace

Result<TriangleMesh> flat_mesh(const Region& region, const Monitor& monitor) {
  const Polygons& polygons = region.polygons();
  A3D_ASSIGN(const std::vector<Triangle> triangles, triangulate(polygons, monitor));
  return in_spatial_order(TriangleMesh(polygons.corners, triangles));
}

Result<TriangleMesh> prism(const Region& region, double height, const Monitor& monitor) {
  const Polygons& polygons = region.polygons();
  A3D_ASSIGN(const std::vector<DirectedEdge> edges, noded(polygons.corners, segments_of(polygons), monitor));
  A3D_ASSIGN(const std::vector<Triangle> flat, constrained_delaunay(polygons.corners, edges, monitor));
  const auto count = static_cast<std::uint32_t>(polygons.corners.size());
  const std::uint32_t lower = height > 0 ? 0 : count, upper = height > 0 ? count : 0;
  PointArray points;
  add_at_height(polygons.corners, 0, points);
  add_at_height(polygons.corners, height, points);
  std::vector<Triangle> triangles;
  triangles.reserve(2 * (flat.size() + edges.size()));
  for (const auto& [a, b, c] : flat) {
    triangles.push_back({lower + a, lower + c, lower + b});
    triangles.push_back({upper + a, upper + b, upper + c});
  }
  for (const auto& [a, b] : edges) {
    triangles.push_back({lower + a, lower + b, upper + b});
    triangles.push_back({lower + a, upper + b, upper + a});
  }
  return in_spatial_order(TriangleMesh(std::move(points), triangles));
}

Result<Region> covered_region(const TriangleMesh& mesh, const Monitor& monitor) {
  std::vector<DirectedEdge> edges;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.triangle(FaceId(f));
    edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
  }
  PointArray points;
  add_at_height(mesh.points(), 0, points);
  A3D_ASSIGN(const std::vector<DirectedEdge> boundary, noded(points, edges, monitor));
  A3D_ASSIGN(Polygons polygons, boundary_polygons(points, boundary, monitor));
  return Region::trusted(std::move(polygons));
}

Result<Region> combined_regions(const Region& a, const Region& b, SurfaceRule rule, const Monitor& monitor) {
  A3D_ASSIGN(const TriangleMesh first, flat_mesh(a, monitor));
  A3D_ASSIGN(const TriangleMesh second, flat_mesh(b, monitor));
  A3D_ASSIGN(const TriangleMesh result, combine_surfaces({&first, 0}, {&second, 1}, rule, monitor));
  return covered_region(result, monitor);
}

Result<Region> shadow(const TriangleMesh& mesh, const Monitor& monitor) {
  const TriangleMesh flat = pressed_flat(mesh);
  A3D_ASSIGN(const ValidParts parts, ValidParts::make(flat, monitor));
  A3D_ASSIGN(const TriangleMesh united, unite_surfaces(parts.operands(), monitor));
  return covered_region(united, monitor);
}

}  // namespace algebra3d
