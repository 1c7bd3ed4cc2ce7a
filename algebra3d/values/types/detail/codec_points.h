#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/values/types/binary_io.h"

namespace algebra3d {

/// Writes a number as text `p/q` in lowest terms, of any length.
void write_rational(ByteWriter& writer, const Rational& value);
Rational read_rational(ByteReader& reader);
/// Number of digits of the longest number that this thread has written since the last call.
std::size_t take_longest_number();
/// The most digits of a number that this thread reads.
inline thread_local std::size_t most_digits = std::numeric_limits<std::size_t>::max();

/// One point: three doubles or three rationals. Reading fails for coordinates that are not finite.
void write_point(ByteWriter& writer, const ExactPoint& point);
ExactPoint read_point(ByteReader& reader);

/// Many points, in order; used by all types with points (docs/file_format.md, "Points"). Cost: n log n for the sorted
/// table of each axis; reading is linear.
void write_points(ByteWriter& writer, const PointArray& points);
PointArray read_points(ByteReader& reader);

/// One axis of many points, in the bytes.
struct StoredAxis {
  double smallest = 0;
  int shift = 0;
  std::size_t table_size = 0;
  PlaneReader steps, places;
  std::size_t table_end = 0, end = 0;  ///< positions in the bytes, for messages
};

/// The points of write_points, found in the bytes but not decoded, so that the following data can be decoded at the
/// same time. Points that are not triples of doubles are decoded at once.
class StoredPoints {
 public:
  /// Moves the reader behind the points.
  explicit StoredPoints(ByteReader& reader);

  std::size_t size() const { return size_; }
  /// Decodes the points, once. `reader` only gets the failure, if there is one; then there are no points.
  PointArray decode(ByteReader& reader) &&;

 private:
  std::size_t size_ = 0;
  std::array<StoredAxis, 3> axes_;
  std::optional<PointArray> exact_;
};

}  // namespace algebra3d
