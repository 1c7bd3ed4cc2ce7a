#include "algebra3d/kernel/rounding/detail/paired_faces.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "base/disjoint_sets.h"
#include "base/wide_vec3.h"

namespace algebra3d {
namespace {

/// The normal of a face of length 1; zero if the face has none.
WideVec3 normal_of(const TriangleMesh& mesh, FaceId face) {
  const TriangleRef corners = mesh.corners(face);
  const WideVec3 a(corners[0].approx), b(corners[1].approx), c(corners[2].approx);
  const WideVec3 normal = cross(b - a, c - a);
  const long double size = length(normal);
  return size > 0 ? (1 / size) * normal : WideVec3();
}

/// The corners of all faces, each by the half-edge that leaves it, in sets that are to be one vertex.
class FaceLinks {
 public:
  explicit FaceLinks(const TriangleMesh& mesh) : mesh_(mesh), sets_(mesh.halfedge_count()) {}

  /// Links two faces along an edge, given by half-edges that run along it in both directions.
  void link(HalfedgeId one, HalfedgeId other) {
    sets_.unite(one.index(), TriangleMesh::next(other).index());
    sets_.unite(TriangleMesh::next(one).index(), other.index());
  }
  void link_most_alike(std::span<const HalfedgeId> edge);
  TriangleMesh mesh();

 private:
  const TriangleMesh& mesh_;
  DisjointSets sets_;
};

void FaceLinks::link_most_alike(std::span<const HalfedgeId> edge) {
  struct Side {
    HalfedgeId halfedge;
    WideVec3 normal;
  };
  std::vector<Side> forth, back;
  for (const HalfedgeId h : edge) {
    const bool runs_forth = mesh_.origin(h) == mesh_.origin(edge.front());
    (runs_forth ? forth : back).push_back({h, normal_of(mesh_, TriangleMesh::face(h))});
  }
  while (!forth.empty() && !back.empty()) {
    auto best = std::pair(forth.begin(), back.begin());
    for (auto one = forth.begin(); one != forth.end(); ++one)
      for (auto other = back.begin(); other != back.end(); ++other)
        if (dot(one->normal, other->normal) > dot(best.first->normal, best.second->normal)) best = {one, other};
    link(best.first->halfedge, best.second->halfedge);
    forth.erase(best.first);
    back.erase(best.second);
  }
}

TriangleMesh FaceLinks::mesh() {
  std::vector<std::uint32_t> vertex_of(mesh_.halfedge_count(), kNone);  // per set, at its representative
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles(mesh_.face_count());
  for (const FaceId face : faces(mesh_)) {
    const TriangleMesh::Triangle corners = mesh_.triangle(face);
    HalfedgeId h = TriangleMesh::halfedge(face);
    for (std::size_t i = 0; i < 3; ++i, h = TriangleMesh::next(h)) {
      std::uint32_t& vertex = vertex_of[sets_.find(h.index())];
      if (vertex == kNone) {
        vertex = static_cast<std::uint32_t>(points.size());
        points.push_back(mesh_.points().approx()[corners[i]]);
      }
      triangles[face.index()][i] = vertex;
    }
  }
  return {PointArray(std::move(points)), triangles};
}

}  // namespace

TriangleMesh with_paired_faces(const TriangleMesh& mesh) {
  FaceLinks links(mesh);
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i)
    if (const HalfedgeId opposite = mesh.opposite(HalfedgeId(i)); opposite.is_valid() && opposite.index() > i)
      links.link(HalfedgeId(i), opposite);
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) links.link_most_alike(mesh.nonmanifold_edge(n));
  return links.mesh();
}

}  // namespace algebra3d
