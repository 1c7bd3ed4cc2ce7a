#include "algebra3d/values/types/detail/exact_triple_type.h"

namespace algebra3d {

namespace {

class Vector3dType final : public ExactTripleType<Vector3d, &Vector3d::components> {
 public:
  Vector3dType()
      : ExactTripleType({.name = "vector3d",
                         .doc = "A direction with a length, or a displacement, with exact components.",
                         .notation = "(x y z)",
                         .example = "(0.0 0.0 1.0)",
                         .kinds = {Kind::data},
                         .coordinates = Coordinates::direction}) {}
};

}  // namespace

Maybe<Vector3d> vector_of(const RationalVec3& components) {
  const Vec3 rounded{components.x.nearest_double(), components.y.nearest_double(), components.z.nearest_double()};
  if (!is_finite(rounded)) return Undefined{"a component of the result is beyond the range of doubles"};
  return Vector3d{ExactPoint(components)};
}

const Type& TypeOf<Vector3d>::type() {
  static const Vector3dType the_type;
  return the_type;
}

}  // namespace algebra3d
