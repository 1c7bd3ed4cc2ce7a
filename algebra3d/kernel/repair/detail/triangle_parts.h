#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"

namespace algebra3d {

/// A triangle with its plane, precomputed for many comparisons.
struct MeasuredTriangle {
  Triangle3 corners;
  OrientedPlane plane;

  explicit MeasuredTriangle(const Triangle3& triangle) : corners(triangle), plane{triangle[0], unit_normal(triangle)} {}
};

/// True if one of the triangles lies in the plane of the other, within the tolerance. Coordinates and tolerance are
/// scaled, in this header.
bool are_coplanar(const MeasuredTriangle& a, const MeasuredTriangle& b, double tolerance);

/// The parts of a triangle that are left while others are subtracted from it, or divide it. Each has a box, so parts
/// that another triangle does not reach cost next to nothing. Rounded.
class TriangleParts {
 public:
  /// One part, the whole. The triangle must outlive this.
  explicit TriangleParts(const MeasuredTriangle& triangle);

  bool is_empty() const { return parts_.empty(); }
  std::size_t size() const { return parts_.size(); }
  double area() const;
  /// Removes the overlap with a coplanar cutter; gives the area that is gone.
  double subtract(const MeasuredTriangle& cutter, double tolerance);
  /// Divides parts at the line along which another triangle crosses or touches the plane, until there are `most` parts.
  void divide_at(const MeasuredTriangle& other, double tolerance, std::size_t most);
  std::vector<ConvexPolygon> polygons() &&;

 private:
  struct Part {
    ConvexPolygon polygon;
    Box3 box;
    double area;

    explicit Part(ConvexPolygon whole);
  };
  /// The sides of a cutter, as planes that look outwards.
  using Sides = std::array<OrientedPlane, 3>;

  std::optional<Sides> sides_of(const MeasuredTriangle& cutter) const;
  static std::optional<std::vector<ConvexPolygon>> rest_of(const ConvexPolygon& polygon, const Sides& sides,
                                                           double tolerance);

  const MeasuredTriangle& triangle_;
  std::vector<Part> parts_;
};

}  // namespace algebra3d
