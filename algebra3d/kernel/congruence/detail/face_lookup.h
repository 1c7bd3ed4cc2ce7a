#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "algebra3d/kernel/congruence/detail/centred_solid.h"
#include "algebra3d/kernel/congruence/detail/hash_chains.h"
#include "algebra3d/kernel/congruence/detail/point_grid.h"

namespace algebra3d::detail {

/// Finds a triangle of a solid by the places of its corners. Refers to the solid, which must outlive it.
class FaceLookup {
 public:
  FaceLookup(const CentredSolid& solid, double tolerance);

  /// True if the solid has a triangle whose corners are within the tolerance of the given ones, in any order. May be
  /// false where vertices crowd within the tolerance. Cost: constant.
  bool has_triangle_near(const std::array<Vec3, 3>& corners) const;

 private:
  std::optional<std::uint32_t> vertex_near(const Vec3& place) const;

  const CentredSolid& solid_;
  double tolerance_;
  PointGrid vertices_;
  HashChains faces_;
};

}  // namespace algebra3d::detail
