#include "algebra3d/values/types/coordinate_text.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "algebra3d/kernel/exact/rational_text.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

Error expected(std::string_view what, std::string_view expectation, const NestedList& found) {
  return {ErrorCode::invalid_value, "{}: expected {}, got {}", what, expectation, found.print_short()};
}

bool is_triple(const NestedList& list) {
  return list.is_list() && list.elements().size() == 3;
}

bool is_pair(const NestedList& list) {
  return list.is_list() && list.elements().size() == 2;
}

// True if one double is this integer.
bool is_double(std::int64_t integer) {
  const std::uint64_t size =
      integer < 0 ? 0 - static_cast<std::uint64_t>(integer) : static_cast<std::uint64_t>(integer);
  return size == 0 || std::bit_width(size) - std::countr_zero(size) <= std::numeric_limits<double>::digits;
}

// Nothing if no double is the number.
std::optional<double> double_of(const NestedList& atom) {
  if (atom.is_real() && std::isfinite(atom.as_real())) return atom.as_real();
  if (atom.is_int() && is_double(atom.as_int())) return static_cast<double>(atom.as_int());
  return std::nullopt;
}

// Nothing if one of the coordinates is not a double.
std::optional<Vec3> doubles_of(const NestedList& triple) {
  Vec3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto coordinate = double_of(triple.elements()[axis]);
    if (!coordinate) return std::nullopt;
    result[axis] = *coordinate;
  }
  return result;
}

bool is_in_range(const Rational& number) {
  return std::isfinite(number.lower_double()) && std::isfinite(number.upper_double());
}

Result<ExactPoint> point_in_range(const RationalVec3& exact, const NestedList& list, std::string_view what) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!is_in_range(exact[axis])) return expected(what, "coordinates within the range of real", list);
  return ExactPoint(exact);
}

}  // namespace

NestedList coordinate_to_nested(const Rational& number) {
  if (number.is_double()) return NestedList(number.nearest_double());
  auto text = number.text();
  if (number.is_integer()) text += "/1";
  return NestedList::symbol(std::move(text));
}

Result<Rational> coordinate_from_nested(const NestedList& atom, std::string_view what) {
  if (const auto number = double_of(atom)) return Rational(*number);
  if (atom.is_int()) return Rational(atom.as_int());
  if (atom.is_symbol() && atom.as_symbol().find('/') != std::string::npos) {
    if (const std::size_t digits = digit_count(atom.as_symbol()); digits > max_digits_read())
      return Error{ErrorCode::limit_exceeded, "{}: a number has {} digits; at most {} are read and stored", what,
                   digits, max_digits_read()};
    if (auto number = Rational::parse(atom.as_symbol())) return *std::move(number);
  }
  return expected(what, "a number or a fraction p/q", atom);
}

NestedList point_to_nested(PointRef point) {
  poll_interruption();
  if (!point.is_double()) return triple_to_nested(point.rational());
  return NestedList::list(NestedList(point.approx.x), NestedList(point.approx.y), NestedList(point.approx.z));
}

NestedList triple_to_nested(const RationalVec3& triple) {
  return NestedList::list(coordinate_to_nested(triple.x), coordinate_to_nested(triple.y),
                          coordinate_to_nested(triple.z));
}

Result<RationalVec3> triple_from_nested(const NestedList& list, std::string_view what) {
  if (!is_triple(list)) return expected(what, "(x y z)", list);
  A3D_ASSIGN(auto x, coordinate_from_nested(list.elements()[0], what));
  A3D_ASSIGN(auto y, coordinate_from_nested(list.elements()[1], what));
  A3D_ASSIGN(auto z, coordinate_from_nested(list.elements()[2], what));
  return RationalVec3(std::move(x), std::move(y), std::move(z));
}

Result<ExactPoint> point_from_nested(const NestedList& list, std::string_view what) {
  poll_interruption();
  if (is_triple(list)) {
    if (const auto doubles = doubles_of(list)) return ExactPoint(*doubles);
  }
  A3D_ASSIGN(const RationalVec3 exact, triple_from_nested(list, what));
  return point_in_range(exact, list, what);
}

NestedList planar_point_to_nested(PointRef point) {
  poll_interruption();
  if (point.is_double()) return NestedList::list(NestedList(point.approx.x), NestedList(point.approx.y));
  return NestedList::list(coordinate_to_nested(point.coordinate(0)), coordinate_to_nested(point.coordinate(1)));
}

Result<ExactPoint> planar_point_from_nested(const NestedList& list, std::string_view what) {
  poll_interruption();
  if (!is_pair(list)) return expected(what, "(x y)", list);
  const auto x = double_of(list.elements()[0]), y = double_of(list.elements()[1]);
  if (x && y) return ExactPoint(Vec3{*x, *y, 0});
  A3D_ASSIGN(Rational exact_x, coordinate_from_nested(list.elements()[0], what));
  A3D_ASSIGN(Rational exact_y, coordinate_from_nested(list.elements()[1], what));
  return point_in_range(RationalVec3(std::move(exact_x), std::move(exact_y), Rational()), list, what);
}

Result<double> double_from_nested(const NestedList& atom, std::string_view what) {
  if (atom.is_int()) return static_cast<double>(atom.as_int());
  if (const auto number = double_of(atom)) return *number;
  if (const auto whole = whole_number_from_nested(atom)) return *whole;
  return expected(what, "an int or a real", atom);
}

std::optional<double> whole_number_from_nested(const NestedList& atom) {
  if (!atom.is_symbol() || !atom.as_symbol().ends_with("/1")) return std::nullopt;
  const auto number = Rational::parse(atom.as_symbol());
  if (!number || !is_in_range(*number)) return std::nullopt;
  return number->nearest_double();
}

}  // namespace algebra3d
