#include "algebra3d/mesh/editor.h"

#include <cassert>
#include <string_view>
#include <utility>

#include "algebra3d/kernel/halfedge/mesh_editor.h"
#include "algebra3d/meshes/mesh_access.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"

namespace algebra3d::mesh {

using detail::MeshAccess;

struct MeshEditor::Content {
  algebra3d::MeshEditor editor;
  PolygonMesh source;

  bool has(VertexId v) const { return v.index() < editor.vertex_slots() && editor.is_used(v); }
  bool has(HalfedgeId h) const { return h.index() < editor.halfedge_slots() && editor.is_used(h); }
  bool has(FaceId f) const { return f.index() < editor.face_slots() && editor.is_used(f); }
  /// The attributes of the mesh as it is now.
  MeshAttributes attributes_of(const algebra3d::PolygonMesh& now) const {
    const MeshAttributes given = MeshAccess::attributes(source);
    return given.is_empty() ? given : editor.attributes(given, MeshAccess::content(source), now);
  }
};

namespace {

constexpr std::string_view kind_of(VertexId /*v*/) {
  return "vertex";
}
constexpr std::string_view kind_of(HalfedgeId /*h*/) {
  return "half-edge";
}
constexpr std::string_view kind_of(FaceId /*f*/) {
  return "face";
}

template <typename Content, typename Id>
Status check_used(std::string_view edit, const Content& content, Id id) {
  if (content.has(id)) return {};
  if (!id.is_valid()) return Error{ErrorCode::invalid_value, "{}: the {} is invalid", edit, kind_of(id)};
  return Error{ErrorCode::invalid_value, "{}: there is no {} {}", edit, kind_of(id), id.index()};
}

Status check_point(std::string_view edit, const Vec3& point) {
  if (is_finite(point)) return {};
  return Error{
      ErrorCode::invalid_value, "{}: expected finite coordinates, found ({}, {}, {})", edit, point.x, point.y, point.z};
}

template <typename T>
Result<T> result_of(std::string_view edit, Maybe<T> outcome) {
  if (!outcome) return Error{ErrorCode::invalid_value, "{}: {}", edit, outcome.reason()};
  return *outcome;
}

}  // namespace

MeshEditor::MeshEditor(std::unique_ptr<Content> content) : content_(std::move(content)) {}
MeshEditor::MeshEditor(MeshEditor&&) noexcept = default;
MeshEditor& MeshEditor::operator=(MeshEditor&&) noexcept = default;
MeshEditor::~MeshEditor() = default;

Result<MeshEditor> MeshEditor::of(const PolygonMesh& mesh) {
  return without_exceptions([&]() -> Result<MeshEditor> {
    Maybe<algebra3d::MeshEditor> editor = algebra3d::MeshEditor::of(MeshAccess::content(mesh));
    if (!editor) return Error{ErrorCode::invalid_value, "MeshEditor: {}", editor.reason()};
    return MeshEditor(std::unique_ptr<Content>(new Content{*std::move(editor), mesh}));
  });
}

Result<MeshEditor> MeshEditor::of(const TriangleMesh& mesh) {
  return without_exceptions([&]() -> Result<MeshEditor> { return of(PolygonMesh(mesh)); });
}

Result<PolygonMesh> MeshEditor::mesh() const {
  return without_exceptions([&]() -> Result<PolygonMesh> {
    algebra3d::PolygonMesh result = content_->editor.mesh();
    const MeshAttributes attributes = content_->attributes_of(result);
    return MeshAccess::outer(std::move(result), attributes);
  });
}

Result<TriangleMesh> MeshEditor::triangle_mesh() const {
  return without_exceptions([&]() -> Result<TriangleMesh> {
    const algebra3d::PolygonMesh polygons = content_->editor.mesh();
    return detail::triangle_mesh_of(polygons, content_->attributes_of(polygons));
  });
}

std::size_t MeshEditor::vertex_count() const {
  return content_->editor.vertex_count();
}
std::size_t MeshEditor::edge_count() const {
  return content_->editor.edge_count();
}
std::size_t MeshEditor::face_count() const {
  return content_->editor.face_count();
}
bool MeshEditor::is_used(VertexId v) const {
  return content_->has(v);
}
bool MeshEditor::is_used(HalfedgeId h) const {
  return content_->has(h);
}
bool MeshEditor::is_used(FaceId f) const {
  return content_->has(f);
}
HalfedgeId MeshEditor::next(HalfedgeId h) const {
  return assert(is_used(h)), content_->editor.next(h);
}
HalfedgeId MeshEditor::prev(HalfedgeId h) const {
  return assert(is_used(h)), content_->editor.prev(h);
}
HalfedgeId MeshEditor::opposite(HalfedgeId h) const {
  return assert(is_used(h)), content_->editor.opposite(h);
}
VertexId MeshEditor::origin(HalfedgeId h) const {
  return assert(is_used(h)), content_->editor.origin(h);
}
VertexId MeshEditor::target(HalfedgeId h) const {
  return assert(is_used(h)), content_->editor.target(h);
}
FaceId MeshEditor::face(HalfedgeId h) const {
  return assert(is_used(h)), content_->editor.face(h);
}
HalfedgeId MeshEditor::halfedge(FaceId f) const {
  return assert(is_used(f)), content_->editor.halfedge(f);
}
HalfedgeId MeshEditor::outgoing(VertexId v) const {
  return assert(is_used(v)), content_->editor.outgoing(v);
}
HalfedgeId MeshEditor::find_halfedge(VertexId from, VertexId to) const {
  return is_used(from) && is_used(to) ? content_->editor.find(from, to) : HalfedgeId();
}
const Vec3& MeshEditor::point(VertexId v) const {
  return assert(is_used(v)), content_->editor.point(v).approx();
}

Result<HalfedgeId> MeshEditor::flip_edge(HalfedgeId h) {
  return without_exceptions([&]() -> Result<HalfedgeId> {
    A3D_TRY(check_used("flip_edge", *content_, h));
    return result_of("flip_edge", content_->editor.flip_edge(h));
  });
}

Result<VertexId> MeshEditor::split_edge(HalfedgeId h, const Vec3& point) {
  return without_exceptions([&]() -> Result<VertexId> {
    A3D_TRY(check_used("split_edge", *content_, h));
    A3D_TRY(check_point("split_edge", point));
    return content_->editor.split_edge(h, ExactPoint(point));
  });
}

Result<VertexId> MeshEditor::collapse_edge(HalfedgeId h) {
  return without_exceptions([&]() -> Result<VertexId> {
    A3D_TRY(check_used("collapse_edge", *content_, h));
    return result_of("collapse_edge", content_->editor.collapse_edge(h));
  });
}

Result<FaceId> MeshEditor::split_face(FaceId f, VertexId from, VertexId to) {
  return without_exceptions([&]() -> Result<FaceId> {
    A3D_TRY(check_used("split_face", *content_, f));
    A3D_TRY(check_used("split_face", *content_, from));
    A3D_TRY(check_used("split_face", *content_, to));
    return result_of("split_face", content_->editor.split_face(f, from, to));
  });
}

Result<VertexId> MeshEditor::split_face(FaceId f, const Vec3& point) {
  return without_exceptions([&]() -> Result<VertexId> {
    A3D_TRY(check_used("split_face", *content_, f));
    A3D_TRY(check_point("split_face", point));
    return result_of("split_face", content_->editor.split_face(f, ExactPoint(point)));
  });
}

Result<VertexId> MeshEditor::split_vertex(VertexId v, HalfedgeId first, HalfedgeId last, const Vec3& point) {
  return without_exceptions([&]() -> Result<VertexId> {
    A3D_TRY(check_used("split_vertex", *content_, v));
    A3D_TRY(check_used("split_vertex", *content_, first));
    A3D_TRY(check_used("split_vertex", *content_, last));
    A3D_TRY(check_point("split_vertex", point));
    return result_of("split_vertex", content_->editor.split_vertex(v, first, last, ExactPoint(point)));
  });
}

Status MeshEditor::move_vertex(VertexId v, const Vec3& point) {
  return without_exceptions([&]() -> Status {
    A3D_TRY(check_used("move_vertex", *content_, v));
    A3D_TRY(check_point("move_vertex", point));
    content_->editor.move_vertex(v, ExactPoint(point));
    return {};
  });
}

}  // namespace algebra3d::mesh
