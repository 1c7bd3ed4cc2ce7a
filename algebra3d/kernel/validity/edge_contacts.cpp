#include "algebra3d/kernel/validity/edge_contacts.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/search/boxes.h"

namespace algebra3d {
namespace {

EdgeEnds edge(const TriangleMesh::Triangle& corners, std::size_t i) {
  const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
  return {VertexId(low), VertexId(high)};
}

/// The point in which two segments cross that are known to do so.
ExactPoint crossing(const RationalVec3& a, const RationalVec3& b, const RationalVec3& c, const RationalVec3& d) {
  const RationalVec3 normal = cross(b - a, d - c);
  return ExactPoint(a + (dot(cross(c - a, d - c), normal) / dot(normal, normal)) * (b - a));
}

class EdgeContactSearch {
 public:
  explicit EdgeContactSearch(const TriangleMesh& mesh) : mesh_(mesh) {}

  void look_at(FaceId f, FaceId g) {
    const TriangleMesh::Triangle s = mesh_.triangle(f), t = mesh_.triangle(g);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) look_at(edge(s, i), edge(t, j));
  }

  std::vector<EdgeContact> contacts() const {
    std::vector<EdgeContact> contacts;
    contacts.reserve(points_.size());
    for (const auto& [edges, point] : points_) contacts.push_back({edges.first, edges.second, point});
    return contacts;
  }

 private:
  PointRef place(VertexId vertex) const { return mesh_.points()[vertex.index()]; }
  Box3 box(const EdgeEnds& edge) const { return unite(box_of(place(edge.first)), box_of(place(edge.second))); }

  void look_at(const EdgeEnds& one, const EdgeEnds& other) {
    const auto& [a, b] = one;
    const auto& [c, d] = other;
    if (a == c || a == d || b == c || b == d || !box(one).intersects(box(other))) return;
    const PointRef p = place(a), q = place(b), r = place(c), s = place(d);
    if (intersect_segments(p, q, r, s) != Contact::point) return;
    if (is_on_segment(p, r, s) || is_on_segment(q, r, s) || is_on_segment(r, p, q) || is_on_segment(s, p, q)) return;
    const std::pair edges = std::minmax(one, other);
    if (!points_.contains(edges))
      points_.emplace(edges, crossing(p.rational(), q.rational(), r.rational(), s.rational()));
  }

  const TriangleMesh& mesh_;
  std::map<std::pair<EdgeEnds, EdgeEnds>, ExactPoint> points_;
};

}  // namespace

std::vector<EdgeContact> edge_contacts(const TriangleMesh& mesh, const FacePairs& touching) {
  EdgeContactSearch search(mesh);
  for (const auto& [first, second] : touching) search.look_at(first, second);
  return search.contacts();
}

}  // namespace algebra3d
