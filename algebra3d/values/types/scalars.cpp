#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/coordinate_text.h"

#include <algorithm>
#include <cmath>

#include <xxhash.h>

#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/characters.h"
#include "algebra3d/values/types/file_atom.h"
#include "algebra3d/values/types/order_prefix.h"
#include "algebra3d/values/types/utf8.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

class IntType final : public DescribedType {
 public:
  IntType()
      : DescribedType({.name = "int",
                       .doc = "A whole number of 64 bits with sign.",
                       .notation = "digits with an optional minus",
                       .example = "-17",
                       .kinds = {Kind::data, Kind::numeric},
                       .storage = Storage::integer}) {}

  Result<Value> from_nested(const NestedList& list, Context& /*context*/) const override {
    if (!list.is_int()) return expected("an integer between -9223372036854775808 and 9223372036854775807", list);
    return Value::of(list.as_int());
  }
  NestedList to_nested(const Value& value) const override { return NestedList(value.get<std::int64_t>()); }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return a.get<std::int64_t>() <=> b.get<std::int64_t>();
  }
  std::size_t hash(const Value& value) const override {
    return hash_word(static_cast<std::uint64_t>(value.get<std::int64_t>()));
  }
  std::uint64_t order_prefix(const Value& value) const override { return order_prefix_of(value.get<std::int64_t>()); }
  bool is_whole_in_prefix(std::uint64_t prefix) const override { return prefix != 1; }
  std::size_t heap_bytes(const Value& /*value*/) const override { return 0; }

  void encode(const Value& value, std::string& bytes) const override {
    const std::int64_t number = value.get<std::int64_t>();
    ByteWriter writer(bytes);
    if (number == static_cast<std::int32_t>(number))
      writer.u32(static_cast<std::uint32_t>(number));
    else
      writer.u64(static_cast<std::uint64_t>(number));
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    const bool is_short = bytes.size() <= sizeof(std::uint32_t);
    const std::int64_t value =
        is_short ? static_cast<std::int32_t>(reader.u32()) : static_cast<std::int64_t>(reader.u64());
    reader.require(is_short || value != static_cast<std::int32_t>(value), "a number that does not fit 4 bytes");
    A3D_TRY(reader.finish());
    return Value::of(value);
  }
};

class RealType final : public DescribedType {
 public:
  RealType()
      : DescribedType({.name = "real",
                       .doc = "A finite floating-point number of 64 bits.",
                       .notation = "digits with a point, an exponent or both; an int is accepted",
                       .example = "-1.25e-3",
                       .kinds = {Kind::data, Kind::numeric},
                       .storage = Storage::real}) {}

  Result<Value> from_nested(const NestedList& list, Context& /*context*/) const override {
    if (list.is_int()) return Value::of(static_cast<double>(list.as_int()));
    if (const auto whole = whole_number_from_nested(list)) return Value::of(*whole);
    if (!list.is_real() || !std::isfinite(list.as_real())) return expected("an int or a real", list);
    return Value::of(list.as_real());
  }
  NestedList to_nested(const Value& value) const override { return NestedList(value.get<double>()); }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return compare_reals(a.get<double>(), b.get<double>());
  }
  std::size_t hash(const Value& value) const override { return hash_real(value.get<double>()); }
  std::uint64_t order_prefix(const Value& value) const override { return order_prefix_of(value.get<double>()); }
  bool is_whole_in_prefix(std::uint64_t /*prefix*/) const override { return true; }
  std::size_t heap_bytes(const Value& /*value*/) const override { return 0; }

  void encode(const Value& value, std::string& bytes) const override { ByteWriter(bytes).f64(value.get<double>()); }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    const double value = reader.f64();
    reader.require(std::isfinite(value), "a finite number");
    A3D_TRY(reader.finish());
    return Value::of(value);
  }
};

class BoolType final : public DescribedType {
 public:
  BoolType()
      : DescribedType({.name = "bool",
                       .doc = "A truth value; FALSE comes before TRUE.",
                       .notation = "TRUE or FALSE",
                       .example = "TRUE",
                       .kinds = {Kind::data},
                       .storage = Storage::integer}) {}

  Result<Value> from_nested(const NestedList& list, Context& /*context*/) const override {
    if (!list.is_bool()) return expected("TRUE or FALSE", list);
    return Value::of(list.as_bool());
  }
  NestedList to_nested(const Value& value) const override { return NestedList(value.get<bool>()); }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return a.get<bool>() <=> b.get<bool>();
  }
  std::size_t hash(const Value& value) const override { return hash_word(value.get<bool>() ? 2 : 1); }
  std::uint64_t order_prefix(const Value& value) const override { return order_prefix_of(value.get<bool>()); }
  bool is_whole_in_prefix(std::uint64_t /*prefix*/) const override { return true; }
  std::size_t heap_bytes(const Value& /*value*/) const override { return 0; }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter(bytes).u8(value.get<bool>() ? 1 : 0);
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    const auto value = reader.u8();
    reader.require(value <= 1, "0 or 1");
    A3D_TRY(reader.finish());
    return Value::of(value == 1);
  }
};

// string and text, which are compared with each other, too: the order of bytes, which for UTF-8 is that of the
// characters' numbers.
template <typename T>
class CharactersType final : public DescribedType {
 public:
  explicit CharactersType(Description description) : DescribedType(std::move(description)) {}

  Result<Value> from_nested(const NestedList& list, [[maybe_unused]] Context& context) const override {
    if constexpr (std::is_same_v<T, Text>) {
      if (is_file_atom(list)) {
        A3D_ASSIGN(std::string content, file_atom_content(list, context));
        return Value::of(Text{std::move(content)});
      }
      if (!list.is_text()) return expected("a text in single quotes", list);
      return Value::of(Text{list.as_text()});
    } else {
      if (!list.is_string()) return expected("a string in double quotes", list);
      return Value::of(list.as_string());
    }
  }
  NestedList to_nested(const Value& value) const override {
    if constexpr (std::is_same_v<T, Text>) {
      return NestedList::text(content(value));
    } else {
      return NestedList(content(value));
    }
  }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return characters_of(a) <=> characters_of(b);
  }
  std::size_t hash(const Value& value) const override {
    return XXH3_64bits(content(value).data(), content(value).size());
  }
  std::uint64_t order_prefix(const Value& value) const override { return order_prefix_of(content(value)); }
  std::size_t heap_bytes(const Value& value) const override {
    return object_bytes<T>() + heap_bytes_of(content(value));
  }

  void encode(const Value& value, std::string& bytes) const override { bytes += content(value); }
  Result<Value> decode(std::string_view bytes, bool trusted) const override {
    const auto wrong = trusted ? std::string_view::npos : first_no_text(bytes);
    if (wrong != std::string_view::npos)
      return corrupt(fmt::format("byte {} of the body is {}", wrong, bytes[wrong] == '\0' ? "zero" : "not UTF-8"));
    return Value::of(T{std::string(bytes)});
  }

 private:
  static const std::string& content(const Value& value) {
    if constexpr (std::is_same_v<T, Text>) {
      return value.get<Text>().content;
    } else {
      return value.get<std::string>();
    }
  }
};

}  // namespace

const std::string& characters_of(const Value& value) {
  return &value.type() == &TypeOf<Text>::type() ? value.get<Text>().content : value.get<std::string>();
}

std::strong_ordering compare(std::int64_t integer, double real) {
  constexpr double kBeyond = 0x1p63;
  if (real >= kBeyond) return std::strong_ordering::less;
  if (real < -kBeyond) return std::strong_ordering::greater;
  const double whole = std::trunc(real);
  if (const auto order = integer <=> static_cast<std::int64_t>(whole); order != 0) return order;
  if (real == whole) return std::strong_ordering::equal;
  return real > whole ? std::strong_ordering::less : std::strong_ordering::greater;
}

const Type& TypeOf<std::int64_t>::type() {
  static const IntType the_type;
  return the_type;
}

const Type& TypeOf<double>::type() {
  static const RealType the_type;
  return the_type;
}

const Type& TypeOf<bool>::type() {
  static const BoolType the_type;
  return the_type;
}

const Type& TypeOf<std::string>::type() {
  static const CharactersType<std::string> the_type({.name = "string",
                                                     .doc = "A short text: names and labels.",
                                                     .notation = "characters in double quotes",
                                                     .example = R"("steel")",
                                                     .kinds = {Type::Kind::data},
                                                     .storage = Type::Storage::text});
  return the_type;
}

const Type& TypeOf<Text>::type() {
  static const CharactersType<Text> the_type({.name = "text",
                                              .doc = "A text of any length: file names, descriptions.",
                                              .notation = "characters in single quotes",
                                              .example = "'parts/bracket.stl'",
                                              .kinds = {Type::Kind::data},
                                              .storage = Type::Storage::text});
  return the_type;
}

}  // namespace algebra3d
