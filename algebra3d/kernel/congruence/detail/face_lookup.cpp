#include "algebra3d/kernel/congruence/detail/face_lookup.h"

#include <algorithm>

namespace algebra3d::detail {
namespace {

TriangleMesh::Triangle ascending(TriangleMesh::Triangle triangle) {
  std::ranges::sort(triangle);
  return triangle;
}

std::uint64_t hash_of_triangle(const TriangleMesh::Triangle& triangle) {
  return hash_of(triangle[0], triangle[1], triangle[2]);
}

/// So many vertices are looked at for each corner.
constexpr int kMostTried = 32;

}  // namespace

FaceLookup::FaceLookup(const CentredSolid& solid, double tolerance)
    : solid_(solid),
      tolerance_(tolerance),
      vertices_(solid.vertices(), 4 * tolerance),
      faces_(solid.mesh().face_count()) {
  vertices_.insert_all();
  for (std::uint32_t face = 0; face < solid.mesh().face_count(); ++face)
    faces_.insert(hash_of_triangle(ascending(solid.mesh().triangle(FaceId(face)))), face);
}

/// The nearest of those that are tried.
std::optional<std::uint32_t> FaceLookup::vertex_near(const Vec3& place) const {
  std::optional<std::uint32_t> nearest;
  double least = tolerance_;
  int tried = 0;
  vertices_.for_each_near(place, tolerance_, [&](std::uint32_t vertex) {
    const double distance = length(solid_.vertices()[vertex] - place);
    if (distance <= least) {
      least = distance;
      nearest = vertex;
    }
    return ++tried < kMostTried;
  });
  return nearest;
}

bool FaceLookup::has_triangle_near(const std::array<Vec3, 3>& corners) const {
  TriangleMesh::Triangle wanted{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<std::uint32_t> vertex = vertex_near(corners[i]);
    if (!vertex) return false;
    wanted[i] = *vertex;
  }
  wanted = ascending(wanted);
  bool is_found = false;
  faces_.for_each(hash_of_triangle(wanted), [&](std::uint32_t face) {
    is_found = ascending(solid_.mesh().triangle(FaceId(face))) == wanted;
    return !is_found;
  });
  return is_found;
}

}  // namespace algebra3d::detail
