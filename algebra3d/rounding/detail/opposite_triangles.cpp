#include "algebra3d/rounding/detail/opposite_triangles.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/base/id_vector.h"
#include "algebra3d/halfedge/circulators.h"
#include "algebra3d/halfedge/topology.h"

namespace algebra3d {
namespace {

/// A face under its corners, which ascend.
struct SortedFace {
  TriangleMesh::Triangle corners;
  bool is_odd;  // an odd permutation of the face's own corners
  FaceId face;
};

SortedFace sorted_face(const TriangleMesh& mesh, FaceId face) {
  auto [a, b, c] = mesh.triangle(face);
  bool is_odd = false;
  const auto order = [&](std::uint32_t& x, std::uint32_t& y) {
    if (x < y) return;
    std::swap(x, y);
    is_odd = !is_odd;
  };
  order(a, b);
  order(b, c);
  order(a, b);
  return {{a, b, c}, is_odd, face};
}

/// All faces, those with the same corners next to each other.
std::vector<SortedFace> sorted_faces(const TriangleMesh& mesh) {
  std::vector<SortedFace> result;
  result.reserve(mesh.face_count());
  for (const FaceId face : faces(mesh)) result.push_back(sorted_face(mesh, face));
  std::ranges::sort(result, {}, [](const SortedFace& f) { return std::tuple(f.corners, f.face); });
  return result;
}

}  // namespace

TriangleMesh without_opposite_triangles(const TriangleMesh& mesh) {
  IdVector<FaceId, bool> is_cancelled(mesh.face_count());
  std::vector<SortedFace> open;  // faces with the same corners, all of one orientation
  for (const SortedFace& face : sorted_faces(mesh)) {
    if (!open.empty() && open.back().corners != face.corners) open.clear();
    if (!open.empty() && open.back().is_odd != face.is_odd) {
      is_cancelled[open.back().face] = is_cancelled[face.face] = true;
      open.pop_back();
    } else {
      open.push_back(face);
    }
  }
  std::vector<FaceId> kept;
  for (const FaceId face : faces(mesh))
    if (!is_cancelled[face]) kept.push_back(face);
  return submesh(mesh, kept);
}

}  // namespace algebra3d
