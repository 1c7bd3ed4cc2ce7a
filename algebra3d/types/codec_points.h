#pragma once

#include "algebra3d/exact/point.h"
#include "algebra3d/types/binary_io.h"

namespace algebra3d {

/// A number as text `p/q` in lowest terms. Any length.
void write_rational(ByteWriter& writer, const Rational& value);
Rational read_rational(ByteReader& reader);
/// The digits of the longest number that this thread has written since the last call.
std::size_t take_longest_number();

/// One point: its three doubles, or its three rationals. Reading fails on coordinates that are not finite.
void write_point(ByteWriter& writer, const ExactPoint& point);
ExactPoint read_point(ByteReader& reader);

/// Many points, the same coder for every type that has them (docs/file_format.md, "Points"). Their order is kept.
/// Cost: n log n for the sorted table of each axis; reading is linear.
void write_points(ByteWriter& writer, const PointArray& points);
PointArray read_points(ByteReader& reader);

}  // namespace algebra3d
