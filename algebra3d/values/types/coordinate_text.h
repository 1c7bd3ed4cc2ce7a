#pragma once

#include <optional>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/values/types/nested_list.h"

namespace algebra3d {

// Exact coordinates in value lists: a real if the number is a double, else the symbol `p/q` in lowest terms. A whole
// number that is not a double is written `p/1`, since without a denominator it would be read as the nearest double.
// Printed numbers always read back as equal numbers.

/// The number as an atom.
NestedList coordinate_to_nested(const Rational& number);
/// Reads an int, a real or a symbol `p/q` (lowest terms not required). Errors: invalid_value; `what` begins the
/// message.
Result<Rational> coordinate_from_nested(const NestedList& atom, std::string_view what);

/// A triple as the list `(x y z)`.
NestedList point_to_nested(PointRef point);
NestedList triple_to_nested(const RationalVec3& triple);

/// Reads `(x y z)`: three coordinates of any size. Errors: invalid_value; `what` begins the message.
Result<RationalVec3> triple_from_nested(const NestedList& list, std::string_view what);
/// Reads `(x y z)` with coordinates within the range of doubles. Cost: no rationals if all coordinates are ints or
/// reals.
Result<ExactPoint> point_from_nested(const NestedList& list, std::string_view what);

/// Writes and reads points of the plane, as `(x y)`; z is 0.
NestedList planar_point_to_nested(PointRef point);
Result<ExactPoint> planar_point_from_nested(const NestedList& list, std::string_view what);

/// The nearest double of a whole number that is not a double, which the parser returns as `p/1`; nothing for any other
/// atom.
std::optional<double> whole_number_from_nested(const NestedList& atom);

/// Reads an int or a real; a fraction is an error. Errors: invalid_value; `what` begins the message.
Result<double> double_from_nested(const NestedList& atom, std::string_view what);

}  // namespace algebra3d
