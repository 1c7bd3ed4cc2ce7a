#pragma once

#include <bit>
#include <cassert>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/types/value.h"

namespace algebra3d {

/// A type whose texts and properties are given as data. Each type of this folder derives from it in its own source.
class DescribedType : public Type {
 public:
  struct Description {
    std::string_view name;
    std::string_view doc;
    std::string_view notation;
    std::string_view example;
    std::vector<Kind> kinds;
    Storage storage = Storage::bytes;
  };

  std::string_view name() const override { return description_.name; }
  std::string_view doc() const override { return description_.doc; }
  std::string_view notation() const override { return description_.notation; }
  std::string_view example() const override { return description_.example; }
  std::vector<Kind> kinds() const override { return description_.kinds; }
  Storage storage() const override { return description_.storage; }

  /// Spatial types override it; of others nobody may ask.
  GeometryHeader header(const Value& /*value*/) const override {
    assert(is_spatial());
    return {};
  }

 protected:
  explicit DescribedType(Description description) : description_(std::move(description)) {}

  /// The error of a list that is no value of this type.
  Error expected(std::string_view what, const NestedList& found) const {
    return {ErrorCode::invalid_value, "{}: expected {}, got {}", name(), what, found.print_short()};
  }
  /// The error of bytes that are no value of this type.
  Error corrupt(std::string_view what) const { return {ErrorCode::database_corrupt, "{}: {}", name(), what}; }
  /// Undefined, with the reason reported; the offending list is its place.
  Value undefined(std::string_view reason, const NestedList& list, Context& context) const {
    context.diagnostics.report_undefined(fmt::format("{}: {}", name(), reason), list.print_short());
    return Value(*this);
  }

 private:
  Description description_;
};

/// What a value with an object of class T takes on the heap, besides what the object itself has there.
template <typename T>
constexpr std::size_t object_bytes() {
  constexpr std::size_t kAllocation = 32;  // counters of references, the allocator's own
  return sizeof(T) + kAllocation;
}

/// Order of defined reals: no NaN, and the two zeros are equal.
inline std::strong_ordering compare_reals(double a, double b) {
  return a < b ? std::strong_ordering::less : a > b ? std::strong_ordering::greater : std::strong_ordering::equal;
}

/// Every bit of the word has an influence on every bit of the result.
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
/// Hash of a sequence, from that of what came before and that of the next element.
constexpr std::size_t combine_hashes(std::size_t before, std::size_t next) {
  return hash_word(before + 0x9E3779B97F4A7C15U) ^ next;
}

}  // namespace algebra3d
