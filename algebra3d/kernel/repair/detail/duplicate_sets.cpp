#include "algebra3d/kernel/repair/detail/duplicate_sets.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"

namespace algebra3d {
namespace {

/// Faces with the same corners have all edges in common. So either one of these edges is non-manifold, or the same face
/// is across all three.
bool may_have_duplicate(const TriangleMesh& mesh, FaceId face) {
  const auto h = halfedges_of(mesh, face);
  if (std::ranges::any_of(h, [&](HalfedgeId edge) { return mesh.is_nonmanifold(edge); })) return true;
  const HalfedgeId a = mesh.opposite(h[0]), b = mesh.opposite(h[1]), c = mesh.opposite(h[2]);
  if (!a.is_valid() || !b.is_valid() || !c.is_valid()) return false;
  return TriangleMesh::face(a) == TriangleMesh::face(b) && TriangleMesh::face(b) == TriangleMesh::face(c);
}

/// A face under its corners, which ascend.
using CornersAndFace = std::pair<TriangleMesh::Triangle, FaceId>;

std::vector<CornersAndFace> candidates(const TriangleMesh& mesh) {
  std::vector<CornersAndFace> result;
  for (const FaceId face : faces(mesh)) {
    if (!may_have_duplicate(mesh, face)) continue;
    TriangleMesh::Triangle corners = mesh.triangle(face);
    std::ranges::sort(corners);
    result.emplace_back(corners, face);
  }
  std::ranges::sort(result);
  return result;
}

}  // namespace

bool is_even(const TriangleMesh::Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return (a < b) + (b < c) + (c < a) == 2;
}

DuplicateSets duplicate_sets(const TriangleMesh& mesh) {
  const std::vector<CornersAndFace> all = candidates(mesh);
  DuplicateSets result;
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    while (last < all.size() && all[last].first == all[first].first) ++last;
    if (last - first < 2) continue;
    DuplicateSet set;
    for (std::size_t i = first; i < last; ++i) {
      set.triangles.push_back(all[i].second);
      set.balance += is_even(mesh.triangle(all[i].second)) ? 1 : -1;
    }
    result.push_back(std::move(set));
  }
  return result;
}

}  // namespace algebra3d
