#include <algorithm>

#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/moving_region_text.h"
#include "algebra3d/values/types/moving_region.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

bool is_before(const TimeInterval& a, const TimeInterval& b) {
  return a.end < b.start || (a.end == b.start && !(a.right_closed && b.left_closed));
}

std::string time_text(const TimeInterval& interval) {
  return fmt::format("from {} to {}", instant_text(interval.start), instant_text(interval.end));
}

class MovingRegionType final : public DescribedType {
 public:
  MovingRegionType()
      : DescribedType({.name = "mregion",
                       .doc = "A region that moves and changes over time.",
                       .notation = "(uregion*), in order of time",
                       .example = R"((((0 1 TRUE FALSE) ((((0 0 2 0) (4 0 6 0) (4 4 6 9)))))))",
                       .kinds = {Kind::data, Kind::spatial2d},
                       .is_large = true}) {}

  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    if (!list.is_list()) return expected(notation(), list);
    std::vector<RegionUnit> units;
    for (const NestedList& element : list.elements()) {
      A3D_ASSIGN(const auto unit, unit_from_nested(element, name(), context.monitor()));
      if (!unit) return undefined(fmt::format("unit {}: {}", units.size() + 1, unit.reason()), element, context);
      units.push_back(*unit);
    }
    const auto region = MovingRegion::make(std::move(units));
    return region ? Value::of(*region) : undefined(region.reason(), list, context);
  }
  NestedList to_nested(const Value& value) const override {
    NestedList::List units;
    for (const RegionUnit& unit : units_of(value)) units.push_back(unit_to_nested(unit));
    return NestedList(std::move(units));
  }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    const auto &of_a = units_of(a), &of_b = units_of(b);
    return std::lexicographical_compare_three_way(of_a.begin(), of_a.end(), of_b.begin(), of_b.end());
  }
  std::size_t hash(const Value& value) const override {
    std::size_t result = 0;
    for (const RegionUnit& unit : units_of(value)) result = combine_hashes(result, unit.hash());
    return result;
  }
  std::size_t heap_bytes(const Value& value) const override {
    std::size_t result = object_bytes<MovingRegion>();
    for (const RegionUnit& unit : units_of(value)) result += sizeof(RegionUnit) + unit.heap_bytes();
    return result;
  }
  GeometryHeader header(const Value& value) const override {
    GeometryHeader header;
    for (const RegionUnit& unit : units_of(value)) {
      header.box.extend(unit.box());
      header.size += static_cast<std::uint32_t>(unit.segment_count());
    }
    return header;
  }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter writer(bytes);
    writer.varint(units_of(value).size());
    for (const RegionUnit& unit : units_of(value)) write_unit(writer, unit);
  }
  Result<Value> decode(std::string_view bytes, bool trusted) const override {
    constexpr std::size_t kSmallestUnit = 17;  // its interval
    ByteReader reader(bytes, name());
    std::vector<RegionUnit> units;
    const std::size_t count = reader.count(kSmallestUnit);
    for (std::size_t i = 0; i < count; ++i) {
      A3D_ASSIGN(const auto unit, read_unit(reader, name(), trusted));
      if (!reader.ok()) break;
      units.push_back(*unit);
    }
    A3D_TRY(reader.finish());
    const auto region = MovingRegion::make(std::move(units));
    if (!region) return corrupt(region.reason());
    return Value::of(*region);
  }

 private:
  static const std::vector<RegionUnit>& units_of(const Value& value) { return value.get<MovingRegion>().units(); }
};

}  // namespace

Maybe<MovingRegion> MovingRegion::make(std::vector<RegionUnit> units) {
  for (std::size_t i = 1; i < units.size(); ++i) {
    const TimeInterval& before = units[i - 1].interval();
    const TimeInterval& after = units[i].interval();
    if (is_before(before, after)) continue;
    return Undefined{fmt::format("unit {} ({}) {} unit {} ({})", i + 1, time_text(after),
                                 is_before(after, before) ? "comes after the later" : "shares an instant with", i,
                                 time_text(before))};
  }
  MovingRegion result;
  result.units_ = std::make_shared<const std::vector<RegionUnit>>(std::move(units));
  return result;
}

const RegionUnit* MovingRegion::unit_at(Instant instant) const {
  // Two units may end and begin at the instant, of which one has it.
  auto it = std::ranges::lower_bound(*units_, instant, {}, [](const RegionUnit& unit) { return unit.interval().end; });
  while (it != units_->end() && it->interval().start <= instant && !it->interval().contains(instant)) ++it;
  return it != units_->end() && it->interval().contains(instant) ? &*it : nullptr;
}

std::vector<TimeInterval> MovingRegion::times() const {
  std::vector<TimeInterval> times;
  for (const RegionUnit& unit : *units_) {
    const TimeInterval& next = unit.interval();
    if (!times.empty() && times.back().end == next.start && (times.back().right_closed || next.left_closed)) {
      times.back().end = next.end;
      times.back().right_closed = next.right_closed;
    } else {
      times.push_back(next);
    }
  }
  return times;
}

const Type& TypeOf<MovingRegion>::type() {
  static const MovingRegionType the_type;
  return the_type;
}

}  // namespace algebra3d
