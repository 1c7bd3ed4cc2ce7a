#pragma once

#include "algebra3d/geometry/solid.h"

namespace algebra3d {

class Surface3d;  // the value within

/// A surface: triangles that meet in nothing but common corners and whole common edges; may have a boundary, and may be
/// empty. Immutable, exact and shared as a Solid is. Equal means the same points of space.
class Surface {
 public:
  Surface();  ///< the empty surface

  /// Errors: invalid_value, with the defects, if the triangles are no surface; interrupted.
  static Result<Surface> of_triangles(std::span<const Vec3> points,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      const Monitor& monitor = {});
  static Result<Surface> of_bytes(std::string_view bytes);
  static Result<Surface> of_text(std::string_view text);

  bool is_empty() const { return triangle_count() == 0; }
  std::size_t triangle_count() const;
  Box3 box() const;
  double area() const;
  IndexedTriangles triangles() const;
  bool has_fractions() const;

  Result<Surface> translated(const Vec3& by) const;
  Result<Surface> rotated(const Vec3& centre, const Vec3& axis, double degrees) const;
  Result<Surface> scaled(const Vec3& centre, const Vec3& factors) const;
  Result<Surface> mirrored(const Vec3& point, const Vec3& normal) const;

  std::string bytes() const;
  std::string text() const;

  friend bool operator==(const Surface& a, const Surface& b);
  friend std::strong_ordering operator<=>(const Surface& a, const Surface& b);
  std::size_t hash() const;

  /// For the sources of this library.
  explicit Surface(std::shared_ptr<const Surface3d> value) : value_(std::move(value)) {}
  const Surface3d& value() const { return *value_; }

 private:
  std::shared_ptr<const Surface3d> value_;
};

/// The whole boundary of a solid, with its front outside.
Surface boundary(const Solid& solid);
/// The part of the plane through a point that lies in the solid. Errors: invalid_value for a normal of length 0;
/// interrupted.
Result<Surface> section(const Solid& solid, const Vec3& point, const Vec3& normal, const Monitor& monitor = {});

// Triangles are divided at one another, and whole pieces kept; where both lie upon each other, they count once.
Result<Surface> unite(const Surface& a, const Surface& b, const Monitor& monitor = {});
Result<Surface> intersect(const Surface& a, const Surface& b, const Monitor& monitor = {});
Result<Surface> subtract(const Surface& a, const Surface& b, const Monitor& monitor = {});

std::ostream& operator<<(std::ostream& out, const Surface& surface);

}  // namespace algebra3d

template <>
struct std::hash<algebra3d::Surface> {
  std::size_t operator()(const algebra3d::Surface& surface) const { return surface.hash(); }
};
