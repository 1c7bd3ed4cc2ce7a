#pragma once

#include <array>
#include <optional>

#include "algebra3d/kernel/arrangement/detail/edge_sides.h"
#include "algebra3d/kernel/exact/integer_plane.h"
#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d::arrangement {

/// On which sides of a plane three points lie: -1, 0, 1, or detail::kUndecided where only rounded numbers were asked.
using Signs = std::array<int, 3>;

constexpr bool are_all_on_one_side(const Signs& signs) {
  return (signs[0] == 1 || signs[0] == -1) && signs[0] == signs[1] && signs[0] == signs[2];
}

/// True if some corner is not a triple of doubles.
bool has_exact_corner(const TriangleRef& triangle);

/// A triangle of an operand, with its plane if that is known. The vertices are the keys of EdgeSides. Must not be
/// degenerate. Refers to the plane.
class PlaneTriangle {
 public:
  PlaneTriangle(const TriangleRef& corners, const std::array<InputVertexId, 3>& vertices, const IntegerPlane* plane);

  const TriangleRef& corners() const { return corners_; }
  const PointRef& corner(std::size_t i) const { return corners_[i]; }
  /// The edge from corner i to the next.
  InputEdgeEnds edge(std::size_t i) const {
    const std::size_t j = i == 2 ? 0 : i + 1;
    return {corners_[i], corners_[j], vertices_[i], vertices_[j]};
  }

  /// The sides of the plane on which points lie, as far as rounded numbers decide them. Cost: some nanoseconds.
  Signs rounded_sides(const TriangleRef& points) const;
  /// The side of a point for which rounded numbers do not decide it. Exact.
  int exact_side(const PointRef& point) const;

 private:
  TriangleRef corners_;
  std::array<InputVertexId, 3> vertices_;
  const IntegerPlane* plane_;
  std::array<double, 4> rounded_{};            // of the plane, if that is known
  std::optional<detail::PlaneFilter> filter_;  // if the plane is not known and all corners are doubles
};

}  // namespace algebra3d::arrangement
