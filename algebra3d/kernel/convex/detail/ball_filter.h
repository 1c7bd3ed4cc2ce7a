#pragma once

#include "algebra3d/kernel/exact/point.h"

namespace algebra3d::detail {

/// Squared distances of points from a fixed centre: rounded with a bound of the error, with some 30 digits, and exact.
class CentreDistances {
 public:
  explicit CentreDistances(const RationalVec3& centre);

  /// A number by its nearest double and the nearest double of the rest, with a bound of what is missing.
  struct Estimate {
    double value = 0, rest = 0, error = 0;
  };

  /// About sixteen digits.
  Estimate rough(const PointRef& p) const;
  /// About thirty digits for points of doubles; as `rough` for others.
  Estimate fine(const PointRef& p) const;
  Rational exact(const PointRef& p) const;

 private:
  RationalVec3 centre_;
  Vec3 high_, low_;
};

/// The sign of the first number minus the second, or kUndecided.
int compare(const CentreDistances::Estimate& a, const CentreDistances::Estimate& b);
CentreDistances::Estimate estimate_of(const Rational& number);

}  // namespace algebra3d::detail
