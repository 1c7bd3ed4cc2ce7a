#include "algebra3d/repair/opposite_triangles.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "algebra3d/halfedge/topology.h"

namespace algebra3d {
namespace {

struct Place {
  TriangleMesh::Triangle corners;  // ascending
  bool is_odd;                     // the triangle turns the other way
  std::uint32_t face;
};

Place place_of(const TriangleMesh& mesh, std::uint32_t face) {
  auto [a, b, c] = mesh.triangle(FaceId(face));
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

}  // namespace

TriangleMesh without_opposite_triangles(const TriangleMesh& mesh) {
  std::vector<Place> places;
  places.reserve(mesh.face_count());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) places.push_back(place_of(mesh, face));
  std::ranges::sort(places, {}, [](const Place& p) { return std::tuple(p.corners, p.face); });
  std::vector<bool> is_cancelled(mesh.face_count());
  std::vector<Place> open;  // of one set of corners, all turning the same way
  for (const Place& place : places) {
    if (!open.empty() && open.back().corners != place.corners) open.clear();
    if (!open.empty() && open.back().is_odd != place.is_odd) {
      is_cancelled[open.back().face] = is_cancelled[place.face] = true;
      open.pop_back();
    } else {
      open.push_back(place);
    }
  }
  std::vector<FaceId> kept;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    if (!is_cancelled[face]) kept.emplace_back(face);
  return submesh(mesh, kept);
}

}  // namespace algebra3d
