#pragma once

#include "algebra3d/exact/point.h"
#include "algebra3d/types/binary_io.h"

namespace algebra3d {

/// Writes a number as text `p/q` in lowest terms, of any length.
void write_rational(ByteWriter& writer, const Rational& value);
Rational read_rational(ByteReader& reader);
/// Number of digits of the longest number that this thread has written since the last call.
std::size_t take_longest_number();

/// One point: three doubles or three rationals. Reading fails for coordinates that are not finite.
void write_point(ByteWriter& writer, const ExactPoint& point);
ExactPoint read_point(ByteReader& reader);

/// Many points, in order; used by all types with points (docs/file_format.md, "Points"). Cost: n log n for the sorted
/// table of each axis; reading is linear.
void write_points(ByteWriter& writer, const PointArray& points);
PointArray read_points(ByteReader& reader);

}  // namespace algebra3d
