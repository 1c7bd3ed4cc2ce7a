#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/vec3.h"

namespace algebra3d {

class Solid;      // solid.h
class Surface;    // surface.h
class Volume3d;   // the content of a Solid; private to the library
class Surface3d;  // the content of a Surface

namespace detail {
struct ShapeAccess;
}

/// Triangles over shared points; the corners of each are counter-clockwise seen from outside.
struct IndexedTriangles {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The common base of Solid and Surface: a point set bounded by or made of triangles. Immutable and cheap to copy:
/// copies share the triangles. Concurrent use is safe.
///
/// Exact: every shape is proved to be valid when it is made, and corners that set operations compute are kept as
/// fractions. Shapes are equal if they are the same point set, whatever the triangles.
///
/// Results do not depend on the rounding mode of the calling thread, which stays as it is.
///
/// Functions that can fail return a Result and do not throw: exhausted memory is the error out_of_memory. The others
/// throw only std::bad_alloc.
template <typename Derived, typename Content>
class Shape {
 public:
  // A moved-from shape keeps its value: moving copies, which costs as much as counting.
  Shape(const Shape&) = default;
  Shape& operator=(const Shape&) = default;
  ~Shape() = default;

  /// Makes a shape of triangles without repair; equal points are welded. Errors: invalid_value, with the defects, if
  /// they are not valid (read_solid and read_surface in mesh_files.h repair meshes); limit_exceeded beyond some 700
  /// million triangles or 2 billion points; interrupted.
  static Result<Derived> of_triangles(std::span<const Vec3> points,
                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                      const Monitor& monitor = {});
  /// Restores a shape from the result of `bytes` or `text`. Errors: database_corrupt, database_version; invalid_value.
  static Result<Derived> of_bytes(std::string_view bytes);
  static Result<Derived> of_text(std::string_view text);

  bool is_empty() const { return triangle_count() == 0; }
  std::size_t triangle_count() const;
  std::size_t point_count() const;
  /// The smallest box of doubles around the shape; empty for the empty shape.
  Box3 box() const;
  /// The area of the triangles; the relative error is below 2^-52. Cost: linear.
  double area() const;
  /// The triangles, each coordinate rounded to the nearest double; see has_fractions.
  IndexedTriangles triangles() const;
  /// True if a coordinate is not a double; the rounded triangles may then intersect.
  bool has_fractions() const;

  // Affine images. Each coordinate of the image is rounded once, unless that would make the shape invalid; if the shape
  // has fractions and the map is exact, the image is exact. Errors: invalid_value if the image is beyond the range of
  // doubles or loses a dimension.
  Result<Derived> translated(const Vec3& by) const;
  Result<Derived> rotated(const Vec3& centre, const Vec3& axis, double degrees) const;
  Result<Derived> scaled(const Vec3& centre, const Vec3& factors) const;
  Result<Derived> mirrored(const Vec3& point, const Vec3& normal) const;

  /// The binary form (docs/file_format.md) and the notation of the query language. Cost: linear.
  std::string bytes() const;
  std::string text() const;
  /// Prints `text`.
  friend std::ostream& operator<<(std::ostream& out, const Derived& shape) { return shape.print(out); }

  friend bool operator==(const Derived& a, const Derived& b) { return a.compare(b) == 0; }
  /// A total order that agrees with ==. Cost: linear.
  friend std::strong_ordering operator<=>(const Derived& a, const Derived& b) { return a.compare(b); }
  std::size_t hash() const;

 protected:
  Shape();  ///< the empty shape
  explicit Shape(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
  const Content& content() const { return *content_; }

 private:
  friend struct detail::ShapeAccess;
  std::strong_ordering compare(const Derived& other) const;
  std::ostream& print(std::ostream& out) const;

  std::shared_ptr<const Content> content_;
};

extern template class Shape<Solid, Volume3d>;
extern template class Shape<Surface, Surface3d>;

}  // namespace algebra3d
