#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "algebra3d/base/vec3.h"

namespace algebra3d::detail {

/// Three orthogonal unit vectors.
using Frame = std::array<Vec3, 3>;

inline Vec3 unit_vector(const Vec3& v) {
  return 1 / length(v) * v;
}

/// The frame of a direction and another one that is not parallel to it.
inline Frame frame_of(const Vec3& first, const Vec3& second) {
  const Vec3 u = unit_vector(first);
  const Vec3 v = unit_vector(second - dot(second, u) * u);
  return {u, v, cross(u, v)};
}

/// An orthogonal map, given by the rows of its matrix: a rotation, or one after the reflection x -> -x. Rounded.
struct Rotation {
  std::array<Vec3, 3> rows;

  /// The map from one frame to another.
  static Rotation between(const Frame& from, const Frame& to) {
    Rotation result;
    for (std::size_t i = 0; i < 3; ++i) result.rows[i] = to[0][i] * from[0] + to[1][i] * from[1] + to[2][i] * from[2];
    return result;
  }
  Vec3 operator()(const Vec3& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  Rotation inverse() const {
    return {{Vec3{rows[0].x, rows[1].x, rows[2].x}, Vec3{rows[0].y, rows[1].y, rows[2].y},
             Vec3{rows[0].z, rows[1].z, rows[2].z}}};
  }
  bool is_mirrored() const { return dot(cross(rows[0], rows[1]), rows[2]) < 0; }
  double trace() const { return rows[0].x + rows[1].y + rows[2].z; }
};

/// Axis and angle of a rotation; the axis is x if the angle is 0.
struct AxisAngle {
  Vec3 axis;
  double angle_degrees = 0;
};
inline AxisAngle axis_angle(const Rotation& r) {
  const Vec3 twice_sine{r.rows[2].y - r.rows[1].z, r.rows[0].z - r.rows[2].x, r.rows[1].x - r.rows[0].y};
  const double sine = length(twice_sine) / 2, cosine = (r.trace() - 1) / 2;
  const double angle = std::atan2(sine, cosine) * 180 / std::numbers::pi;
  constexpr double kSmall = 0x1p-40;
  if (sine > kSmall) return {unit_vector(twice_sine), angle};
  if (cosine > 0) return {{1, 0, 0}, 0};
  // Half a turn: (R + 1) / 2 is the product of the axis with itself.
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (r.rows[i][i] > r.rows[longest][longest]) longest = i;
  Vec3 column = r.rows[longest];
  column[longest] += 1;
  return {unit_vector(column), 180};
}

}  // namespace algebra3d::detail
