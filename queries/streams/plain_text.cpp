#include "queries/streams/plain_text.h"

#include <algorithm>
#include <optional>
#include <string>

#include "algebra3d/values/types/utf8.h"
#include "base/number_text.h"
#include "base/text.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::NestedList;
using algebra3d::Result;
using algebra3d::Type;

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t skip_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// The parts of a number as it is written.
struct NumberShape {
  std::string_view whole;     ///< the digits before the point
  bool has_fraction = false;  ///< a point
  bool has_exponent = false;
  bool has_digits = false;  ///< before or behind the point
};

std::optional<NumberShape> number_shape(std::string_view text) {
  NumberShape shape;
  const std::size_t begin = text.starts_with('-') ? 1 : 0;
  std::size_t at = skip_digits(text, begin);
  shape.whole = text.substr(begin, at - begin);
  shape.has_digits = !shape.whole.empty();
  if (at < text.size() && text[at] == '.') {
    const std::size_t end = skip_digits(text, at + 1);
    shape.has_fraction = true;
    shape.has_digits = shape.has_digits || end > at + 1;
    at = end;
  }
  if (shape.has_digits && at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    const std::size_t sign = at + 1 < text.size() && (text[at + 1] == '+' || text[at + 1] == '-') ? 1 : 0;
    const std::size_t end = skip_digits(text, at + 1 + sign);
    if (end == at + 1 + sign) return std::nullopt;
    shape.has_exponent = true;
    at = end;
  }
  if (at != text.size() || !shape.has_digits) return std::nullopt;
  return shape;
}

/// The shape of a number; nothing if the number would lose zeros.
std::optional<NumberShape> plain_number_shape(std::string_view text) {
  auto shape = number_shape(text);
  if (shape && shape->whole.size() > 1 && shape->whole.front() == '0') return std::nullopt;
  return shape;
}

std::optional<bool> parse_bool(std::string_view text) {
  if (text == "TRUE" || text == "true" || text == "True") return true;
  if (text == "FALSE" || text == "false" || text == "False") return false;
  return std::nullopt;
}

Error expected(std::string_view what, std::string_view text) {
  return {ErrorCode::invalid_value, "expected {}, found {}", what, quoted_excerpt(text)};
}

Result<NestedList> number_list(bool is_int, std::string_view text) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const bool has_two_signs = digits.size() < text.size() && digits.starts_with('-');
  if (is_int) {
    const auto number = algebra3d::parse_int(digits);
    if (!number || has_two_signs) return expected("an int", text);
    return NestedList(*number);
  }
  const auto number = algebra3d::parse_real(digits);
  if (!number || has_two_signs) return expected("a real", text);
  return NestedList(*number);
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

std::string quoted_excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  const std::string_view kept = algebra3d::utf8_prefix(text, kLongest);
  return fmt::format("\"{}{}\"", algebra3d::one_line(kept), kept.size() < text.size() ? "..." : "");
}

PlainKind plain_kind(std::string_view text) {
  text = without_blanks(text);
  if (parse_bool(text)) return PlainKind::boolean;
  const auto shape = plain_number_shape(text);
  if (!shape) return PlainKind::text;
  if (!shape->has_fraction && !shape->has_exponent && text != "-0")
    return algebra3d::parse_int(text) ? PlainKind::integer : PlainKind::text;
  return algebra3d::parse_real(text) ? PlainKind::real : PlainKind::text;
}

bool is_number_beyond_range(std::string_view text) {
  return plain_number_shape(without_blanks(text)) && plain_kind(text) == PlainKind::text;
}

Result<NestedList> list_of_text(const Type& type, std::string_view text) {
  const std::string_view name = type.name();
  if (name == "text") return NestedList::text(std::string(text));
  if (name == "string") return NestedList(std::string(text));
  text = without_blanks(text);
  if (text == "undefined") return NestedList::symbol("undefined");
  if (name == "bytes") return NestedList::text(std::string(text));
  if (name == "int" || name == "real") return number_list(name == "int", text);
  if (name == "bool") {
    const auto value = parse_bool(text);
    if (!value) return expected("TRUE or FALSE", text);
    return NestedList(*value);
  }
  if (type.example().starts_with('"')) return NestedList(std::string(text));
  auto list = NestedList::parse(text);
  if (!list) return expected(fmt::format("{} ({})", type.notation(), list.error().text()), text);
  return list;
}

}  // namespace queries
