#pragma once

#include <array>
#include <optional>

#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/point.h"

namespace algebra3d {

/// An exact affine map x -> Mx + t with rational entries. A value; concurrent calls are safe.
class AffineMap {
 public:
  static AffineMap translation(const RationalVec3& by);
  /// The map x -> p + f(x - p) with componentwise factors.
  static AffineMap scaling(const RationalVec3& centre, const RationalVec3& factors);
  static AffineMap reflection(const ExactPlane& plane);
  /// Right-handed rotation by `angle_degrees` about the axis through `centre` with direction `axis` (any length, not
  /// zero). Domain: any finite angle, reduced exactly by whole turns. Nothing for a zero axis.
  /// Exactness: a true rotation about exactly that axis, by an angle within 2^-50 rad of the one asked for; exact where
  /// the matrix has short rational entries (quarter turns about coordinate axes, half turns about any axis, third turns
  /// about a diagonal of the cube). The entries come from MPFR, so they do not depend on the C library.
  static std::optional<AffineMap> rotation(const RationalVec3& centre, const RationalVec3& axis, double angle_degrees);

  Rational determinant() const;
  /// Sign of the determinant: -1 for a mirroring map, 0 for a singular one.
  int orientation() const { return determinant().sign(); }
  /// A proved lower bound of the factor by which distances grow: at least a third of the best bound, but 0 if the map
  /// is singular or intermediate results leave the range of doubles.
  double least_stretch() const;
  /// True if the entries of the matrix M are dyadic, that is, integers over powers of two: so for translations,
  /// scalings by doubles, and rotations and reflections that map the coordinate axes to each other.
  bool has_dyadic_matrix() const;
  /// The exact image.
  RationalVec3 apply(const RationalVec3& point) const;
  /// The exact image as a point; nothing if it leaves the range of doubles.
  std::optional<ExactPoint> apply(const ExactPoint& point) const;
  /// The image of a plane; positive sides map to positive sides. The map must not be singular.
  ExactPlane apply(const ExactPlane& plane) const;
  /// The exact image, each coordinate rounded once to nearest; infinite where it leaves the range of doubles. Never a
  /// negative zero. Cost: some 50 nanoseconds when a double-double filter decides the rounding, rationals otherwise
  /// (then counted in `exact_counters().big_fallbacks`).
  Vec3 apply_rounded(PointRef point) const;
  /// True if `rounded` is the exact image of this point. Cost: as `apply_rounded`.
  bool image_is_double(PointRef point, const Vec3& rounded) const;
  /// The composition: first this map, then `next`.
  AffineMap then(const AffineMap& next) const;

  const std::array<RationalVec3, 3>& rows() const { return rows_; }
  const RationalVec3& shift() const { return shift_; }

 private:
  AffineMap(std::array<RationalVec3, 3> rows, RationalVec3 shift);

  std::array<RationalVec3, 3> rows_;
  RationalVec3 shift_;
  // An entry for the filter of apply_rounded: the nearest double (and its two halves, whose products are exact), the
  // double nearest to the remainder, and a bound of the rest.
  struct Split {
    double high = 0, high_head = 0, high_tail = 0, low = 0, error = 0;
  };
  struct SplitRow {
    std::array<Split, 4> entries;  // the shift is the last
    bool is_safe = true;           // the filter's range holds all entries
  };
  std::array<SplitRow, 3> split_;

  static SplitRow split(const RationalVec3& row, const Rational& shift);
  friend struct RowFilter;
};

}  // namespace algebra3d
