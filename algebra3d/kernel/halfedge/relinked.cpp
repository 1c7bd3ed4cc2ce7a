#include "algebra3d/kernel/halfedge/relinked.h"

#include <array>
#include <cassert>
#include <utility>

namespace algebra3d {
namespace {

class Relinking {
 public:
  Relinking(const TriangleMesh& before, std::vector<std::uint32_t> was, std::size_t vertex_count,
            std::span<const TriangleMesh::Triangle> triangles)
      : before_(before),
        triangles_(triangles),
        was_(std::move(was)),
        now_(before.face_count(), kNone),
        was_open_(before.vertex_count()),
        is_open_(vertex_count) {
    assert(was_.size() == triangles_.size());
    number_faces();
    find_open_vertices();
  }

  LargeVector<std::uint32_t> origins() const {
    LargeVector<std::uint32_t> result;
    result.reserve(3 * triangles_.size());
    for (const TriangleMesh::Triangle& triangle : triangles_)
      result.insert(result.end(), triangle.begin(), triangle.end());
    return result;
  }

  LargeVector<std::uint32_t> opposites() const {
    LargeVector<std::uint32_t> result(3 * triangles_.size(), TriangleMesh::kUnlinked);
    for (std::uint32_t f = 0; f < triangles_.size(); ++f)
      if (was_[f] != kNone) take_opposites(f, std::span(result).subspan(3 * std::size_t{f}, 3));
    return result;
  }

 private:
  void number_faces();
  void find_open_vertices();
  void take_opposites(std::uint32_t face, std::span<std::uint32_t> opposites) const;

  const TriangleMesh& before_;
  std::span<const TriangleMesh::Triangle> triangles_;
  std::vector<std::uint32_t> was_;  // per triangle
  std::vector<std::uint32_t> now_;  // per face that was
  // Vertices at which something is new, has gone or is not manifold: there everything is linked anew.
  std::vector<bool> was_open_, is_open_;
};

/// A face that is there twice is new the second time.
void Relinking::number_faces() {
  for (std::uint32_t f = 0; f < was_.size(); ++f) {
    if (was_[f] == kNone) continue;
    std::uint32_t& now = now_[was_[f]];
    if (now != kNone)
      was_[f] = kNone;
    else
      now = f;
  }
}

void Relinking::find_open_vertices() {
  for (std::uint32_t f = 0; f < now_.size(); ++f)
    if (now_[f] == kNone)
      for (const std::uint32_t corner : before_.triangle(FaceId(f))) was_open_[corner] = true;
  for (const VertexId vertex : before_.nonmanifold_vertices()) was_open_[vertex.index()] = true;
  for (std::uint32_t f = 0; f < was_.size(); ++f)
    if (was_[f] == kNone)
      for (const std::uint32_t corner : triangles_[f]) is_open_[corner] = true;
}

void Relinking::take_opposites(std::uint32_t face, std::span<std::uint32_t> opposites) const {
  const FaceId old(was_[face]);
  const TriangleMesh::Triangle before = before_.triangle(old);
  std::array<bool, 3> is_settled{};
  for (std::size_t i = 0; i < 3; ++i) is_settled[i] = !was_open_[before[i]] && !is_open_[triangles_[face][i]];
  for (std::uint32_t i = 0; i < 3; ++i) {
    const HalfedgeId opposite = before_.opposite(TriangleMesh::halfedge(old, i));
    if (is_settled[i] && is_settled[(i + 1) % 3] && opposite.is_valid())
      opposites[i] = 3 * now_[TriangleMesh::face(opposite).index()] + opposite.index() % 3;
  }
}

}  // namespace

TriangleMesh relinked(const TriangleMesh& before, std::vector<std::uint32_t> was, PointArray points,
                      std::span<const TriangleMesh::Triangle> triangles, FacePlanes planes) {
  const Relinking relinking(before, std::move(was), points.size(), triangles);
  return {std::move(points), relinking.origins(), relinking.opposites(), std::move(planes)};
}

}  // namespace algebra3d
