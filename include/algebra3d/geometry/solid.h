#pragma once

#include <functional>

#include "algebra3d/geometry/shape.h"

namespace algebra3d {

/// A solid: a bounded part of space between closed surfaces of triangles, with any number of bodies and cavities; may
/// be empty. Its triangles are its boundary. Most members are those of Shape.
class Solid : public Shape<Solid, Volume3d> {
 public:
  Solid();  ///< the empty solid

  /// The box between two opposite corners. Errors: invalid_value if it has no volume.
  static Result<Solid> box(const Vec3& corner, const Vec3& opposite);
  using Shape::box;
  /// A polyhedron that approximates a sphere, with `corners` corners on each great circle through the poles
  /// (createSphere). Errors: invalid_value for a radius that is not positive, or fewer than 3 corners.
  static Result<Solid> sphere(const Vec3& centre, double radius, int corners);

  /// The exact volume, rounded once. Cost: linear.
  double volume() const;
  /// The exact volume as `p` or `p/q`.
  std::string exact_volume() const;
  /// The centre of mass. Errors: invalid_value for the empty solid. Cost: linear.
  Result<Vec3> centroid() const;
  /// A solid of doubles near this one. Errors: invalid_value if a coordinate is out of range; interrupted.
  Result<Solid> rounded(const Monitor& monitor = {}) const;
  /// The bodies, each with its cavities. Errors: interrupted.
  Result<std::vector<Solid>> components(const Monitor& monitor = {}) const;

 private:
  friend struct detail::ShapeAccess;
  using Shape::Shape;
};

// Regularised set operations: the results are closed solids without internal faces. Exact for all operands. Errors:
// interrupted; limit_exceeded beyond some 10^9 triangles; internal. These functions write no report of an internal
// error; `text` of the operands gives the constants with which the language repeats the call.
Result<Solid> unite(const Solid& a, const Solid& b, const Monitor& monitor = {});
Result<Solid> unite(std::span<const Solid> solids, const Monitor& monitor = {});
Result<Solid> intersect(const Solid& a, const Solid& b, const Monitor& monitor = {});
/// The intersection of one or more solids. Errors: also wrong_usage for none.
Result<Solid> intersect(std::span<const Solid> solids, const Monitor& monitor = {});
Result<Solid> subtract(const Solid& a, const Solid& b, const Monitor& monitor = {});
Result<Solid> symmetric_difference(const Solid& a, const Solid& b, const Monitor& monitor = {});

/// The parts of a solid in front of and behind a plane; the normal points to the front.
struct SplitSolid {
  Solid in_front, behind;
};
/// Splits a solid at the plane through a point with a normal. Errors: invalid_value for a normal of length 0;
/// interrupted.
Result<SplitSolid> split(const Solid& solid, const Vec3& point, const Vec3& normal, const Monitor& monitor = {});

}  // namespace algebra3d

template <>
struct std::hash<algebra3d::Solid> {
  std::size_t operator()(const algebra3d::Solid& solid) const { return solid.hash(); }
};
