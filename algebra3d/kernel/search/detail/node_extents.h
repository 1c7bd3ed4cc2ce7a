#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d::node_extents {

/// Nodes of one task.
constexpr std::size_t kNodesPerTask = 1024;

/// Adds a vector whose sign has no meaning, such as the normal of one side of a thin wall.
inline void add_unsigned(Vec3& sum, const Vec3& vector) {
  sum = dot(sum, vector) < 0 ? sum - vector : sum + vector;
}

/// A direction as floats: of length 1 but for rounding, or 0.
using Direction = std::array<float, 3>;

inline Direction direction_along(const Vec3& vector) {
  const double length = std::sqrt(dot(vector, vector));
  if (length == 0) return {};
  const Vec3 unit = (1 / length) * vector;
  return {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)};
}

inline Vec3 vector_of(const Direction& direction) {
  return {direction[0], direction[1], direction[2]};
}

/// An interval of products, which is rounded outward.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  void extend(double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  }
  float rounded_low() const { return std::nextafter(static_cast<float>(low), -std::numeric_limits<float>::infinity()); }
  float rounded_high() const {
    return std::nextafter(static_cast<float>(high), std::numeric_limits<float>::infinity());
  }
};

inline BoxHierarchy::Node node_at(std::size_t level, std::size_t index) {
  return {static_cast<std::uint32_t>(level), static_cast<std::uint32_t>(index)};
}

/// The children of a node.
struct Children {
  BoxHierarchy::Node first;
  std::uint32_t end;

  Children(const BoxHierarchy& hierarchy, BoxHierarchy::Node node)
      : first{node.level - 1, 2 * node.index}, end(std::min(first.index + 2, hierarchy.node_count(first.level))) {}

  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (auto child = first.index; child < end; ++child) visit(BoxHierarchy::Node{first.level, child});
  }
};

}  // namespace algebra3d::node_extents
