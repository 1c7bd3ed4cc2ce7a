#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"

/// A type that this library does not have: points of a scan, in the order in which they were taken. Tests register it
/// to show that the store, tables and moved frames know what a type says of itself, and no name.
struct Cloud {
  std::vector<algebra3d::Vec3> points;
};

namespace algebra3d {

class CloudType final : public DescribedType {
 public:
  CloudType()
      : DescribedType({.name = "cloud3d",
                       .doc = "Points of a scan.",
                       .notation = "((x y z)*)",
                       .example = "((0 0 0))",
                       .kinds = {Kind::data, Kind::spatial3d},
                       .is_large = true,
                       .summary_unit = "sample",
                       .coordinates = Coordinates::points}) {}

  Result<Value> from_nested(const NestedList& list, Context& /*context*/) const override {
    return expected(notation(), list);
  }
  NestedList to_nested(const Value& value) const override {
    NestedList::List elements;
    for (const Vec3& p : value.get<Cloud>().points) elements.push_back(triple_to_nested(RationalVec3(p)));
    return NestedList(std::move(elements));
  }
  std::strong_ordering compare(const Value& /*a*/, const Value& /*b*/) const override {
    return std::strong_ordering::equal;
  }
  std::size_t hash(const Value& /*value*/) const override { return 0; }
  std::size_t heap_bytes(const Value& /*value*/) const override { return 0; }
  GeometryHeader header(const Value& value) const override {
    GeometryHeader result;
    for (const Vec3& p : value.get<Cloud>().points) result.box.extend(p);
    result.size = static_cast<std::uint32_t>(value.get<Cloud>().points.size());
    return result;
  }
  void encode(const Value& /*value*/, std::string& /*bytes*/) const override {}
  Result<Value> decode(std::string_view /*bytes*/, bool /*trusted*/) const override { return corrupt("no form"); }
};

template <>
struct TypeOf<Cloud> {
  static const Type& type() {
    static const CloudType the_type;
    return the_type;
  }
};

}  // namespace algebra3d
