#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "algebra3d/kernel/halfedge/detail/angles.h"
#include "algebra3d/kernel/halfedge/detail/corner_weights.h"
#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

/// Normals as sums of the normals of faces, weighted by the angles of their corners.
namespace algebra3d::detail {

/// A vector of any size brought to the length 1; the zero vector stays.
inline Vec3 direction(const Vec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0) return v;
  const Vec3 scaled{v.x / largest, v.y / largest, v.z / largest};
  const double size = std::sqrt(dot(scaled, scaled));
  return {scaled.x / size, scaled.y / size, scaled.z / size};
}

/// A corner as the direction (cosine, sine), up to a factor, from which its angle is computed; sine >= 0.
struct CornerDirection {
  double sine = 0, cosine = 0;
  bool is_reflex = false;

  /// Between two edges, in a face with this normal if that has more than three corners.
  CornerDirection(const Vec3& u, const Vec3& v, const Vec3* normal) {
    const Vec3 turn = cross(u, v);
    sine = std::sqrt(dot(turn, turn));
    cosine = dot(u, v);
    is_reflex = normal != nullptr && dot(turn, *normal) < 0;
  }
  bool is_in_range() const {
    const double size = sine + std::abs(cosine);
    return size > 0x1p-450 && size < 0x1p450;
  }
};

inline double with_reflex(double angle, bool is_reflex) {
  return is_reflex ? 2 * std::numbers::pi - angle : angle;
}

/// The direction of the corner that `h` leaves, of any size.
template <typename Layout>
CornerDirection corner_direction(const HalfedgeMesh<Layout>& mesh, HalfedgeId h, const Vec3& face_normal) {
  const std::vector<Vec3>& points = mesh.points().approx();
  const Vec3& corner = points[mesh.origin(h).index()];
  const Vec3 &next = points[mesh.target(h).index()], &before = points[mesh.origin(mesh.prev(h)).index()];
  const Vec3* normal = mesh.degree(mesh.face(h)) > 3 ? &face_normal : nullptr;
  const CornerDirection plain(next - corner, before - corner, normal);
  if (plain.is_in_range()) return plain;
  // Differences of the largest doubles are beyond their range.
  const double scale = plain.sine + std::abs(plain.cosine) < 1 ? 1 : 0.25;
  return {direction(scale * next - scale * corner), direction(scale * before - scale * corner), normal};
}

/// The angle of the corner that `h` leaves, in a face with this normal: more than pi at a reflex corner.
template <typename Layout>
double corner_angle(const HalfedgeMesh<Layout>& mesh, HalfedgeId h, const Vec3& normal) {
  const CornerDirection corner = corner_direction(mesh, h, normal);
  return with_reflex(angle_of_direction(corner.sine, corner.cosine), corner.is_reflex);
}

/// Vertices of a parallel task.
inline constexpr std::size_t kVerticesPerTask = 10000;

inline std::size_t vertex_task_count(std::size_t vertex_count) {
  return (vertex_count + kVerticesPerTask - 1) / kVerticesPerTask;
}

}  // namespace algebra3d::detail
