#pragma once

#include <array>
#include <optional>

#include "algebra3d/exact/plane.h"
#include "algebra3d/exact/point.h"

namespace algebra3d {

/// Exact affine map x -> Mx + t with rational entries.
class AffineMap {
 public:
  static AffineMap translation(const RationalVec3& by);
  /// p + f(x - p), componentwise factors.
  static AffineMap scaling(const RationalVec3& centre, const RationalVec3& factors);
  static AffineMap reflection(const ExactPlane& plane);
  /// Right-handed rotation by `angle_degrees` about the axis through `centre` with direction `axis` (any length, not
  /// zero). A true rotation about exactly that axis, by an angle within 2^-50 rad of the one asked for; multiples of 90
  /// degrees about coordinate axes and of 180 degrees about any axis are exact. The entries come from MPFR, so they do
  /// not depend on the C library. `angle_degrees` is finite. Nothing for a zero axis.
  static std::optional<AffineMap> rotation(const RationalVec3& centre, const RationalVec3& axis, double angle_degrees);

  /// Sign of the determinant: -1 mirrors, 0 flattens.
  int orientation() const;
  /// The exact image.
  RationalVec3 apply(const RationalVec3& point) const;
  /// The exact image, each coordinate rounded once to nearest; infinite where it leaves the range of doubles.
  /// Cost: tens of nanoseconds when a double-double filter decides the rounding, rationals otherwise.
  Vec3 apply_rounded(PointRef point) const;
  /// True if `apply_rounded` loses nothing at this point.
  bool image_is_double(PointRef point, const Vec3& rounded) const;

  const std::array<RationalVec3, 3>& rows() const { return rows_; }
  const RationalVec3& shift() const { return shift_; }

 private:
  AffineMap(std::array<RationalVec3, 3> rows, RationalVec3 shift);

  std::array<RationalVec3, 3> rows_;
  RationalVec3 shift_;
  // Entries as unevaluated sums of two doubles with the error that they leave, for the filter of apply_rounded.
  struct Split {
    double high = 0, low = 0, error = 0;
  };
  std::array<std::array<Split, 4>, 3> split_;
};

}  // namespace algebra3d
