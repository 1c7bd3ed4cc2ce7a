#include "algebra3d/kernel/validity/contacts.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/validity/detail/intersections.h"
#include "algebra3d/kernel/validity/detail/proved_parts.h"
#include "algebra3d/kernel/validity/face_set.h"

namespace algebra3d {
namespace {

/// True if the point lies in the triangle, which is not degenerate, or in an edge, and is not a corner.
bool is_in(const TriangleRef& triangle, const PointRef& p) {
  if (orient3d(triangle[0], triangle[1], triangle[2], p) != 0) return false;
  const ProjectedTurn turn = dominant_turn(triangle);
  int edges = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = orient2d(turn.projection, triangle[i], triangle[(i + 1) % 3], p);
    if (side == -turn.sign) return false;
    edges += side == 0 ? 1 : 0;
  }
  return edges < 2;
}

/// Adds the contacts of vertices of `other` in `face`.
void add_contacts(const TriangleMesh& mesh, FaceId face, FaceId other, std::vector<VertexContact>& contacts) {
  for (const std::uint32_t v : mesh.triangle(other))
    if (is_in(mesh.corners(face), mesh.points()[v])) contacts.push_back({VertexId(v), face});
}

}  // namespace

Result<FacePairs> touching_faces(const TriangleMesh& mesh, const std::atomic<bool>* cancel) {
  const FaceSet none_known;
  const ProvedParts proved(mesh, none_known);
  BoxHierarchy hierarchy(mesh);
  return for_each_intersection(mesh, proved, hierarchy, cancel, [](FaceId, FaceId) { return true; });
}

std::vector<VertexContact> vertex_contacts(const TriangleMesh& mesh, const FacePairs& touching) {
  std::vector<VertexContact> contacts;
  for (const auto& [first, second] : touching) {
    add_contacts(mesh, first, second, contacts);
    add_contacts(mesh, second, first, contacts);
  }
  std::ranges::sort(contacts, {}, [](const VertexContact& contact) { return std::pair(contact.face, contact.vertex); });
  contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
  return contacts;
}

std::size_t vertex_count_of(const std::vector<VertexContact>& contacts) {
  std::set<VertexId> vertices;
  for (const VertexContact& contact : contacts) vertices.insert(contact.vertex);
  return vertices.size();
}

}  // namespace algebra3d
