#include <array>
#include <cmath>

#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

using Bounds = std::array<double, 6>;  // min and max of x, of y, of z: the order of the notation

Box3 box_from(const Bounds& bounds) {
  return {{bounds[0], bounds[2], bounds[4]}, {bounds[1], bounds[3], bounds[5]}};
}

Bounds bounds_of(const Value& value) {
  const auto& box = value.get<Box3>();
  return {box.min.x, box.max.x, box.min.y, box.max.y, box.min.z, box.max.z};
}

class Rect3Type final : public DescribedType {
 public:
  Rect3Type()
      : DescribedType({.name = "rect3",
                       .doc = "An axis-parallel closed box; it may be flat.",
                       .notation = "(minX maxX minY maxY minZ maxZ)",
                       .example = "(0.0 1.0 0.0 2.0 -1.0 1.0)",
                       .kinds = {Kind::data, Kind::spatial3d},
                       .coordinates = Coordinates::box}) {}

  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    if (!list.is_list() || list.elements().size() != 6) return expected(notation(), list);
    Bounds bounds{};
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      A3D_ASSIGN(bounds[i], double_from_nested(list.elements()[i], name()));
    }
    const auto box = box_from(bounds);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (box.min[axis] > box.max[axis]) {
        return undefined(fmt::format("the minimum of {} is above the maximum", "xyz"[axis]), list, context);
      }
    }
    return Value::of(box);
  }
  NestedList to_nested(const Value& value) const override {
    NestedList::List elements;
    for (const double bound : bounds_of(value)) elements.emplace_back(bound);
    return NestedList(std::move(elements));
  }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    const auto bounds_a = bounds_of(a);
    const auto bounds_b = bounds_of(b);
    for (std::size_t i = 0; i < bounds_a.size(); ++i) {
      const auto order = compare_reals(bounds_a[i], bounds_b[i]);
      if (std::is_neq(order)) return order;
    }
    return std::strong_ordering::equal;
  }
  std::size_t hash(const Value& value) const override {
    std::size_t result = 0;
    for (const double bound : bounds_of(value)) result = combine_hashes(result, hash_real(bound));
    return result;
  }

  std::size_t heap_bytes(const Value& /*value*/) const override { return object_bytes<Box3>(); }

  GeometryHeader header(const Value& value) const override { return {value.get<Box3>(), 0}; }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter writer(bytes);
    for (const double bound : bounds_of(value)) writer.f64(bound);
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    Bounds bounds{};
    for (double& bound : bounds) {
      bound = reader.f64();
      reader.require(std::isfinite(bound), "a finite bound");
    }
    const auto box = box_from(bounds);
    reader.require(!box.is_empty(), "no minimum above its maximum");
    A3D_TRY(reader.finish());
    return Value::of(box);
  }
};

}  // namespace

const Type& TypeOf<Box3>::type() {
  static const Rect3Type the_type;
  return the_type;
}

}  // namespace algebra3d
