#pragma once

#include <cstdint>
#include <optional>

#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d {

/// The number r for which the quaternion (1, r a) rotates by `angle_degrees`, right-handed, about an axis a of the
/// given squared length: r = tan(angle / 2) / |a|. Nothing for an odd number of half turns, where the quaternion is (0,
/// a). Domain: a finite angle, a positive length. Exactness: zero exactly for whole turns; otherwise the simplest
/// fraction with a relative error below 2^-51, which is r itself if r is a fraction with terms up to 2^24; the error of
/// the angle is below 2^-50 rad. Does not depend on the C library.
std::optional<Rational> half_angle_ratio(double angle_degrees, const Rational& squared_length);

/// The fraction with the smallest denominator, then the smallest numerator, in the closed interval [low, high]; 0 < low
/// <= high.
Rational simplest_between(const Rational& low, const Rational& high);

struct CirclePoint {
  double cosine, sine;
};
/// The point of the unit circle after `index` of `count` equal steps from (1, 0) towards (0, 1); `count` is not 0.
/// Exactness: each coordinate rounded once to nearest; quarter turns are exact. Does not depend on the C library.
CirclePoint circle_point(std::uint32_t index, std::uint32_t count);

}  // namespace algebra3d
