#include "algebra3d/kernel/exact/intersection_point.h"

#include <utility>

#include "algebra3d/kernel/exact/detail/exact_coordinates.h"
#include "algebra3d/kernel/exact/detail/fixed_width.h"
#include "algebra3d/kernel/exact/detail/homogeneous.h"

namespace algebra3d {
namespace {

using detail::HomogeneousPoint;
using detail::HomogeneousView;

ExactPoint point_at(HomogeneousPoint& numbers) {
  Vec3 approx;
  SharedCoordinates exact = ExactCoordinates::make(numbers, approx);
  return {approx, std::move(exact)};
}

}  // namespace

ExactPoint intersect_line_plane(PointRef a, PointRef b, const IntegerPlane& plane) {
  thread_local HomogeneousPoint buffer_of_a, buffer_of_b, met;
  thread_local mpz_class at_from, at_to;
  const HomogeneousView from(a, buffer_of_a), to(b, buffer_of_b);
  detail::dot(at_from, plane.coefficients(), from);
  detail::dot(at_to, plane.coefficients(), to);
  // The combination of the two points at which the equation holds.
  for (std::size_t i = 0; i < 4; ++i) {
    mpz_mul(met[i], at_to.get_mpz_t(), from[i]);
    mpz_submul(met[i], at_from.get_mpz_t(), to[i]);
  }
  return point_at(met);
}

ExactPoint intersect_line_plane(PointRef a, PointRef b, const TriangleRef& triangle) {
  const auto& [p, q, r] = triangle;
  thread_local HomogeneousPoint met;
  if (a.is_double() && b.is_double() && p.is_double() && q.is_double() && r.is_double() &&
      detail::meet_in_fixed_width(met, a.approx, b.approx, {p.approx, q.approx, r.approx}))
    return point_at(met);
  return intersect_line_plane(a, b, IntegerPlane::through(triangle));
}

ExactPoint intersect_planes(const IntegerPlane& p, const IntegerPlane& q, const IntegerPlane& r) {
  return common_point(p, q, r).value();
}

std::optional<ExactPoint> common_point(const IntegerPlane& p, const IntegerPlane& q, const IntegerPlane& r) {
  thread_local HomogeneousPoint met;
  detail::join(met, p.coefficients(), q.coefficients(), r.coefficients());
  if (sgn(met.w) == 0) return std::nullopt;
  return point_at(met);
}

}  // namespace algebra3d
