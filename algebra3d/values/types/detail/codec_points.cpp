#include "algebra3d/values/types/detail/codec_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algebra3d/kernel/exact/point_text.h"
#include "algebra3d/kernel/exact/rational_text.h"
#include "base/interruption_scope.h"
#include "base/large_allocator.h"

namespace algebra3d {
namespace {

// Doubles as integers in the order of the doubles; both zeros are 0. Low bits that are zero stay zero, also in negative
// numbers: so a table of floats or of decimal fractions of a power of two keeps its common trailing zeros.
std::int64_t ordered(double value) {
  const auto bits = std::bit_cast<std::int64_t>(value);
  return bits < 0 ? -(bits & std::numeric_limits<std::int64_t>::max()) : bits;
}

double from_ordered(std::int64_t value) {
  const auto magnitude = static_cast<std::uint64_t>(value < 0 ? -value : value);
  const auto absolute = std::bit_cast<double>(magnitude);
  return value < 0 ? -absolute : absolute;
}

constexpr std::int64_t kLargest = 0x7FEFFFFFFFFFFFFF;  // the largest finite double

bool is_finite_ordered(std::int64_t value) {
  return -kLargest <= value && value <= kLargest;
}

constexpr double kNoCoordinate = std::numeric_limits<double>::quiet_NaN();

/// One axis as the sorted table of its distinct values, and the place of each point's value in the table.
struct RankedAxis {
  std::vector<std::int64_t> table;
  std::vector<std::uint32_t> ranks;
};

RankedAxis rank_axis(const std::vector<Vec3>& points, std::size_t axis) {
  std::vector<std::pair<std::int64_t, std::uint32_t>> values;
  values.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) values.emplace_back(ordered(points[i][axis]), i);
  std::ranges::sort(values, [](const auto& a, const auto& b) {
    poll_interruption();
    return a < b;
  });
  RankedAxis result;
  result.ranks.resize(points.size());
  for (const auto& [value, index] : values) {
    if (result.table.empty() || result.table.back() != value) result.table.push_back(value);
    result.ranks[index] = static_cast<std::uint32_t>(result.table.size() - 1);
  }
  return result;
}

void write_table(ByteWriter& writer, const std::vector<std::int64_t>& table) {
  std::vector<std::uint64_t> steps;
  steps.reserve(table.size() - 1);
  std::uint64_t any = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    // The difference of any two 64-bit integers fits 64 unsigned bits.
    steps.push_back(static_cast<std::uint64_t>(table[i]) - static_cast<std::uint64_t>(table[i - 1]));
    any |= steps.back();
  }
  const int shift = any == 0 ? 0 : std::countr_zero(any);
  for (std::uint64_t& step : steps) step >>= shift;
  writer.varint(table.size());
  writer.f64(from_ordered(table.front()));
  writer.u8(static_cast<std::uint8_t>(shift));
  writer.planes(steps);
}

/// Finds an axis in the bytes.
StoredAxis find_axis(ByteReader& reader, std::size_t point_count) {
  StoredAxis axis;
  const std::uint64_t size = reader.varint();
  if (reader.ok() && (size == 0 || size > point_count))
    reader.fail(fmt::format("a table of 1 to {} values, found {}", point_count, size));
  axis.smallest = reader.f64();
  reader.require(is_finite_ordered(ordered(axis.smallest)), "a finite coordinate");
  axis.shift = reader.u8();
  reader.require(axis.shift < 64, "a shift below 64");
  if (!reader.ok()) return axis;
  axis.table_size = static_cast<std::size_t>(size);
  // A width of zero would claim many values with no bytes: allowed only for the table of one value.
  axis.steps = reader.plane_reader(axis.table_size - 1, size > 1 ? 1 : 0, 8);
  axis.table_end = reader.position();
  axis.places = reader.plane_reader(point_count, 1, 5);
  axis.end = reader.position();
  return axis;
}

std::vector<double> read_table(StoredAxis& axis, ByteReader& reader) {
  std::int64_t value = ordered(axis.smallest);
  std::vector<double> table{from_ordered(value)};
  table.reserve(axis.table_size);
  while (table.size() < axis.table_size) {
    const std::uint64_t step = axis.steps.next();
    const std::uint64_t room = static_cast<std::uint64_t>(kLargest) - static_cast<std::uint64_t>(value);
    if (step == 0 || step > room >> axis.shift) {
      reader.fail_at(axis.table_end, "an ascending table of finite coordinates");
      return {};
    }
    value = static_cast<std::int64_t>(static_cast<std::uint64_t>(value) + (step << axis.shift));
    table.push_back(from_ordered(value));
  }
  return table;
}

void write_axis(ByteWriter& writer, const std::vector<Vec3>& points, std::size_t axis) {
  const RankedAxis ranked = rank_axis(points, axis);
  write_table(writer, ranked.table);
  std::vector<std::uint64_t> steps;
  steps.reserve(ranked.ranks.size());
  std::int64_t previous = 0;
  for (const std::uint32_t rank : ranked.ranks) {
    steps.push_back(zigzag(rank - previous));
    previous = rank;
  }
  writer.planes(steps, 1);
}

/// The points as doubles; the three axes together, so that each point is written once.
std::vector<Vec3> read_doubles(std::array<StoredAxis, 3>& axes, std::size_t size, ByteReader& reader) {
  std::array<std::vector<double>, 3> tables;
  for (std::size_t axis = 0; axis < 3; ++axis) tables[axis] = read_table(axes[axis], reader);
  if (!reader.ok()) return {};
  std::vector<Vec3> points;
  points.reserve(size);
  prefer_huge_pages(points.data(), size * sizeof(Vec3));
  std::array<std::uint64_t, 3> places{};  // modulo 2^64, so that a negative one is too large
  const auto next = [&](std::size_t axis) {
    places[axis] += static_cast<std::uint64_t>(unzigzag(axes[axis].places.next()));
    return places[axis] < tables[axis].size() ? tables[axis][places[axis]] : kNoCoordinate;
  };
  for (std::size_t i = 0; i < size; ++i) {
    const double x = next(0), y = next(1), z = next(2);
    points.push_back({x, y, z});
    if (!std::isnan(x) && !std::isnan(y) && !std::isnan(z)) continue;
    const std::size_t axis = std::isnan(x) ? 0 : std::isnan(y) ? 1 : 2;
    reader.fail_at(axes[axis].end, "a coordinate within its table");
    return {};
  }
  return points;
}

// Any length: the bytes are at hand, and spilled values may be longer than stored ones can be.
std::optional<Rational> parse_rational(std::string_view text) {
  const bool is_plain =
      std::ranges::all_of(text, [](char c) { return ('0' <= c && c <= '9') || c == '/' || c == '-'; });
  return is_plain ? Rational::parse(text) : std::nullopt;
}

bool is_within_digits(std::string_view text) {
  return digit_count(text) <= most_digits;
}

constexpr const char* kFewerDigits = "a number of no more digits than are allowed";

thread_local std::size_t longest_number = 0;

/// The three rationals of a point whose doubles are known: a coordinate that is its double is the empty text.
void write_exact(ByteWriter& writer, const RationalVec3& exact) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (exact[axis].is_double())
      writer.varint(0);
    else
      write_rational(writer, exact[axis]);
  }
}

/// Fails with the defect of a coordinate. False if it has none.
bool tell_defect(ByteReader& reader, std::string_view text, double approx) {
  reader.require(is_within_digits(text), kFewerDigits);
  if (!reader.ok()) return true;
  const auto value = text.empty() ? Rational(approx) : parse_rational(text);
  reader.require(value.has_value(), "a number p/q");
  if (value && !text.empty())
    reader.require(!value->is_double() && value->nearest_double() == approx,
                   "a number that is not a double and rounds to the one stored");
  return !reader.ok();
}

/// The point of three exact coordinates whose roundings are known. No point after a failure.
ExactPoint read_exact(ByteReader& reader, const Vec3& approx) {
  std::array<std::string_view, 3> texts;
  ByteReader behind = reader;
  for (std::string_view& text : texts) text = behind.text();
  const bool is_readable = behind.ok() && std::ranges::all_of(texts, is_within_digits);
  auto point = is_readable ? point_of_texts(texts, approx) : std::nullopt;
  if (point) {
    reader = behind;
    return *std::move(point);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view text = reader.text();
    if (!reader.ok() || tell_defect(reader, text, approx[axis])) return {};
  }
  reader.fail("a coordinate that is not a double");
  return {};
}

void write_exact_table(ByteWriter& writer, const PointArray& points) {
  writer.varint(points.exact_count());
  if (points.exact_count() == 0) return;
  std::uint64_t next = 0;
  for (std::size_t index = 0; index < points.size(); ++index) {
    poll_interruption_at(index);
    if (points[index].is_double()) continue;
    writer.varint(index - next);
    next = index + 1;
    write_exact(writer, points[index].rational());
  }
}

/// Reads the table of exact coordinates and joins it to the doubles.
PointArray read_exact_table(ByteReader& reader, std::vector<Vec3> approx) {
  const std::size_t exact_count = reader.count(5);  // an index, three lengths and a character
  if (!reader.ok()) return {};
  if (exact_count == 0) return PointArray(std::move(approx));
  PointArray points;
  points.reserve(approx.size());
  for (std::size_t i = 0; i < exact_count; ++i) {
    const std::uint64_t skipped = reader.varint();
    reader.require(skipped < approx.size() - points.size(), "the index of a point");
    if (!reader.ok()) return {};
    for (const std::size_t end = points.size() + static_cast<std::size_t>(skipped); points.size() < end;)
      points.push_back(approx[points.size()]);
    const ExactPoint exact = read_exact(reader, approx[points.size()]);
    if (!reader.ok()) return {};
    points.push_back(exact);
  }
  while (points.size() < approx.size()) points.push_back(approx[points.size()]);
  return points;
}

}  // namespace

void write_rational(ByteWriter& writer, const Rational& value) {
  const std::string text = value.text();
  longest_number = std::max(longest_number, digit_count(text));
  writer.text(text);
}

std::size_t take_longest_number() {
  return std::exchange(longest_number, 0);
}

Rational read_rational(ByteReader& reader) {
  const std::string_view text = reader.text();
  reader.require(is_within_digits(text), kFewerDigits);
  const auto value = reader.ok() ? parse_rational(text) : std::nullopt;
  reader.require(value.has_value(), "a number p/q");
  return value.value_or(Rational());
}

void write_point(ByteWriter& writer, const ExactPoint& point) {
  writer.u8(point.is_double() ? 0 : 1);
  for (std::size_t axis = 0; axis < 3; ++axis) writer.f64(point.approx()[axis]);
  if (!point.is_double()) write_exact(writer, point.rational());
}

ExactPoint read_point(ByteReader& reader) {
  const int form = reader.u8();
  reader.require(form <= 1, "0 (doubles) or 1 (rationals)");
  Vec3 approx;
  for (std::size_t axis = 0; axis < 3; ++axis) approx[axis] = reader.f64();
  reader.require(is_finite(approx), "finite coordinates");
  if (!reader.ok()) return {};
  if (form == 0) return approx;
  return read_exact(reader, approx);
}

void write_points(ByteWriter& writer, const PointArray& points) {
  writer.varint(points.size());
  if (points.size() == 0) return;
  for (std::size_t axis = 0; axis < 3; ++axis) write_axis(writer, points.approx(), axis);
  write_exact_table(writer, points);
}

StoredPoints::StoredPoints(ByteReader& reader) {
  size_ = reader.count(3);  // each axis has a byte at least for each point
  reader.require(size_ < std::numeric_limits<std::uint32_t>::max(), "fewer than 2^32 - 1 points");
  if (!reader.ok()) size_ = 0;
  if (size_ == 0) return;
  for (StoredAxis& axis : axes_) axis = find_axis(reader, size_);
  const ByteReader at_exact = reader;
  if (reader.varint() == 0 || !reader.ok()) return;
  reader = at_exact;
  std::vector<Vec3> doubles = read_doubles(axes_, size_, reader);
  if (reader.ok()) exact_ = read_exact_table(reader, std::move(doubles));
}

PointArray StoredPoints::decode(ByteReader& reader) && {
  if (size_ == 0 || !reader.ok()) return {};
  if (exact_) return std::move(*exact_);
  return PointArray(read_doubles(axes_, size_, reader));
}

PointArray read_points(ByteReader& reader) {
  return StoredPoints(reader).decode(reader);
}

}  // namespace algebra3d
