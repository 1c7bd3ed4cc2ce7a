#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/time.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

constexpr std::string_view kOutsideOfDays = "the days of the duration are not between -2147483648 and 2147483647";

class DurationType final : public DescribedType {
 public:
  DurationType()
      : DescribedType({.name = "duration",
                       .doc = "A length of time in days and milliseconds; may be negative.",
                       .notation = "(days milliseconds)",
                       .example = "(1 43200000)",
                       .kinds = {Kind::data}}) {}

  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    if (!list.is_list() || list.elements().size() != 2 || !list.elements()[0].is_int() || !list.elements()[1].is_int())
      return expected("(days milliseconds), two ints", list);
    const auto duration = Duration::of_parts(list.elements()[0].as_int(), list.elements()[1].as_int());
    return duration ? Value::of(*duration) : undefined(duration.reason(), list, context);
  }
  /// With 0 <= milliseconds < 86400000.
  NestedList to_nested(const Value& value) const override {
    const std::int64_t all = value.get<Duration>().milliseconds - Duration::kLeast;
    const std::int64_t days = all / kMillisecondsPerDay + Duration::kLeast / kMillisecondsPerDay;
    return NestedList::list(NestedList(days), NestedList(all % kMillisecondsPerDay));
  }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return a.get<Duration>() <=> b.get<Duration>();
  }
  std::size_t hash(const Value& value) const override {
    return hash_word(static_cast<std::uint64_t>(value.get<Duration>().milliseconds));
  }
  std::uint64_t order_prefix(const Value& value) const override {
    return static_cast<std::uint64_t>(value.get<Duration>().milliseconds - Duration::kLeast + 1);
  }
  bool is_whole_in_prefix(std::uint64_t /*prefix*/) const override { return true; }
  std::size_t heap_bytes(const Value& /*value*/) const override { return object_bytes<Duration>(); }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter(bytes).u64(static_cast<std::uint64_t>(value.get<Duration>().milliseconds));
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    const auto duration = Duration::make(static_cast<std::int64_t>(reader.u64()));
    reader.require(duration.is_defined(), "a duration whose days fit 32 bits");
    A3D_TRY(reader.finish());
    return Value::of(*duration);
  }
};

}  // namespace

Maybe<Duration> Duration::make(std::int64_t milliseconds) {
  if (milliseconds < kLeast || milliseconds > kGreatest) return Undefined{std::string(kOutsideOfDays)};
  return Duration{milliseconds};
}

Maybe<Duration> Duration::of_parts(std::int64_t days, std::int64_t milliseconds) {
  std::int64_t sum = 0;
  if (__builtin_mul_overflow(days, kMillisecondsPerDay, &sum) || __builtin_add_overflow(sum, milliseconds, &sum))
    return Undefined{std::string(kOutsideOfDays)};
  return make(sum);
}

Maybe<Duration> Duration::rounded(const Rational& milliseconds) {
  if (milliseconds.abs() > Rational(kGreatest) + 2) return Undefined{std::string(kOutsideOfDays)};
  auto whole = static_cast<std::int64_t>(milliseconds.nearest_double());
  Rational rest = milliseconds - Rational(whole);  // of a few units at most: a double of that size is a whole number
  const Rational half(1, 2);
  for (; rest >= half; rest -= 1) ++whole;
  for (; rest < -half; rest += 1) --whole;
  return make(whole);
}

const Type& TypeOf<Duration>::type() {
  static const DurationType the_type;
  return the_type;
}

}  // namespace algebra3d
