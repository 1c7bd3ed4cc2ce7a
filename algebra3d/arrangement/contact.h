#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "algebra3d/arrangement/edge_sides.h"
#include "algebra3d/exact/integer_plane.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {

/// Where in a closed triangle a point lies: in its inside, inside an edge (i: from corner i to the next), or in a
/// corner.
struct Place {
  enum class Kind : std::uint8_t { inside, edge, corner };
  Kind kind = Kind::inside;
  std::uint8_t index = 0;

  friend bool operator==(const Place&, const Place&) = default;
};

/// An end of the common part of two triangles, by its place in each.
struct ContactPoint {
  Place first, second;
  /// True if the place is an edge that lies in the plane of the other triangle: the common part runs along it.
  bool first_runs_along = false, second_runs_along = false;
};

/// The common part of two triangles: nothing, a point, a segment with its two ends, or coplanar triangles, whose common
/// part is not examined any further.
struct TriangleContact {
  static constexpr std::uint8_t kNoEdge = 3;

  bool is_coplanar = false;
  /// The edge of each triangle that lies in the plane of the other one, so that the common part runs along it.
  std::uint8_t first_edge = kNoEdge, second_edge = kNoEdge;
  std::uint8_t count = 0;  ///< of points: 0, 1 or 2
  std::array<ContactPoint, 2> points{};
};

/// A triangle with its plane, if that is known, and with numbers of its corners for EdgeSides.
struct PlaneTriangle {
  TriangleRef corners;
  std::array<std::uint32_t, 3> numbers;
  const IntegerPlane* plane = nullptr;

  NumberedEdge edge(std::size_t i) const {
    const std::size_t j = i == 2 ? 0 : i + 1;
    return {corners[i], corners[j], numbers[i], numbers[j]};
  }
};

/// Neither triangle may be degenerate. Exact: signs of the corners alone, no point is constructed. Cost: three to six
/// calls of orient3d for triangles that do not meet, up to eighteen for those that do.
TriangleContact contact_of(const PlaneTriangle& first, const PlaneTriangle& second, EdgeSides& edge_sides);

/// A triangle seen along an axis, so that points of its plane can be placed in it.
class TriangleInPlane {
 public:
  /// It must not be degenerate.
  explicit TriangleInPlane(const TriangleRef& triangle) : triangle_(triangle), turn_(dominant_turn(triangle)) {}

  /// Nothing if the point of the plane lies outside. Exact. Cost: three orient2d.
  std::optional<Place> place(const PointRef& point) const;

 private:
  TriangleRef triangle_;
  ProjectedTurn turn_;
};

}  // namespace algebra3d::arrangement
