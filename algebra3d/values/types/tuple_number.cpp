#include "algebra3d/values/types/tuple_number.h"

#include <cmath>

#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/described_type.h"
#include "base/number_text.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// Beyond it a double may stand for several numbers.
constexpr std::int64_t kLargestNumber = std::int64_t{1} << 53U;

class TupleNumberType final : public DescribedType {
 public:
  TupleNumberType()
      : DescribedType({.name = "tid",
                       .doc = "The number of a tuple within its relation.",
                       .notation = "digits",
                       .example = "17",
                       .kinds = {Kind::data}}) {}

  Result<Value> from_nested(const NestedList& list, Context& /*context*/) const override {
    const double number = list.is_int()      ? static_cast<double>(list.as_int())
                          : list.is_real()   ? list.as_real()
                          : list.is_symbol() ? parse_real(list.as_symbol()).value_or(0)
                                             : 0.0;
    const bool is_rounded = list.is_int() && list.as_int() > kLargestNumber;
    if (number < 1 || number > static_cast<double>(kLargestNumber) || number != std::floor(number) || is_rounded)
      return expected(fmt::format("an integer from 1 to {}", kLargestNumber), list);
    return Value::of(TupleNumber{static_cast<std::int64_t>(number)});
  }
  NestedList to_nested(const Value& value) const override { return NestedList(value.get<TupleNumber>().number); }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return a.get<TupleNumber>().number <=> b.get<TupleNumber>().number;
  }
  std::size_t hash(const Value& value) const override {
    return hash_word(static_cast<std::uint64_t>(value.get<TupleNumber>().number));
  }

  std::uint64_t order_prefix(const Value& value) const override {
    return static_cast<std::uint64_t>(value.get<TupleNumber>().number);
  }
  bool is_whole_in_prefix(std::uint64_t /*prefix*/) const override { return true; }
  std::size_t heap_bytes(const Value& /*value*/) const override { return object_bytes<TupleNumber>(); }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter(bytes).u64(static_cast<std::uint64_t>(value.get<TupleNumber>().number));
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    const std::uint64_t number = reader.u64();
    reader.require(0 < number && number <= static_cast<std::uint64_t>(kLargestNumber), "a positive number");
    A3D_TRY(reader.finish());
    return Value::of(TupleNumber{static_cast<std::int64_t>(number)});
  }
};

}  // namespace

const Type& TypeOf<TupleNumber>::type() {
  static const TupleNumberType the_type;
  return the_type;
}

}  // namespace algebra3d
