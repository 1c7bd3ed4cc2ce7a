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

class Surface;   // surface.h
class Volume3d;  // the value within

/// Triangles over shared points; the outside sees the corners of each counter-clockwise.
struct IndexedTriangles {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A solid: a bounded part of space between closed surfaces of triangles, with any number of bodies and cavities; may
/// be empty. Immutable, and cheap to copy: copies share the triangles. Any number of threads may use one solid.
///
/// Exact: every solid is valid, which is proved where it is made, and corners that set operations make are kept as
/// fractions. Equal means the same points of space, whatever the triangles.
class Solid {
 public:
  Solid();  ///< the empty solid

  /// The box between two opposite corners. Errors: invalid_value if it has no volume.
  static Result<Solid> box(const Vec3& corner, const Vec3& opposite);
  /// A ball of flat triangles, with `corners` of them on each great circle through the poles (createSphere).
  /// Errors: invalid_value for a radius that is not positive, or fewer than 3 corners.
  static Result<Solid> sphere(const Vec3& centre, double radius, int corners);
  /// The solid inside the triangles, which are taken as they are; equal points are joined. Errors: invalid_value, with
  /// the defects, if they do not bound a solid (read_solid in mesh_files.h repairs such); interrupted.
  static Result<Solid> of_triangles(std::span<const Vec3> points,
                                    std::span<const std::array<std::uint32_t, 3>> triangles,
                                    const Monitor& monitor = {});
  /// The solid that `bytes` or `text` was called on. Errors: database_corrupt, database_version; invalid_value.
  static Result<Solid> of_bytes(std::string_view bytes);
  static Result<Solid> of_text(std::string_view text);

  bool is_empty() const { return triangle_count() == 0; }
  std::size_t triangle_count() const;
  std::size_t point_count() const;
  /// The smallest box of doubles around the solid; empty if it is.
  Box3 box() const;
  /// Rounded once from the exact volume. Cost: linear.
  double volume() const;
  /// The exact volume as `p` or `p/q`.
  std::string exact_volume() const;
  /// The area of the boundary, cavities included; the relative error is below 2^-52. Cost: linear.
  double area() const;
  /// Errors: invalid_value for the empty solid. Cost: linear.
  Result<Vec3> centroid() const;
  /// The boundary, each coordinate rounded to the nearest double; see has_fractions.
  IndexedTriangles triangles() const;
  /// True if a coordinate is no double. Rounded, such a boundary may meet itself; `rounded` gives a solid of doubles.
  bool has_fractions() const;

  // Motions. Each coordinate of the image is rounded once, unless that would break the solid; where the solid has
  // fractions and the map is exact, the image is exact. Errors: invalid_value if the image leaves the range of doubles
  // or has no volume.
  Result<Solid> translated(const Vec3& by) const;
  Result<Solid> rotated(const Vec3& centre, const Vec3& axis, double degrees) const;
  Result<Solid> scaled(const Vec3& centre, const Vec3& factors) const;
  Result<Solid> mirrored(const Vec3& point, const Vec3& normal) const;
  /// A solid of doubles near this one. Errors: invalid_value, with the reason, if none was found; interrupted.
  Result<Solid> rounded(const Monitor& monitor = {}) const;

  /// The bodies, each with its cavities. Errors: interrupted.
  Result<std::vector<Solid>> components(const Monitor& monitor = {}) const;

  /// The stored form (docs/file_format.md), and the value list of the language.
  std::string bytes() const;
  std::string text() const;

  friend bool operator==(const Solid& a, const Solid& b);
  /// A total order that agrees with ==. Cost: linear.
  friend std::strong_ordering operator<=>(const Solid& a, const Solid& b);
  std::size_t hash() const;

  /// For the sources of this library.
  explicit Solid(std::shared_ptr<const Volume3d> value) : value_(std::move(value)) {}
  const Volume3d& value() const { return *value_; }

 private:
  std::shared_ptr<const Volume3d> value_;
};

// Set operations, regularised: the results are closed solids without walls inside. Exact for all operands.
// Errors: interrupted; limit_exceeded beyond some 10^9 triangles.
Result<Solid> unite(const Solid& a, const Solid& b, const Monitor& monitor = {});
Result<Solid> unite(std::span<const Solid> solids, const Monitor& monitor = {});
Result<Solid> intersect(const Solid& a, const Solid& b, const Monitor& monitor = {});
/// The common part of one or more solids. Errors: also wrong_usage for none.
Result<Solid> intersect(std::span<const Solid> solids, const Monitor& monitor = {});
Result<Solid> subtract(const Solid& a, const Solid& b, const Monitor& monitor = {});
Result<Solid> symmetric_difference(const Solid& a, const Solid& b, const Monitor& monitor = {});

/// The parts of a solid before and behind the plane through a point; its front is where the normal points.
struct SplitSolid {
  Solid in_front, behind;
};
/// Errors: invalid_value for a normal of length 0; interrupted.
Result<SplitSolid> split(const Solid& solid, const Vec3& point, const Vec3& normal, const Monitor& monitor = {});

std::ostream& operator<<(std::ostream& out, const Solid& solid);

}  // namespace algebra3d

template <>
struct std::hash<algebra3d::Solid> {
  std::size_t operator()(const algebra3d::Solid& solid) const { return solid.hash(); }
};
