#include "algebra3d/values/types/bytes.h"

#include <array>
#include <cstdint>
#include <utility>

#include <xxhash.h>

#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/characters.h"
#include "algebra3d/values/types/file_atom.h"
#include "algebra3d/values/types/order_prefix.h"
#include "algebra3d/values/types/value_text.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/text.h"

namespace algebra3d {
namespace {

constexpr std::string_view kHexDigits = "0123456789abcdef";

void append_hex(std::string_view bytes, std::string& text) {
  text.reserve(text.size() + 2 * bytes.size() + 2);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    poll_interruption_at(i);
    const auto byte = static_cast<unsigned char>(bytes[i]);
    text += kHexDigits[byte >> 4U];
    text += kHexDigits[byte & 15U];
  }
}

constexpr unsigned kNoDigit = 16;

/// The value of a hexadecimal digit; kNoDigit for other characters.
unsigned value_of_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10;
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10;
  return kNoDigit;
}

class BytesType final : public DescribedType, public DirectText {
 public:
  BytesType()
      : DescribedType({.name = "bytes",
                       .doc = "Any bytes, such as the content of a file.",
                       .notation = "hexadecimal digits in single quotes, two for each byte",
                       .example = "'89413344'",
                       .kinds = {Kind::data}}) {}

  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    if (is_file_atom(list)) {
      A3D_ASSIGN(std::string content, file_atom_bytes(list, context));
      return Value::of(Bytes{std::move(content)});
    }
    if (!list.is_text()) return expected("hexadecimal digits in single quotes", list);
    auto content = bytes_of_hex(list.as_text());
    if (!content) return std::move(content).error().about(std::string(name()));
    return Value::of(Bytes{*std::move(content)});
  }
  NestedList to_nested(const Value& value) const override { return NestedList::text(hex_digits(content(value))); }

  void append_text(const Value& value, std::string& text) const override {
    text += '\'';
    append_hex(content(value), text);
    text += '\'';
  }

  std::strong_ordering compare(const Value& a, const Value& b) const override { return content(a) <=> content(b); }
  std::size_t hash(const Value& value) const override {
    return XXH3_64bits(content(value).data(), content(value).size());
  }
  std::uint64_t order_prefix(const Value& value) const override { return order_prefix_of(content(value)); }
  std::size_t heap_bytes(const Value& value) const override {
    return object_bytes<Bytes>() + heap_bytes_of(content(value));
  }

  void encode(const Value& value, std::string& bytes) const override { bytes += content(value); }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    return Value::of(Bytes{std::string(bytes)});
  }

 private:
  static const std::string& content(const Value& value) { return value.get<Bytes>().content; }
};

}  // namespace

std::string hex_digits(std::string_view bytes) {
  std::string text;
  append_hex(bytes, text);
  return text;
}

Result<std::string> bytes_of_hex(std::string_view digits) {
  std::size_t at = digits.starts_with("\\x") ? 2 : 0;
  std::string bytes;
  bytes.reserve((digits.size() - at + 1) / 2);
  for (; at < digits.size(); at += 2) {
    poll_interruption_at(at / 2);
    std::array<unsigned, 2> values{};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string_view rest = digits.substr(at + i);
      values.at(i) = rest.empty() ? kNoDigit : value_of_digit(rest.front());
      if (values.at(i) == kNoDigit)
        return Error{ErrorCode::invalid_value, "character {}: found {}, expected a hexadecimal digit", at + i + 1,
                     rest.empty()             ? "the end of the text"
                     : is_blank(rest.front()) ? "white space"
                                              : found_text(rest.substr(0, 1))};
    }
    bytes += static_cast<char>(values[0] << 4U | values[1]);
  }
  return bytes;
}

const Type& TypeOf<Bytes>::type() {
  static const BytesType the_type;
  return the_type;
}

}  // namespace algebra3d
