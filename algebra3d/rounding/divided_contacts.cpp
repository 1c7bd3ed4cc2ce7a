#include "algebra3d/rounding/divided_contacts.h"

#include <cstddef>
#include <cstdint>

#include "algebra3d/exact/predicates.h"

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

/// Divides the triangle that has the vertex inside or in an edge, or both triangles at that edge. All lie in one plane.
std::vector<Triangle> divided_at(const TriangleMesh& mesh, const std::vector<Triangle>& pieces, std::uint32_t vertex,
                                 const ProjectedTurn& turn) {
  std::vector<Triangle> divided;
  for (const Triangle& piece : pieces) {
    std::array<int, 3> sides{};
    for (std::size_t i = 0; i < 3; ++i)
      sides[i] = turn.sign * orient2d(turn.projection, mesh.points()[piece[i]], mesh.points()[piece[(i + 1) % 3]],
                                      mesh.points()[vertex]);
    if (sides[0] < 0 || sides[1] < 0 || sides[2] < 0) {
      divided.push_back(piece);
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (sides[i] > 0) divided.push_back({piece[i], piece[(i + 1) % 3], vertex});
  }
  return divided;
}

}  // namespace

TriangleMesh divided_at_contacts(const TriangleMesh& mesh, const std::vector<VertexContact>& contacts) {
  if (contacts.empty()) return mesh;
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.face_count() + 2 * contacts.size());
  auto contact = contacts.begin();
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<Triangle> pieces{mesh.triangle(FaceId(f))};
    for (; contact != contacts.end() && contact->face == FaceId(f); ++contact)
      pieces = divided_at(mesh, pieces, static_cast<std::uint32_t>(contact->vertex.index()),
                          dominant_turn(mesh.corners(FaceId(f))));
    triangles.insert(triangles.end(), pieces.begin(), pieces.end());
  }
  return {mesh.points(), triangles};
}

}  // namespace algebra3d
