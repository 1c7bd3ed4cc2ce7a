#pragma once

#include <cstdint>

#include "algebra3d/base/error.h"

namespace algebra3d {

// Elementary functions of doubles. Exactness: the double nearest to the true value, computed by MPFR, so that the bits
// do not depend on the C library. Domain: finite arguments. Undefined, with the reason, where the function has no value
// or one beyond the range of doubles. Cost: some microseconds. Angles are in radians.

Maybe<double> square_root(double x);
Maybe<double> exponential(double x);
Maybe<double> natural_logarithm(double x);
Maybe<double> logarithm(double x, double base);
Maybe<double> power(double base, double exponent);

Maybe<double> sine(double angle_radians);
Maybe<double> cosine(double angle_radians);
Maybe<double> tangent(double angle_radians);
Maybe<double> arc_sine(double x);     ///< from -pi/2 to pi/2
Maybe<double> arc_cosine(double x);   ///< from 0 to pi
Maybe<double> arc_tangent(double x);  ///< from -pi/2 to pi/2
/// The angle of the direction (x, y), from -pi to pi; 0 for the zero vector.
Maybe<double> arc_tangent_of_quotient(double y, double x);

double degrees_to_radians(double angle_degrees);
Maybe<double> radians_to_degrees(double angle_radians);
double circle_constant();   ///< pi
double natural_constant();  ///< e

/// Rounds x to `digits` digits after the decimal point (before it, if negative), ties away from zero, and the result to
/// the nearest double.
Maybe<double> rounded_to_digits(double x, std::int64_t digits);

}  // namespace algebra3d
