#include "algebra3d/exact/intersection_point.h"

namespace algebra3d {

ExactPlane plane_through(const TriangleRef& triangle) {
  const RationalVec3 p = triangle[0].rational();
  return ExactPlane::spanned(p, triangle[1].rational() - p, triangle[2].rational() - p)->canonical();
}

ExactPoint intersect_line_plane(PointRef a, PointRef b, const ExactPlane& plane) {
  const RationalVec3 from = a.rational();
  const RationalVec3 direction = b.rational() - from;
  const Rational share = (plane.offset - dot(plane.normal, from)) / dot(plane.normal, direction);
  return ExactPoint(from + share * direction);
}

ExactPoint intersect_planes(const ExactPlane& p, const ExactPlane& q, const ExactPlane& r) {
  const RationalVec3 qr = cross(q.normal, r.normal);
  const RationalVec3 rp = cross(r.normal, p.normal);
  const RationalVec3 pq = cross(p.normal, q.normal);
  const Rational determinant = dot(p.normal, qr);
  return ExactPoint((Rational(1) / determinant) * (p.offset * qr + q.offset * rp + r.offset * pq));
}

}  // namespace algebra3d
