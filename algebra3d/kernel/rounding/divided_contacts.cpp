#include "algebra3d/kernel/rounding/divided_contacts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

/// Divides the triangle that has the vertex inside or in an edge, or both triangles at that edge. All lie in one plane.
std::vector<Triangle> divided_at(const PointArray& points, const std::vector<Triangle>& pieces, std::uint32_t vertex,
                                 const ProjectedTurn& turn) {
  std::vector<Triangle> divided;
  for (const Triangle& piece : pieces) {
    std::array<int, 3> sides{};
    for (std::size_t i = 0; i < 3; ++i)
      sides[i] = turn.sign * orient2d(turn.projection, points[piece[i]], points[piece[(i + 1) % 3]], points[vertex]);
    if (sides[0] < 0 || sides[1] < 0 || sides[2] < 0) {
      divided.push_back(piece);
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (sides[i] > 0) divided.push_back({piece[i], piece[(i + 1) % 3], vertex});
  }
  return divided;
}

/// Contacts ascending by face; the vertices are those of the points, of which the first are the mesh's.
TriangleMesh divided(const TriangleMesh& mesh, PointArray points, const std::vector<VertexContact>& contacts) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.face_count() + 2 * contacts.size());
  auto contact = contacts.begin();
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<Triangle> pieces{mesh.triangle(FaceId(f))};
    for (; contact != contacts.end() && contact->face == FaceId(f); ++contact)
      pieces = divided_at(points, pieces, static_cast<std::uint32_t>(contact->vertex.index()),
                          dominant_turn(mesh.corners(FaceId(f))));
    triangles.insert(triangles.end(), pieces.begin(), pieces.end());
  }
  return {std::move(points), triangles};
}

}  // namespace

TriangleMesh divided_at_contacts(const TriangleMesh& mesh, const std::vector<VertexContact>& contacts) {
  return contacts.empty() ? mesh : divided(mesh, mesh.points(), contacts);
}

bool is_on_grid(const ExactPoint& point, const CoordinateGrid& grid) {
  const Vec3& p = point.approx();
  return point.is_double() && p == Vec3{grid.nearest(p.x), grid.nearest(p.y), grid.nearest(p.z)};
}

TriangleMesh divided_at_edge_contacts(const TriangleMesh& mesh, const std::vector<EdgeContact>& contacts,
                                      const CoordinateGrid& grid) {
  PointArray points = mesh.points();
  std::map<ExactPoint, VertexId> vertices;
  std::map<EdgeEnds, std::set<VertexId>> along_edges;
  for (const EdgeContact& contact : contacts) {
    if (!is_on_grid(contact.point, grid)) continue;
    const auto [entry, is_new] = vertices.try_emplace(contact.point, VertexId(points.size()));
    if (is_new) points.push_back(contact.point);
    for (const EdgeEnds& edge : {contact.first, contact.second}) along_edges[edge].insert(entry->second);
  }
  if (vertices.empty()) return mesh;
  std::vector<VertexContact> at_faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle corners = mesh.triangle(FaceId(f));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
      const auto found = along_edges.find({VertexId(low), VertexId(high)});
      if (found == along_edges.end()) continue;
      for (const VertexId vertex : found->second) at_faces.push_back({vertex, FaceId(f)});
    }
  }
  return divided(mesh, std::move(points), at_faces);
}

}  // namespace algebra3d
