#include "algebra3d/kernel/subdivision/detail/input.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/detail/blocks.h"
#include "algebra3d/kernel/subdivision/detail/mesh_view.h"
#include "base/memory_limit.h"
#include "base/propagate.h"

namespace algebra3d::subdivision {
namespace {

/// Sums over two milliards of neighbours with such coordinates are finite.
constexpr double kLargestCoordinate = 0x1p960;

/// The lowest of so many elements for which is_wanted holds, found in parallel; invalid if it holds for none.
template <typename Id, typename Predicate>
Id first_with(std::size_t count, const Predicate& is_wanted) {
  std::atomic<Id> first = Id();
  for_each_block<Id>(count, Stage({}, {}, 0), [&](std::size_t, IdRange<Id> block) {
    const auto found = std::ranges::find_if(block, is_wanted);
    if (found == block.end()) return;
    for (Id seen = first; *found < seen && !first.compare_exchange_weak(seen, *found);) {
    }
  });
  return first;
}

Status check_manifold(const PolygonMesh& mesh) {
  if (mesh.nonmanifold_edge_count() > 0) {
    const auto along = mesh.nonmanifold_edge(0);
    const HalfedgeId h = along.front();
    return Error{ErrorCode::invalid_value,
                 "the edge between vertices {} and {} is non-manifold: {} half-edges run along it, expected two in "
                 "opposite directions, or one at the boundary",
                 mesh.origin(h).index(), mesh.target(h).index(), along.size()};
  }
  const auto vertices = mesh.nonmanifold_vertices();
  if (vertices.empty()) return {};
  return Error{
      ErrorCode::invalid_value,
      "vertex {} is non-manifold: its faces form {} fans, expected one; components divides solids and surfaces "
      "that touch in vertices",
      vertices.front().index(), mesh.fans(vertices.front()).size()};
}

Status check_triangles(const PolygonMesh& mesh, const SchemeDescription& scheme) {
  if (mesh.is_empty() || mesh.common_degree() == 3) return {};
  for (const FaceId f : faces(mesh))
    if (mesh.degree(f) != 3)
      return Error{ErrorCode::invalid_value,
                   "face {} has {} corners, but {} takes triangles only; triangulate the mesh first", f.index(),
                   mesh.degree(f), scheme.name};
  return {};
}

/// With two edges at an interior vertex, two edges of the result would join the same vertices: those that cut off its
/// two triangles, or for Doo-Sabin the sides of a face with two corners.
Status check_valences(const PolygonMesh& mesh, const SchemeDescription& scheme) {
  const auto valence = [&](const auto& view, VertexId v) {
    std::size_t count = 0;
    view.for_each_outgoing(view.outgoing(v), [&](HalfedgeId) { ++count; });
    return count;
  };
  const VertexId v = with_view(mesh, [&](const auto& view) {
    return first_with<VertexId>(view.vertex_count(), [&](VertexId u) {
      return view.outgoing(u).is_valid() && !view.is_boundary_vertex(u) && valence(view, u) < 3;
    });
  });
  if (v.is_none()) return {};
  return Error{ErrorCode::invalid_value, "vertex {} has {} edges and is on no boundary, but {} needs three edges",
               v.index(), valence(MeshView<0>(mesh), v), scheme.name};
}

/// Where a face meets itself in an edge, two edges of the result would join the middles of both.
Status check_sides(const PolygonMesh& mesh) {
  const HalfedgeId h = with_view(mesh, [&](const auto& view) {
    return first_with<HalfedgeId>(view.halfedge_count(), [&](HalfedgeId other) {
      return !view.is_boundary(other) && view.face(view.opposite(other)) == view.face(other);
    });
  });
  if (h.is_none()) return {};
  const MeshView<0> view(mesh);
  return Error{ErrorCode::invalid_value,
               "face {} is on both sides of the edge between vertices {} and {}; triangulate the mesh first",
               view.face(h).index(), view.origin(h).index(), view.target(h).index()};
}

Status check_coordinates(const PolygonMesh& mesh) {
  const VertexId v = first_with<VertexId>(mesh.vertex_count(), [&](VertexId u) {
    const Vec3& p = mesh.point(u).approx;
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kLargestCoordinate;
  });
  if (v.is_none()) return {};
  return Error{ErrorCode::limit_exceeded, "vertex {} has a coordinate beyond 2^960", v.index()};
}

std::size_t boundary_halfedge_count(const PolygonMesh& mesh) {
  std::atomic<std::size_t> count = 0;
  for_each_block<HalfedgeId>(mesh.halfedge_count(), Stage({}, {}, 0), [&](std::size_t, IdRange<HalfedgeId> block) {
    count += static_cast<std::size_t>(std::ranges::count_if(block, [&](HalfedgeId h) { return mesh.is_boundary(h); }));
  });
  return count;
}

/// Whether numbers and memory suffice for the result, and for those of the steps before it.
Status check_size(const PolygonMesh& mesh, const SchemeDescription& scheme, std::size_t steps, std::size_t variant) {
  constexpr std::uint64_t kLeastBytes = 16;  // of a half-edge of the result: its arrays and its part of a vertex
  if (mesh.is_empty()) return {};
  MeshSize size{mesh.halfedge_count(), scheme.grows_at_boundary ? boundary_halfedge_count(mesh) : 0};
  for (std::size_t i = 0; i < steps; ++i) {
    size = scheme.after_step(size, variant);
    if (size.halfedges > PolygonMesh::kMaxHalfedges)
      return Error{ErrorCode::limit_exceeded,
                   "{} steps make more than {} half-edges of {}; at most {} steps are possible",
                   steps,
                   PolygonMesh::kMaxHalfedges,
                   mesh.halfedge_count(),
                   i};
  }
  if (!size.is_exact) return {};
  return require_memory(size.halfedges * kLeastBytes,
                        fmt::format("{} half-edges after {} steps", size.halfedges, steps));
}

}  // namespace

Status check_input(const PolygonMesh& mesh, const SchemeDescription& scheme, std::size_t steps, std::size_t variant) {
  if (scheme.takes_triangles_only) A3D_TRY(check_triangles(mesh, scheme));
  A3D_TRY(check_manifold(mesh));
  if (scheme.needs_distinct_sides) A3D_TRY(check_sides(mesh));
  if (scheme.needs_three_edges) A3D_TRY(check_valences(mesh, scheme));
  A3D_TRY(check_coordinates(mesh));
  return check_size(mesh, scheme, steps, variant);
}

}  // namespace algebra3d::subdivision
