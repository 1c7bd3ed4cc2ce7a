#pragma once

#include <array>
#include <optional>

#include "algebra3d/exact/plane.h"
#include "algebra3d/exact/point.h"

namespace algebra3d {

/// Exact affine map x -> Mx + t with rational entries. A value; calls on one map may run in parallel.
class AffineMap {
 public:
  static AffineMap translation(const RationalVec3& by);
  /// p + f(x - p), componentwise factors.
  static AffineMap scaling(const RationalVec3& centre, const RationalVec3& factors);
  static AffineMap reflection(const ExactPlane& plane);
  /// Right-handed rotation by `angle_degrees` about the axis through `centre` with direction `axis` (any length, not
  /// zero). Domain: any finite angle, reduced exactly by whole turns. Nothing for a zero axis.
  /// Exactness: a true rotation about exactly that axis, by an angle within 2^-50 rad of the one asked for; exact where
  /// the matrix has short rational entries (quarter turns about coordinate axes, half turns about any axis, third turns
  /// about a diagonal of the cube). The entries come from MPFR, so they do not depend on the C library.
  static std::optional<AffineMap> rotation(const RationalVec3& centre, const RationalVec3& axis, double angle_degrees);

  Rational determinant() const;
  /// Sign of the determinant: -1 mirrors, 0 flattens.
  int orientation() const { return determinant().sign(); }
  /// A factor s such that images of points are at least s times as far apart as the points: at least a third of the
  /// largest such factor, but 0 if the map flattens or intermediate results leave the range of doubles. It is proved.
  double least_stretch() const;
  /// True if the entries of the matrix M are dyadic: integers over powers of two. This is so for every translation and
  /// every scaling by doubles. Of rotations and reflections it is so for those that map the coordinate axes to each
  /// other: quarter turns about them and what these make together, reflections in planes whose normal is parallel to an
  /// axis or halves the angle between two.
  bool has_dyadic_matrix() const;
  /// The exact image.
  RationalVec3 apply(const RationalVec3& point) const;
  /// The exact image as a point; nothing if it leaves the range of doubles.
  std::optional<ExactPoint> apply(const ExactPoint& point) const;
  /// The image of a plane, with the image of its positive side on its positive side. The map must not flatten.
  ExactPlane apply(const ExactPlane& plane) const;
  /// The exact image, each coordinate rounded once to nearest; infinite where it leaves the range of doubles. Never a
  /// negative zero. Cost: some 50 nanoseconds when a double-double filter decides the rounding, rationals otherwise
  /// (then counted in `exact_counters().big_fallbacks`).
  Vec3 apply_rounded(PointRef point) const;
  /// True if `rounded` is the exact image of this point. Cost: as `apply_rounded`.
  bool image_is_double(PointRef point, const Vec3& rounded) const;
  /// First this map, then `next`.
  AffineMap then(const AffineMap& next) const;

  const std::array<RationalVec3, 3>& rows() const { return rows_; }
  const RationalVec3& shift() const { return shift_; }

 private:
  AffineMap(std::array<RationalVec3, 3> rows, RationalVec3 shift);

  std::array<RationalVec3, 3> rows_;
  RationalVec3 shift_;
  // An entry for the filter of apply_rounded: nearest double (and its halves, products of which are exact), the double
  // nearest to what that leaves, and what both leave at most.
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
