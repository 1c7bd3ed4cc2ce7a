#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/time.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

constexpr std::string_view kIntervalNotation = "(start end leftclosed rightclosed)";

class TimeIntervalType final : public DescribedType {
 public:
  TimeIntervalType()
      : DescribedType({.name = "interval",
                       .doc = "The time from one instant to another; each end is included or not.",
                       .notation = kIntervalNotation,
                       .example = R"(("2011-07-08" "2011-07-09-12:00" TRUE FALSE))",
                       .kinds = {Kind::data}}) {}

  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    A3D_ASSIGN(const Maybe<TimeInterval> interval, interval_from_nested(list, name()));
    return interval ? Value::of(*interval) : undefined(interval.reason(), list, context);
  }
  NestedList to_nested(const Value& value) const override { return interval_to_nested(value.get<TimeInterval>()); }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return a.get<TimeInterval>() <=> b.get<TimeInterval>();
  }
  std::size_t hash(const Value& value) const override { return hash_of(value.get<TimeInterval>()); }
  std::uint64_t order_prefix(const Value& value) const override {
    return static_cast<std::uint64_t>(value.get<TimeInterval>().start.milliseconds - Instant::kFirst + 1);
  }
  std::size_t heap_bytes(const Value& /*value*/) const override { return object_bytes<TimeInterval>(); }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter writer(bytes);
    write_interval(writer, value.get<TimeInterval>());
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    const TimeInterval interval = read_interval(reader);
    A3D_TRY(reader.finish());
    return Value::of(interval);
  }
};

Instant read_instant(ByteReader& reader) {
  const auto instant = Instant::make(static_cast<std::int64_t>(reader.u64()));
  reader.require(instant.is_defined(), "an instant of the years 1 to 9999");
  return instant ? *instant : Instant{};
}

}  // namespace

Maybe<TimeInterval> TimeInterval::make(Instant start, Instant end, bool left_closed, bool right_closed) {
  if (end < start)
    return Undefined{fmt::format("the end {} comes before the start {}", instant_text(end), instant_text(start))};
  if (start == end && !(left_closed && right_closed))
    return Undefined{"an interval of a single instant needs both sides closed"};
  return TimeInterval{start, end, left_closed, right_closed};
}

std::strong_ordering operator<=>(const TimeInterval& a, const TimeInterval& b) {
  if (a.start != b.start) return a.start <=> b.start;
  if (a.left_closed != b.left_closed) return b.left_closed <=> a.left_closed;
  if (a.end != b.end) return a.end <=> b.end;
  return a.right_closed <=> b.right_closed;
}

Result<Maybe<TimeInterval>> interval_from_nested(const NestedList& list, std::string_view what) {
  if (!list.is_list() || list.elements().size() != 4 || !list.elements()[2].is_bool() || !list.elements()[3].is_bool())
    return Error{ErrorCode::invalid_value, "{}: expected {}, got {}", what, kIntervalNotation, list.print_short()};
  const auto& parts = list.elements();
  A3D_ASSIGN(const Maybe<Instant> start, instant_from_nested(parts[0], what));
  A3D_ASSIGN(const Maybe<Instant> end, instant_from_nested(parts[1], what));
  if (!start) return Maybe<TimeInterval>(Undefined{start.reason()});
  if (!end) return Maybe<TimeInterval>(Undefined{end.reason()});
  return TimeInterval::make(*start, *end, parts[2].as_bool(), parts[3].as_bool());
}

NestedList interval_to_nested(const TimeInterval& interval) {
  return NestedList::list(instant_to_nested(interval.start), instant_to_nested(interval.end),
                          NestedList(interval.left_closed), NestedList(interval.right_closed));
}

std::size_t hash_of(const TimeInterval& interval) {
  const std::size_t ends = combine_hashes(hash_word(static_cast<std::uint64_t>(interval.start.milliseconds)),
                                          hash_word(static_cast<std::uint64_t>(interval.end.milliseconds)));
  return combine_hashes(ends, hash_word((interval.left_closed ? 2U : 0U) + (interval.right_closed ? 1U : 0U)));
}

void write_interval(ByteWriter& writer, const TimeInterval& interval) {
  writer.u64(static_cast<std::uint64_t>(interval.start.milliseconds));
  writer.u64(static_cast<std::uint64_t>(interval.end.milliseconds));
  writer.u8(static_cast<std::uint8_t>((interval.left_closed ? 1 : 0) + (interval.right_closed ? 2 : 0)));
}

TimeInterval read_interval(ByteReader& reader) {
  const Instant start = read_instant(reader);
  const Instant end = read_instant(reader);
  const std::uint8_t closed = reader.u8();
  reader.require(closed <= 3, "0 to 3 for the closed sides");
  const auto interval = TimeInterval::make(start, end, (closed & 1U) != 0, (closed & 2U) != 0);
  reader.require(interval.is_defined(), "an interval that is not empty");
  return interval ? *interval : TimeInterval{};
}

const Type& TypeOf<TimeInterval>::type() {
  static const TimeIntervalType the_type;
  return the_type;
}

}  // namespace algebra3d
