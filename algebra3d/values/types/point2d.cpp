#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/codec_points.h"
#include "algebra3d/values/types/planar.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

class Point2dType final : public DescribedType {
 public:
  Point2dType()
      : DescribedType({.name = "point",
                       .doc = "A position in the plane with exact coordinates.",
                       .notation = "(x y)",
                       .example = "(1.0 -2.5)",
                       .kinds = {Kind::data, Kind::spatial2d}}) {}

  Result<Value> from_nested(const NestedList& list, Context& /*context*/) const override {
    A3D_ASSIGN(ExactPoint point, planar_point_from_nested(list, name()));
    return Value::of(Point2d{std::move(point)});
  }
  NestedList to_nested(const Value& value) const override { return planar_point_to_nested(position_of(value)); }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return position_of(a) <=> position_of(b);
  }
  std::size_t hash(const Value& value) const override { return position_of(value).hash(); }
  std::size_t heap_bytes(const Value& value) const override {
    return object_bytes<Point2d>() + (position_of(value).is_double() ? 0 : object_bytes<RationalVec3>());
  }

  GeometryHeader header(const Value& value) const override { return {box_of(position_of(value)), 1}; }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter writer(bytes);
    write_point(writer, position_of(value));
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    ExactPoint point = read_point(reader);
    reader.require(point.ref().coordinate(2).sign() == 0, "a point of the plane");
    A3D_TRY(reader.finish());
    return Value::of(Point2d{std::move(point)});
  }

 private:
  static const ExactPoint& position_of(const Value& value) { return value.get<Point2d>().position; }
};

}  // namespace

const Type& TypeOf<Point2d>::type() {
  static const Point2dType the_type;
  return the_type;
}

}  // namespace algebra3d
