#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/moving_region_text.h"
#include "algebra3d/values/types/moving_region.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

class RegionUnitType final : public DescribedType {
 public:
  RegionUnitType()
      : DescribedType({.name = "uregion",
                       .doc = "A region whose corners move linearly over an interval, with exact coordinates.",
                       .notation = "(interval (face+)), face = (outer hole*), cycle = ((x1 y1 x2 y2)+) with at least 3 "
                                   "corners: where each is at the start and at the end",
                       .example = R"(((0 1 TRUE FALSE) ((((0 0 2 0) (4 0 6 0) (4 4 6 9))))))",
                       .kinds = {Kind::data, Kind::spatial2d},
                       .is_large = true}) {}

  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    A3D_ASSIGN(const auto unit, unit_from_nested(list, name(), context.monitor()));
    return unit ? Value::of(*unit) : undefined(unit.reason(), list, context);
  }
  NestedList to_nested(const Value& value) const override { return unit_to_nested(value.get<RegionUnit>()); }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return a.get<RegionUnit>() <=> b.get<RegionUnit>();
  }
  std::size_t hash(const Value& value) const override { return value.get<RegionUnit>().hash(); }
  std::uint64_t order_prefix(const Value& value) const override {
    return static_cast<std::uint64_t>(value.get<RegionUnit>().interval().start.milliseconds - Instant::kFirst + 1);
  }
  std::size_t heap_bytes(const Value& value) const override {
    return object_bytes<RegionUnit>() + value.get<RegionUnit>().heap_bytes();
  }
  GeometryHeader header(const Value& value) const override {
    const auto& unit = value.get<RegionUnit>();
    return {unit.box(), static_cast<std::uint32_t>(unit.segment_count())};
  }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter writer(bytes);
    write_unit(writer, value.get<RegionUnit>());
  }
  Result<Value> decode(std::string_view bytes, bool trusted) const override {
    ByteReader reader(bytes, name());
    A3D_ASSIGN(const auto unit, read_unit(reader, name(), trusted));
    A3D_TRY(reader.finish());
    return Value::of(*unit);
  }
};

}  // namespace

const Type& TypeOf<RegionUnit>::type() {
  static const RegionUnitType the_type;
  return the_type;
}

}  // namespace algebra3d
