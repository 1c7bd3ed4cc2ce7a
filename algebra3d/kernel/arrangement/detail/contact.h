#pragma once

#include <array>
#include <cstdint>
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

/// The place of a point in a closed triangle: in its inside, inside an edge, or in a corner.
struct Place {
  enum class Kind : std::uint8_t { inside, edge, corner };
  Kind kind = Kind::inside;
  /// The number of the corner (0, 1, 2), or of the edge (the one from that corner to the next).
  std::uint8_t index = 0;

  friend bool operator==(const Place&, const Place&) = default;
};

/// An end of the common part of two triangles, by its place in each.
struct ContactPoint {
  Place first, second;
  /// True if this end lies inside (not at an end of) the edge `first_edge` (`second_edge`) of the TriangleContact. The
  /// whole common part is on that edge then, also if it is a point.
  bool first_runs_along = false, second_runs_along = false;
};

/// The common part of two triangles: nothing, a point, or a segment with its two ends. Of coplanar triangles only is
/// known that they meet.
struct TriangleContact {
  static constexpr std::uint8_t kNoEdge = 3;

  bool is_coplanar = false;  ///< in one plane, with some point in common
  /// The edge of each triangle that lies in the plane of the other one; the common part, if it is a segment or inside
  /// an edge, is on it.
  std::uint8_t first_edge = kNoEdge, second_edge = kNoEdge;
  std::uint8_t count = 0;  ///< of points: 0, 1 or 2
  std::array<ContactPoint, 2> points{};

  bool is_empty() const { return !is_coplanar && count == 0; }
};

/// The common part of two triangles. `first_sides` are the sides of the second one's plane on which the corners of the
/// first one lie, by rounded numbers (PlaneTriangle::rounded_sides): most pairs need nothing else. Exact: signs of the
/// corners alone, no point is constructed. Corners that the two share need no arithmetic. Cost: three to six calls of
/// orient3d for triangles that do not meet, up to eighteen for those that do.
TriangleContact contact_of(const PlaneTriangle& first, const Signs& first_sides, const PlaneTriangle& second,
                           EdgeSides& edge_sides);

/// A triangle seen along an axis, so that points of its plane can be placed in it.
class TriangleInPlane {
 public:
  /// The triangle must not be degenerate.
  explicit TriangleInPlane(const TriangleRef& triangle) : triangle_(triangle), turn_(dominant_turn(triangle)) {}

  /// The place of a point of the triangle's plane; nothing if it lies outside. Exact. Cost: three orient2d.
  std::optional<Place> place(const PointRef& point) const;
  /// The side of the line through the edge from corner i on which a point of the plane lies: 1 towards the triangle, -1
  /// away from it, 0 on the line. Exact.
  int side_of_edge(std::size_t i, const PointRef& point) const;

 private:
  TriangleRef triangle_;
  ProjectedTurn turn_;
};

}  // namespace algebra3d::arrangement
