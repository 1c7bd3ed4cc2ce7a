#include "algebra3d/values/types/detail/exact_triple_type.h"

namespace algebra3d {

namespace {

class Point3dType final : public ExactTripleType<Point3d, &Point3d::position> {
 public:
  Point3dType()
      : ExactTripleType({.name = "point3d",
                         .doc = "A position in space with exact coordinates.",
                         .notation = "(x y z)",
                         .example = "(1.0 -2.5 1/3)",
                         .kinds = {Kind::data, Kind::spatial3d},
                         .coordinates = Coordinates::point}) {}

  GeometryHeader header(const Value& value) const override { return {box_of(value.get<Point3d>().position), 1}; }
};

}  // namespace

const Type& TypeOf<Point3d>::type() {
  static const Point3dType the_type;
  return the_type;
}

}  // namespace algebra3d
