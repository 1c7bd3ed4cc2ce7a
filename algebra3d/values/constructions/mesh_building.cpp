#include "algebra3d/values/constructions/mesh_building.h"

#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "base/indices.h"

namespace algebra3d {
namespace {

std::vector<std::uint32_t> numbers_below(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// The faces of another mesh, one after the other.
struct FaceList {
  LargeVector<std::uint32_t> starts{0}, corners;
  std::vector<std::uint32_t> faces, halfedges;  // of the other mesh, or kNone

  void add(const PolygonMesh& mesh, FaceId f) {
    for (const HalfedgeId h : halfedges_of(mesh, f)) add_corner(mesh.origin(h).index(), h.index());
    end(f.index());
  }
  void add_corner(std::uint32_t vertex, std::uint32_t halfedge) {
    corners.push_back(vertex);
    halfedges.push_back(halfedge);
  }
  void end(std::uint32_t face) {
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
    faces.push_back(face);
  }

  /// Over the vertices of the mesh that the faces come from, with its attributes.
  Mesh3d over(const Mesh3d& mesh) && {
    PolygonMesh result(mesh.mesh().points(), PolygonLayout(std::move(starts)), std::move(corners));
    if (mesh.attributes().is_empty()) return Mesh3d(std::move(result));
    const ElementSources sources{numbers_below(result.vertex_count()), edge_sources(result, mesh.mesh(), halfedges),
                                 halfedges, faces};
    MeshAttributes attributes = taken_over(mesh.attributes(), sources);
    return {std::move(result), std::move(attributes)};
  }
};

}  // namespace

Mesh3d with_vertex(const Mesh3d& mesh, const PointRef& point) {
  const PolygonMesh& old = mesh.mesh();
  PointArray points = old.points();
  points.push_back(point);
  PolygonMesh result(std::move(points), old.layout(), old.origins());
  if (mesh.attributes().is_empty()) return Mesh3d(std::move(result));
  ElementSources sources{numbers_below(old.vertex_count()), numbers_below(element_count(old, MeshElement::edge)),
                         numbers_below(old.halfedge_count()), numbers_below(old.face_count())};
  sources.vertices.push_back(kNone);
  MeshAttributes attributes = taken_over(mesh.attributes(), sources);
  return {std::move(result), std::move(attributes)};
}

Result<Maybe<Mesh3d>> with_face(const Mesh3d& mesh, std::span<const std::int64_t> corners) {
  if (corners.size() < 3)
    return Maybe<Mesh3d>(Undefined{fmt::format("a face has three or more corners, but {} were given", corners.size())});
  const PolygonMesh& old = mesh.mesh();
  if (corners.size() > PolygonMesh::kMaxHalfedges - old.halfedge_count())
    return Error{ErrorCode::limit_exceeded, "a mesh may have {} corners of faces", PolygonMesh::kMaxHalfedges};
  FaceList list;
  for (const FaceId f : faces(old)) list.add(old, f);
  for (const std::int64_t corner : corners) {
    if (corner < 0 || static_cast<std::uint64_t>(corner) >= old.vertex_count())
      return Maybe<Mesh3d>(Undefined{
          fmt::format("there is no vertex {}; the mesh has {} vertices, numbered from 0", corner, old.vertex_count())});
    list.add_corner(static_cast<std::uint32_t>(corner), kNone);
  }
  list.end(kNone);
  return Maybe<Mesh3d>(std::move(list).over(mesh));
}

Maybe<Mesh3d> without_face(const Mesh3d& mesh, std::int64_t face) {
  const PolygonMesh& old = mesh.mesh();
  if (face < 0 || static_cast<std::uint64_t>(face) >= old.face_count())
    return Undefined{
        fmt::format("there is no face {}; the mesh has {} faces, numbered from 0", face, old.face_count())};
  FaceList list;
  for (const FaceId f : faces(old))
    if (f.index() != static_cast<std::uint64_t>(face)) list.add(old, f);
  return std::move(list).over(mesh);
}

}  // namespace algebra3d
