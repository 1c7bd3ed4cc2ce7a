#include "algebra3d/mesh/builder.h"

#include <algorithm>
#include <numeric>
#include <unordered_set>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/meshes/mesh_access.h"
#include "base/indices.h"
#include "base/large_allocator.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"

namespace algebra3d::mesh {

using detail::MeshAccess;

/// Faces one after the other; a removed face has no corners.
struct MeshBuilder::Content {
  FaceRule rule;
  PointArray points;
  std::vector<VertexId> corners;
  std::vector<std::size_t> starts{0};  // of the corners of each face, and the end
  std::vector<bool> is_removed;
  std::size_t removed_count = 0;
  std::unordered_set<std::uint64_t> directed_edges;  // from and to, once a face was added by the rule manifold_edges
  bool has_directed_edges = false;
  PolygonMesh before;  // the mesh that the builder began with, for its attributes

  explicit Content(FaceRule face_rule) : rule(face_rule) {}

  static std::uint64_t directed_edge(VertexId from, VertexId to) {
    return std::uint64_t{from.index()} << 32U | to.index();
  }
  std::span<const VertexId> face(std::size_t f) const {
    return std::span(corners).subspan(starts[f], starts[f + 1] - starts[f]);
  }
  std::size_t face_slots() const { return is_removed.size(); }

  template <typename Visit>
  static void for_each_edge(std::span<const VertexId> face, Visit visit) {
    for (std::size_t i = 0; i < face.size(); ++i) visit(face[i], face[(i + 1) % face.size()]);
  }
  FaceId append(std::span<const VertexId> face);
  void find_directed_edges();
  Status check(std::span<const VertexId> face) const;
  algebra3d::PolygonMesh polygons(std::vector<std::uint32_t>& sources) const;
  MeshAttributes attributes(const algebra3d::PolygonMesh& result, std::vector<std::uint32_t> face_sources) const;
  std::pair<algebra3d::PolygonMesh, MeshAttributes> built() const {
    std::vector<std::uint32_t> sources;
    algebra3d::PolygonMesh result = polygons(sources);
    MeshAttributes of_result = attributes(result, std::move(sources));
    return {std::move(result), std::move(of_result)};
  }
};

FaceId MeshBuilder::Content::append(std::span<const VertexId> face) {
  corners.insert(corners.end(), face.begin(), face.end());
  starts.push_back(corners.size());
  is_removed.push_back(false);
  if (has_directed_edges)
    for_each_edge(face, [&](VertexId from, VertexId to) { directed_edges.insert(directed_edge(from, to)); });
  return FaceId(is_removed.size() - 1);
}

void MeshBuilder::Content::find_directed_edges() {
  has_directed_edges = true;
  directed_edges.reserve(corners.size());
  for (std::size_t f = 0; f < face_slots(); ++f)
    if (!is_removed[f])
      for_each_edge(face(f), [&](VertexId from, VertexId to) { directed_edges.insert(directed_edge(from, to)); });
}

Status MeshBuilder::Content::check(std::span<const VertexId> face) const {
  if (face.size() < 3)
    return Error{ErrorCode::invalid_value, "add_face: expected three or more corners, found {}", face.size()};
  if (face.size() > algebra3d::PolygonMesh::kMaxHalfedges - corners.size())
    return Error{ErrorCode::limit_exceeded, "add_face: a mesh has {} corners at most",
                 algebra3d::PolygonMesh::kMaxHalfedges};
  for (const VertexId v : face)
    if (!v.is_valid())
      return Error{ErrorCode::invalid_value, "add_face: the handle of a corner is invalid"};
    else if (v.index() >= points.size())
      return Error{ErrorCode::invalid_value, "add_face: there is no vertex {}; there are {}, numbered from 0",
                   v.index(), points.size()};
  std::vector<VertexId> sorted(face.begin(), face.end());
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    return Error{ErrorCode::invalid_value, "add_face: vertex {} is two corners of the face", twice->index()};
  if (rule == FaceRule::any) return {};
  Status status;
  for_each_edge(face, [&](VertexId from, VertexId to) {
    if (status && directed_edges.contains(directed_edge(from, to)))
      status = Error{ErrorCode::invalid_value, "add_face: the edge from vertex {} to vertex {} has a face already",
                     from.index(), to.index()};
  });
  return status;
}

/// The faces that are left; `sources`: their numbers here.
algebra3d::PolygonMesh MeshBuilder::Content::polygons(std::vector<std::uint32_t>& sources) const {
  LargeVector<std::uint32_t> result_starts{0}, result_corners;
  result_corners.reserve(corners.size());
  for (std::size_t f = 0; f < face_slots(); ++f) {
    if (is_removed[f]) continue;
    for (const VertexId v : face(f)) result_corners.push_back(v.index());
    result_starts.push_back(static_cast<std::uint32_t>(result_corners.size()));
    sources.push_back(static_cast<std::uint32_t>(f));
  }
  return {points, PolygonLayout(std::move(result_starts)), std::move(result_corners)};
}

MeshAttributes MeshBuilder::Content::attributes(const algebra3d::PolygonMesh& result,
                                                std::vector<std::uint32_t> face_sources) const {
  const MeshAttributes given = MeshAccess::attributes(before);
  if (given.is_empty()) return {};
  const algebra3d::PolygonMesh& old = MeshAccess::content(before);
  ElementSources sources;
  sources.vertices.resize(result.vertex_count(), kNone);
  std::iota(sources.vertices.begin(), sources.vertices.begin() + static_cast<std::ptrdiff_t>(old.vertex_count()), 0U);
  sources.halfedges.resize(result.halfedge_count(), kNone);
  sources.faces = std::move(face_sources);
  for (const FaceId f : faces(result)) {
    auto& source = sources.faces[f.index()];
    if (source >= old.face_count()) {
      source = kNone;
      continue;
    }
    for (std::uint32_t corner = 0; corner < result.degree(f); ++corner)
      sources.halfedges[result.halfedge(f, corner).index()] = old.halfedge(FaceId(source), corner).index();
  }
  sources.edges = edge_sources(result, old, sources.halfedges);
  return taken_over(given, sources);
}

MeshBuilder::MeshBuilder(FaceRule rule) : content_(std::make_unique<Content>(rule)) {}

MeshBuilder::MeshBuilder(const PolygonMesh& mesh, FaceRule rule) : MeshBuilder(rule) {
  content_->before = mesh;
  content_->points = MeshAccess::content(mesh).points();
  std::vector<VertexId> face;
  for (const FaceId f : faces(mesh)) {
    face.clear();
    for (const VertexId v : vertices_of(mesh, f)) face.push_back(v);
    content_->append(face);
  }
}

MeshBuilder::MeshBuilder(MeshBuilder&&) noexcept = default;
MeshBuilder& MeshBuilder::operator=(MeshBuilder&&) noexcept = default;
MeshBuilder::~MeshBuilder() = default;

std::size_t MeshBuilder::vertex_count() const {
  return content_->points.size();
}
std::size_t MeshBuilder::face_count() const {
  return content_->face_slots() - content_->removed_count;
}

Result<VertexId> MeshBuilder::add_vertex(const Vec3& point) {
  return without_exceptions([&]() -> Result<VertexId> {
    if (!is_finite(point))
      return Error{ErrorCode::invalid_value, "add_vertex: expected finite coordinates, found ({}, {}, {})", point.x,
                   point.y, point.z};
    if (vertex_count() >= algebra3d::PolygonMesh::kMaxHalfedges)
      return Error{ErrorCode::limit_exceeded, "add_vertex: a mesh has {} vertices at most",
                   algebra3d::PolygonMesh::kMaxHalfedges};
    content_->points.push_back(ExactPoint(point));
    return VertexId(vertex_count() - 1);
  });
}

Result<FaceId> MeshBuilder::add_face(std::span<const VertexId> corners) {
  return without_exceptions([&]() -> Result<FaceId> {
    if (content_->rule == FaceRule::manifold_edges && !content_->has_directed_edges) content_->find_directed_edges();
    A3D_TRY(content_->check(corners));
    return content_->append(corners);
  });
}

Status MeshBuilder::remove_face(FaceId f) {
  return without_exceptions([&]() -> Status {
    if (!f.is_valid()) return Error{ErrorCode::invalid_value, "remove_face: the handle is invalid"};
    if (f.index() >= content_->face_slots() || content_->is_removed[f.index()])
      return Error{ErrorCode::invalid_value, "remove_face: there is no face {}", f.index()};
    content_->is_removed[f.index()] = true;
    ++content_->removed_count;
    if (content_->has_directed_edges)
      Content::for_each_edge(content_->face(f.index()), [&](VertexId from, VertexId to) {
        content_->directed_edges.erase(Content::directed_edge(from, to));
      });
    return {};
  });
}

Result<PolygonMesh> MeshBuilder::mesh() const {
  return without_exceptions([&]() -> Result<PolygonMesh> {
    auto [polygons, attributes] = content_->built();
    return MeshAccess::outer(std::move(polygons), attributes);
  });
}

Result<TriangleMesh> MeshBuilder::triangle_mesh() const {
  return without_exceptions([&]() -> Result<TriangleMesh> {
    const auto [polygons, attributes] = content_->built();
    return detail::triangle_mesh_of(polygons, attributes);
  });
}

}  // namespace algebra3d::mesh
