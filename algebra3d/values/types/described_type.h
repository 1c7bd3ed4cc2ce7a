#pragma once

#include <bit>
#include <cassert>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// The base of all types in this folder: a type whose texts and properties are given as data.
class DescribedType : public Type {
 public:
  struct Description {
    std::string_view name;
    std::string_view doc;
    std::string_view notation;
    std::string_view example;
    std::vector<Kind> kinds;
    Storage storage = Storage::bytes;
    bool is_large = false;
    std::string_view summary_unit = {};
    Coordinates coordinates = Coordinates::none;
  };

  std::string_view name() const override { return description_.name; }
  std::string_view doc() const override { return description_.doc; }
  std::string_view notation() const override { return description_.notation; }
  std::string_view example() const override { return description_.example; }
  std::vector<Kind> kinds() const override { return description_.kinds; }
  Storage storage() const override { return description_.storage; }
  bool is_large() const override { return description_.is_large; }
  std::string_view summary_unit() const override { return description_.summary_unit; }
  Coordinates coordinates() const override { return description_.coordinates; }

  /// Types with headers override it; it must not be called for others.
  GeometryHeader header(const Value& /*value*/) const override {
    assert(has_header());
    return {};
  }

 protected:
  explicit DescribedType(Description description) : description_(std::move(description)) {}

  /// The error for a list that is not a value of this type.
  Error expected(std::string_view what, const NestedList& found) const {
    return {ErrorCode::invalid_value, "{}: expected {}, got {}", name(), what, found.print_short()};
  }
  /// The error for bytes that are not a value of this type.
  Error corrupt(std::string_view what) const { return {ErrorCode::database_corrupt, "{}: {}", name(), what}; }
  /// An undefined value; reports the reason with the offending list as its place.
  Value undefined(std::string_view reason, const NestedList& list, Context& context) const {
    context.diagnostics.report_undefined(fmt::format("{}: {}", name(), reason), list.print_short());
    return Value(*this);
  }

 private:
  Description description_;
};

/// Heap size of a value with an object of class T, without the heap memory of the object.
template <typename T>
constexpr std::size_t object_bytes() {
  constexpr std::size_t kAllocation = 32;  // reference count and the allocator's overhead
  return sizeof(T) + kAllocation;
}

/// Order of defined reals, which are never NaN; the two zeros are equal.
inline std::strong_ordering compare_reals(double a, double b) {
  return a < b ? std::strong_ordering::less : a > b ? std::strong_ordering::greater : std::strong_ordering::equal;
}

/// Mixes a word: every bit of it affects every bit of the result.
constexpr std::size_t hash_word(std::uint64_t word) {
  word ^= word >> 30U;
  word *= 0xBF58476D1CE4E5B9U;
  word ^= word >> 27U;
  word *= 0x94D049BB133111EBU;
  return word ^ (word >> 31U);
}
inline std::size_t hash_real(double value) {
  return hash_word(std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value));
}
/// Hash of a sequence, from the hash of its previous elements and that of the next one.
constexpr std::size_t combine_hashes(std::size_t before, std::size_t next) {
  return hash_word(before + 0x9E3779B97F4A7C15U) ^ next;
}

}  // namespace algebra3d
