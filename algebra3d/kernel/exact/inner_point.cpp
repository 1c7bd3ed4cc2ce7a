#include "algebra3d/kernel/exact/inner_point.h"

#include <cstdint>

#include "algebra3d/kernel/exact/plane.h"

namespace algebra3d {

ExactPoint inner_point(const TriangleRef& triangle, int attempt) {
  const std::int64_t whole = std::int64_t{4} << attempt;
  const RationalVec3 sum =
      triangle[0].rational() + triangle[1].rational() + Rational(whole - 2) * triangle[2].rational();
  return ExactPoint(Rational(1, whole) * sum);
}

}  // namespace algebra3d
