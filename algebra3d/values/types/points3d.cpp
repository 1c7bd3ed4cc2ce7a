#include <algorithm>
#include <functional>
#include <limits>

#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/codec_points.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

bool is_strictly_ascending(const std::vector<ExactPoint>& points) {
  return std::adjacent_find(points.begin(), points.end(), std::greater_equal<>()) == points.end();
}

class Points3dType final : public DescribedType {
 public:
  Points3dType()
      : DescribedType({.name = "points3d",
                       .doc = "A set of positions in space with exact coordinates, in lexicographic order.",
                       .notation = "((x y z)*)",
                       .example = "((0.0 0.0 0.0) (1.0 0.0 0.0))",
                       .kinds = {Kind::data, Kind::spatial3d},
                       .is_large = true,
                       .summary_unit = "point",
                       .coordinates = Coordinates::points}) {}

  Result<Value> from_nested(const NestedList& list, Context& /*context*/) const override {
    if (!list.is_list()) return expected(notation(), list);
    std::vector<ExactPoint> points;
    points.reserve(list.elements().size());
    for (const auto& element : list.elements()) {
      A3D_ASSIGN(auto point, point_from_nested(element, name()));
      points.push_back(std::move(point));
    }
    return Value::of(Points3d(std::move(points)));
  }
  NestedList to_nested(const Value& value) const override {
    NestedList::List elements;
    elements.reserve(points_of(value).size());
    for (const auto& point : points_of(value)) elements.push_back(point_to_nested(point));
    return NestedList(std::move(elements));
  }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    const auto& points_a = points_of(a);
    const auto& points_b = points_of(b);
    return std::lexicographical_compare_three_way(points_a.begin(), points_a.end(), points_b.begin(), points_b.end());
  }
  std::size_t hash(const Value& value) const override {
    std::size_t result = 0;
    for (const auto& point : points_of(value)) result = combine_hashes(result, point.hash());
    return result;
  }

  std::size_t heap_bytes(const Value& value) const override {
    std::size_t result = object_bytes<Points3d>() + points_of(value).size() * sizeof(ExactPoint);
    for (const auto& point : points_of(value)) result += point.is_double() ? 0 : object_bytes<RationalVec3>();
    return result;
  }

  GeometryHeader header(const Value& value) const override {
    GeometryHeader result;
    for (const auto& point : points_of(value)) result.box.extend(box_of(point));
    result.size = static_cast<std::uint32_t>(points_of(value).size());
    return result;
  }

  void encode(const Value& value, std::string& bytes) const override {
    PointArray array;
    array.reserve(points_of(value).size());
    for (const auto& point : points_of(value)) array.push_back(point);
    ByteWriter writer(bytes);
    write_points(writer, array);
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    const auto array = read_points(reader);
    A3D_TRY(reader.finish());
    std::vector<ExactPoint> points;
    points.reserve(array.size());
    for (std::size_t i = 0; i < array.size(); ++i) points.push_back(array.point(i));
    if (!is_strictly_ascending(points)) return corrupt("expected points in ascending order, each once");
    return Value::of(Points3d(std::move(points)));
  }

 private:
  static const std::vector<ExactPoint>& points_of(const Value& value) { return value.get<Points3d>().points(); }
};

}  // namespace

Points3d::Points3d(std::vector<ExactPoint> points) {
  if (!is_strictly_ascending(points)) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }
  points_ = std::make_shared<const std::vector<ExactPoint>>(std::move(points));
}

const Type& TypeOf<Points3d>::type() {
  static const Points3dType the_type;
  return the_type;
}

}  // namespace algebra3d
