#include "algebra3d/kernel/halfedge/mesh_editor.h"

#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "base/indices.h"
#include "base/interruption_scope.h"
#include "base/large_allocator.h"

namespace algebra3d {
namespace {

/// The layout of faces with these starts; without arrays if all have one degree.
PolygonLayout layout_of(LargeVector<std::uint32_t> starts) {
  if (starts.size() < 2) return PolygonLayout::of_degree(3);
  const std::uint32_t degree = starts[1];
  for (std::size_t f = 1; f < starts.size(); ++f)
    if (starts[f] != f * degree) return PolygonLayout(std::move(starts));
  return PolygonLayout::of_degree(degree);
}

}  // namespace

Maybe<MeshEditor> MeshEditor::of(const PolygonMesh& mesh) {
  if (mesh.nonmanifold_edge_count() > 0) {
    const HalfedgeId h = mesh.nonmanifold_edge(0).front();
    return Undefined{fmt::format("the mesh is not a manifold: {} faces meet at the edge between vertices {} and {}",
                                 mesh.nonmanifold_edge(0).size(), mesh.origin(h).index(), mesh.target(h).index())};
  }
  if (const auto vertices = mesh.nonmanifold_vertices(); !vertices.empty())
    return Undefined{fmt::format("the mesh is not a manifold: its faces at vertex {} form {} fans",
                                 vertices.front().index(), mesh.fans(vertices.front()).size())};
  MeshEditor editor;
  editor.take(mesh);
  editor.add_boundary(mesh);
  return editor;
}

void MeshEditor::take(const PolygonMesh& mesh) {
  points_.reserve(mesh.vertex_count());
  vertices_.reserve(mesh.vertex_count());
  faces_.reserve(mesh.face_count());
  face_sources_.reserve(mesh.face_count());
  halfedges_.reserve(mesh.halfedge_count());
  for (const VertexId v : algebra3d::vertices(mesh)) {
    poll_interruption_at(v.index());
    points_.emplace_back(mesh.point(v));
    vertices_.push_back({mesh.outgoing(v), true, v.index()});
  }
  for (const FaceId f : algebra3d::faces(mesh)) {
    poll_interruption_at(f.index());
    faces_.push_back(mesh.halfedge(f));
    face_sources_.push_back(f.index());
  }
  for (const HalfedgeId h : algebra3d::halfedges(mesh))
    halfedges_.push_back(
        {mesh.next(h), mesh.prev(h), mesh.opposite(h), mesh.origin(h), mesh.face(h), h.index(), h.index()});
  blends_ = ElementBlends(mesh);
}

/// The second half-edges of boundary edges. A boundary vertex of a manifold has one that leaves it.
void MeshEditor::add_boundary(const PolygonMesh& mesh) {
  const std::size_t first = halfedges_.size();
  for (const HalfedgeId h : algebra3d::halfedges(mesh)) {
    poll_interruption_at(h.index());
    if (mesh.opposite(h).is_valid()) continue;
    const HalfedgeId beyond(halfedges_.size());
    halfedges_[h.index()].opposite = beyond;
    halfedges_.push_back({{}, {}, h, mesh.target(h), {}, kNone, h.index()});
    vertices_[mesh.target(h).index()].outgoing = beyond;
  }
  for (std::size_t i = first; i < halfedges_.size(); ++i) connect(HalfedgeId(i), outgoing(target(HalfedgeId(i))));
}

PolygonMesh MeshEditor::mesh() const {
  PointArray points;
  points.reserve(vertex_count());
  std::vector<std::uint32_t> numbers(vertices_.size(), kNone);
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (!vertices_[v].is_used) continue;
    numbers[v] = static_cast<std::uint32_t>(points.size());
    points.push_back(points_[v]);
  }
  LargeVector<std::uint32_t> starts, corners;
  starts.reserve(faces_.size() + 1);
  corners.reserve(halfedges_.size());
  for (const HalfedgeId first : faces_) {
    if (!first.is_valid()) continue;
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
    HalfedgeId h = first;
    do {
      corners.push_back(numbers[origin(h).index()]);
      h = next(h);
    } while (h != first);
  }
  starts.push_back(static_cast<std::uint32_t>(corners.size()));
  return {std::move(points), layout_of(std::move(starts)), std::move(corners)};
}

std::size_t MeshEditor::degree(FaceId f) const {
  std::size_t count = 0;
  HalfedgeId h = halfedge(f);
  do {
    ++count;
    h = next(h);
  } while (h != halfedge(f));
  return count;
}

std::size_t MeshEditor::valence(VertexId v) const {
  std::size_t count = 0;
  HalfedgeId h = outgoing(v);
  if (!h.is_valid()) return 0;
  do {
    ++count;
    h = opposite(prev(h));
  } while (h != outgoing(v));
  return count;
}

HalfedgeId MeshEditor::find(VertexId from, VertexId to) const {
  HalfedgeId h = outgoing(from);
  if (!h.is_valid()) return {};
  do {
    if (target(h) == to) return h;
    h = opposite(prev(h));
  } while (h != outgoing(from));
  return {};
}

HalfedgeId MeshEditor::new_edge() {
  const auto take_one = [this] {
    if (free_halfedges_.empty()) {
      halfedges_.emplace_back();
      return HalfedgeId(halfedges_.size() - 1);
    }
    const HalfedgeId h = free_halfedges_.back();
    free_halfedges_.pop_back();
    return h;
  };
  const HalfedgeId h = take_one(), o = take_one();
  halfedges_[h.index()] = {};
  halfedges_[o.index()] = {};
  halfedges_[h.index()].opposite = o;
  halfedges_[o.index()].opposite = h;
  return h;
}

VertexId MeshEditor::new_vertex(const ExactPoint& point, std::uint32_t source) {
  const Vertex vertex{{}, true, source};
  if (free_vertices_.empty()) {
    vertices_.push_back(vertex);
    points_.push_back(point);
    return VertexId(vertices_.size() - 1);
  }
  const VertexId v = free_vertices_.back();
  free_vertices_.pop_back();
  vertices_[v.index()] = vertex;
  points_[v.index()] = point;
  return v;
}

FaceId MeshEditor::new_face(HalfedgeId h, FaceId part_of) {
  const std::uint32_t source = face_sources_[part_of.index()];
  if (free_faces_.empty()) {
    faces_.push_back(h);
    face_sources_.push_back(source);
    return FaceId(faces_.size() - 1);
  }
  const FaceId f = free_faces_.back();
  free_faces_.pop_back();
  faces_[f.index()] = h;
  face_sources_[f.index()] = source;
  return f;
}

void MeshEditor::free_edge(HalfedgeId h) {
  const HalfedgeId o = opposite(h);
  for (const HalfedgeId half : {o, h}) {
    halfedges_[half.index()] = {};
    free_halfedges_.push_back(half);
  }
}

void MeshEditor::connect(HalfedgeId h, HalfedgeId to) {
  halfedges_[h.index()].next = to;
  halfedges_[to.index()].prev = h;
}

void MeshEditor::settle(VertexId v, HalfedgeId any) {
  HalfedgeId h = any;
  do {
    if (is_boundary(h)) break;
    h = opposite(prev(h));
  } while (h != any);
  vertices_[v.index()].outgoing = h;
}

}  // namespace algebra3d
