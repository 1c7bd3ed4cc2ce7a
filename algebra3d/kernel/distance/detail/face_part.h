#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "algebra3d/base/vec3.h"
#include "base/wide_vec3.h"

namespace algebra3d::distances {

/// The length, rounded; coordinates must be such that their squares are in range.
template <typename Vector>
auto size_of(const Vector& v) {
  return std::sqrt(dot(v, v));
}

/// A plane through a point; the side to which the normal points is inside.
template <typename Vector>
struct CellSide {
  Vector point, inward;
};

/// A convex part of a triangle, by rounded corners: the exact part has corners within `deviation` of these. Coordinates
/// are below 2. Vector: Vec3 or WideVec3.
template <typename Vector>
struct FacePart {
  using Number = decltype(Vector::x);
  static constexpr std::size_t kMaxCorners = 12;

  std::array<Vector, kMaxCorners> corners;
  std::uint32_t size = 0, depth = 0;  ///< depth: how often it was divided
  Number deviation = 0;

  void add(const Vector& corner) { corners[size++] = corner; }
  std::span<const Vector> corner_span() const { return {corners.data(), size}; }
  /// A point in it.
  Vector centre() const;
  /// Divides it along a plane. False if it has too many corners, or if roundings hide where the plane is. The division
  /// is exact in this sense: the cuts are at shares of the edges, and the exact part has the same ones.
  bool cut(const CellSide<Vector>& side, FacePart& inside, FacePart& outside) const;
  /// Divides it by a line between two corners, a triangle at the middle of its longest edge.
  std::array<FacePart, 2> halves() const;
};

/// True if the line along an edge of one of two convex polygons, seen along `sight`, shows that they are farther apart
/// than `reach`: boxes do not separate slanted needles. The length of `sight` does not matter.
template <typename Vector>
bool are_apart_seen_along(const Vector& sight, std::span<const Vector> first, std::span<const Vector> second,
                          decltype(Vector::x) reach);

extern template struct FacePart<Vec3>;
extern template struct FacePart<WideVec3>;

}  // namespace algebra3d::distances
