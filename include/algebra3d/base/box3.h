#pragma once

#include <limits>
#include <span>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// A closed axis-parallel box. Touching counts as intersecting. The default box is empty (min above max on every axis)
/// and is the neutral element of `unite`. Boxes around exact coordinates are rounded outward.
struct Box3 {
  Vec3 min{kInfinity, kInfinity, kInfinity};
  Vec3 max{-kInfinity, -kInfinity, -kInfinity};

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  static Box3 of(const Vec3& point) { return {point, point}; }
  /// Smallest box around all points; empty without any.
  static Box3 around(std::span<const Vec3> points);

  bool is_empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  bool intersects(const Box3& other) const {
    return min.x <= other.max.x && other.min.x <= max.x && min.y <= other.max.y && other.min.y <= max.y &&
           min.z <= other.max.z && other.min.z <= max.z;
  }
  bool contains(const Vec3& p) const {
    return min.x <= p.x && p.x <= max.x && min.y <= p.y && p.y <= max.y && min.z <= p.z && p.z <= max.z;
  }
  /// True if this box contains every point of `other`; every box contains the empty box.
  bool contains(const Box3& other) const { return other.is_empty() || (contains(other.min) && contains(other.max)); }

  void extend(const Vec3& point);
  void extend(const Box3& other);

  friend bool operator==(const Box3&, const Box3&) = default;
};

/// Smallest box around both.
Box3 unite(const Box3& a, const Box3& b);
/// Intersection; empty if they do not meet.
Box3 intersect(const Box3& a, const Box3& b);
/// Smallest Euclidean distance between points of the boxes; 0 if they meet. Both must not be empty. Rounded.
double distance(const Box3& a, const Box3& b);
/// Square of `distance`, for comparisons.
double squared_distance(const Box3& a, const Box3& b);

/// A unit of length for the content of the box: a power of two near half of its longest side, from 2^-1070 to 2^1020.
/// The box must not be empty.
double length_unit(const Box3& box);

/// Prints the smallest and the largest corner, `((0.0 0.0 0.0) (1.0 1.0 1.0))`.
std::ostream& operator<<(std::ostream& out, const Box3& box);

}  // namespace algebra3d

template <>
struct std::hash<algebra3d::Box3> {
  std::size_t operator()(const algebra3d::Box3& box) const {
    const std::hash<algebra3d::Vec3> hash_of;
    return hash_of(box.min) * 31 + hash_of(box.max);
  }
};
