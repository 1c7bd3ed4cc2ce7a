#include "algebra3d/kernel/halfedge/replaced_faces.h"

#include <cstdint>
#include <utility>

#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/relinked.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

class FaceReplacing {
 public:
  FaceReplacing(const TriangleMesh& mesh, const TriangleMesh& added)
      : mesh_(mesh), added_(added), places_(added.vertex_count()), kept_(mesh.vertex_count(), kNone) {}

  TriangleMesh run(const std::vector<bool>& is_removed);

 private:
  std::uint32_t kept_vertex(std::uint32_t vertex);
  std::uint32_t added_vertex(std::uint32_t vertex);

  const TriangleMesh& mesh_;
  const TriangleMesh& added_;
  PointTable places_;                     // of the added faces' vertices
  std::vector<std::uint32_t> of_places_;  // the vertex of the result at each of them
  std::vector<std::uint32_t> kept_;       // the vertex of the result for each of the mesh
  PointArray points_;
};

/// The vertex of the result for one of a face that stays.
std::uint32_t FaceReplacing::kept_vertex(std::uint32_t vertex) {
  std::uint32_t& number = kept_[vertex];
  if (number != kNone) return number;
  number = static_cast<std::uint32_t>(points_.size());
  const PointRef point = mesh_.points()[vertex];
  points_.push_back(point);
  if (const std::uint32_t place = places_.find(point); place != kNone) of_places_[place] = number;
  return number;
}

std::uint32_t FaceReplacing::added_vertex(std::uint32_t vertex) {
  const PointRef point = added_.points()[vertex];
  std::uint32_t& number = of_places_[places_.find(point)];
  if (number == kNone) {
    number = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
  }
  return number;
}

TriangleMesh FaceReplacing::run(const std::vector<bool>& is_removed) {
  for (std::size_t v = 0; v < added_.vertex_count(); ++v) places_.intern(added_.points()[v]);
  of_places_.assign(places_.size(), kNone);
  std::vector<TriangleMesh::Triangle> triangles;
  std::vector<std::uint32_t> was;
  triangles.reserve(mesh_.face_count() + added_.face_count());
  was.reserve(triangles.capacity());
  points_.reserve(mesh_.vertex_count() + places_.size());
  for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
    poll_interruption_at(f);
    if (is_removed[f]) continue;
    const auto [a, b, c] = mesh_.triangle(FaceId(f));
    triangles.push_back({kept_vertex(a), kept_vertex(b), kept_vertex(c)});
    was.push_back(f);
  }
  for (std::uint32_t f = 0; f < added_.face_count(); ++f) {
    poll_interruption_at(f);
    const auto [a, b, c] = added_.triangle(FaceId(f));
    triangles.push_back({added_vertex(a), added_vertex(b), added_vertex(c)});
    was.push_back(kNone);
  }
  return relinked(mesh_, std::move(was), std::move(points_), triangles);
}

}  // namespace

TriangleMesh with_replaced_faces(const TriangleMesh& mesh, const std::vector<bool>& is_removed,
                                 const TriangleMesh& added) {
  return FaceReplacing(mesh, added).run(is_removed);
}

}  // namespace algebra3d
