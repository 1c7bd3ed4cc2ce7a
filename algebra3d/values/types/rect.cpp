#include <array>
#include <cmath>

#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/planar.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Sides = std::array<double, 4>;  // min and max of x, of y: the order of the notation

Sides sides_of(const Value& value) {
  const auto& rect = value.get<Rect>();
  return {rect.min_x, rect.max_x, rect.min_y, rect.max_y};
}

class RectType final : public DescribedType {
 public:
  RectType()
      : DescribedType({.name = "rect",
                       .doc = "An axis-parallel closed rectangle; it may be flat.",
                       .notation = "(minX maxX minY maxY)",
                       .example = "(0.0 1.0 0.0 2.0)",
                       .kinds = {Kind::data, Kind::spatial2d}}) {}

  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    if (!list.is_list() || list.elements().size() != 4) return expected(notation(), list);
    Sides sides{};
    for (std::size_t i = 0; i < sides.size(); ++i) {
      A3D_ASSIGN(sides[i], double_from_nested(list.elements()[i], name()));
    }
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (sides[2 * axis] > sides[2 * axis + 1])
        return undefined(fmt::format("the minimum of {} is above the maximum", "xy"[axis]), list, context);
    return Value::of(Rect{sides[0], sides[1], sides[2], sides[3]});
  }
  NestedList to_nested(const Value& value) const override {
    NestedList::List elements;
    for (const double side : sides_of(value)) elements.emplace_back(side);
    return NestedList(std::move(elements));
  }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    const Sides sides_a = sides_of(a), sides_b = sides_of(b);
    for (std::size_t i = 0; i < sides_a.size(); ++i)
      if (const auto order = compare_reals(sides_a[i], sides_b[i]); std::is_neq(order)) return order;
    return std::strong_ordering::equal;
  }
  std::size_t hash(const Value& value) const override {
    std::size_t result = 0;
    for (const double side : sides_of(value)) result = combine_hashes(result, hash_real(side));
    return result;
  }

  std::size_t heap_bytes(const Value& /*value*/) const override { return object_bytes<Rect>(); }

  GeometryHeader header(const Value& value) const override { return {value.get<Rect>().box(), 0}; }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter writer(bytes);
    for (const double side : sides_of(value)) writer.f64(side);
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    Sides sides{};
    for (double& side : sides) {
      side = reader.f64();
      reader.require(std::isfinite(side), "a finite side");
    }
    reader.require(sides[0] <= sides[1] && sides[2] <= sides[3], "no minimum above its maximum");
    A3D_TRY(reader.finish());
    return Value::of(Rect{sides[0], sides[1], sides[2], sides[3]});
  }
};

}  // namespace

const Type& TypeOf<Rect>::type() {
  static const RectType the_type;
  return the_type;
}

}  // namespace algebra3d
