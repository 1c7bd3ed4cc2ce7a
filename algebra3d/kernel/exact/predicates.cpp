#include "algebra3d/kernel/exact/predicates.h"

#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "algebra3d/kernel/exact/detail/homogeneous.h"
#include "algebra3d/kernel/exact/detail/pair_coordinates.h"
#include "algebra3d/kernel/exact/detail/predicates_integers.h"
#include "algebra3d/kernel/exact/expansion.h"
#include "algebra3d/kernel/exact/interval.h"
#include "base/interruption_scope.h"

namespace algebra3d {

namespace detail {

namespace {

bool all_safe(const Vec3& v) {
  return is_safe(v.x) && is_safe(v.y) && is_safe(v.z);
}

bool is_zero(const Vec3& v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}

// Number is Interval or BoundedPair; the rows are differences from the first point.
template <typename Number, typename Coordinate>
Number determinant3(Coordinate coordinate, const std::array<const PointRef*, 4>& points) {
  std::array<std::array<Number, 3>, 3> m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Number origin = coordinate(*points[0], axis);
    for (std::size_t row = 0; row < 3; ++row) m[row][axis] = coordinate(*points[row + 1], axis) - origin;
  }
  const Number yz = m[0][1] * m[1][2] - m[0][2] * m[1][1];
  const Number zx = m[0][2] * m[1][0] - m[0][0] * m[1][2];
  const Number xy = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  return m[2][0] * yz + m[2][1] * zx + m[2][2] * xy;
}

template <typename Number, typename Coordinate>
Number determinant2(Coordinate coordinate, Projection plane, const std::array<const PointRef*, 3>& points) {
  const std::size_t i = first_axis(plane), j = second_axis(plane);
  const Number oi = coordinate(*points[0], i);
  const Number oj = coordinate(*points[0], j);
  return (coordinate(*points[1], i) - oi) * (coordinate(*points[2], j) - oj) -
         (coordinate(*points[1], j) - oj) * (coordinate(*points[2], i) - oi);
}

int orient3d_by_rationals(const std::array<const PointRef*, 4>& points) {
  count_big_fallback();
  return orient3d_by_integers(points);
}

int orient2d_by_rationals(Projection plane, const std::array<const PointRef*, 3>& points) {
  count_big_fallback();
  return orient2d_by_integers(plane, points);
}

// A difference of doubles is 0 only if they are equal, so these zeros are exact. They are what models with faces
// parallel to the axes ask for all the time.
bool has_zero_row_or_column(const Vec3& u, const Vec3& v, const Vec3& w) {
  return is_zero(u) || is_zero(v) || is_zero(w) || is_zero({u.x, v.x, w.x}) || is_zero({u.y, v.y, w.y}) ||
         is_zero({u.z, v.z, w.z});
}

int orient3d_by_expansions(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto ux = difference(b.x, a.x), uy = difference(b.y, a.y), uz = difference(b.z, a.z);
  const auto vx = difference(c.x, a.x), vy = difference(c.y, a.y), vz = difference(c.z, a.z);
  const auto wx = difference(d.x, a.x), wy = difference(d.y, a.y), wz = difference(d.z, a.z);
  const auto yz = uy * vz - uz * vy;
  const auto zx = uz * vx - ux * vz;
  const auto xy = ux * vy - uy * vx;
  return (yz * wx + zx * wy + xy * wz).sign();
}

int orient2d_by_expansions(double ax, double ay, double bx, double by, double cx, double cy) {
  return (difference(bx, ax) * difference(cy, ay) - difference(by, ay) * difference(cx, ax)).sign();
}

}  // namespace

int decide_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (has_zero_row_or_column(b - a, c - a, d - a)) return 0;
  count_filter_failure();
  poll_interruption();
  const auto x = scale_to_integers<4>({a.x, b.x, c.x, d.x});
  const auto y = scale_to_integers<4>({a.y, b.y, c.y, d.y});
  const auto z = scale_to_integers<4>({a.z, b.z, c.z, d.z});
  if (x && y && z) return determinant_sign(x->integers, y->integers, z->integers);
  if (all_safe(a) && all_safe(b) && all_safe(c) && all_safe(d)) return orient3d_by_expansions(a, b, c, d);
  const PointRef pa = a, pb = b, pc = c, pd = d;
  return orient3d_by_rationals({&pa, &pb, &pc, &pd});
}

int decide_orient2d(Projection plane, const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::size_t i = first_axis(plane), j = second_axis(plane);
  if ((a[i] == b[i] || a[j] == c[j]) && (a[j] == b[j] || a[i] == c[i])) return 0;  // both products are exactly 0
  count_filter_failure();
  poll_interruption();
  const auto x = scale_to_integers<3>({a[i], b[i], c[i]});
  const auto y = scale_to_integers<3>({a[j], b[j], c[j]});
  if (x && y) return determinant_sign(x->integers, y->integers);
  if (is_safe(a[i]) && is_safe(a[j]) && is_safe(b[i]) && is_safe(b[j]) && is_safe(c[i]) && is_safe(c[j]))
    return orient2d_by_expansions(a[i], a[j], b[i], b[j], c[i], c[j]);
  const PointRef pa = a, pb = b, pc = c;
  return orient2d_by_rationals(plane, {&pa, &pb, &pc});
}

int orient3d_of_rationals(const PointRef& a, const PointRef& b, const PointRef& c, const PointRef& d) {
  poll_interruption();
  const std::array<const PointRef*, 4> points{&a, &b, &c, &d};
  int sign = filter_rounded_orient3d(a.approx, b.approx, c.approx, d.approx);
  if (sign == kUndecided)
    sign = have_pairs(points) ? sign_of(determinant3<BoundedPair>(pair_of, points))
                              : determinant3<Interval>(interval_of, points).sign();
  if (sign != kUndecided) return sign;
  count_filter_failure();
  poll_interruption();
  return orient3d_by_rationals(points);
}

int orient2d_of_rationals(Projection plane, const PointRef& a, const PointRef& b, const PointRef& c) {
  poll_interruption();
  const std::array<const PointRef*, 3> points{&a, &b, &c};
  int sign = filter_rounded_orient2d(plane, a.approx, b.approx, c.approx);
  if (sign == kUndecided)
    sign = have_pairs(points) ? sign_of(determinant2<BoundedPair>(pair_of, plane, points))
                              : determinant2<Interval>(interval_of, plane, points).sign();
  if (sign != kUndecided) return sign;
  count_filter_failure();
  poll_interruption();
  return orient2d_by_rationals(plane, points);
}

}  // namespace detail

std::strong_ordering compare(std::size_t axis, PointRef a, PointRef b) {
  // Rounding keeps the order, so different roundings decide.
  if (a.approx[axis] < b.approx[axis]) return std::strong_ordering::less;
  if (a.approx[axis] > b.approx[axis]) return std::strong_ordering::greater;
  const auto beyond = [axis](const PointRef& p) { return p.is_double() ? 0 : p.exact->beyond(axis); };
  const int beyond_a = beyond(a), beyond_b = beyond(b);
  if (beyond_a != beyond_b || beyond_a == 0) return beyond_a <=> beyond_b;
  return detail::compare_quotients((*a.exact)[axis], (*a.exact)[3], (*b.exact)[axis], (*b.exact)[3]);
}

std::strong_ordering compare(PointRef a, PointRef b) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const auto order = compare(axis, a, b); std::is_neq(order)) return order;
  return std::strong_ordering::equal;
}

bool equal(PointRef a, PointRef b) {
  if (a.approx != b.approx || a.is_double() != b.is_double()) return false;
  return a.is_double() || *a.exact == *b.exact;
}

bool collinear(PointRef a, PointRef b, PointRef c) {
  return orient2d(Projection::xy, a, b, c) == 0 && orient2d(Projection::yz, a, b, c) == 0 &&
         orient2d(Projection::zx, a, b, c) == 0;
}

ProjectedTurn dominant_turn(const TriangleRef& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec3 normal = cross(b.approx - a.approx, c.approx - a.approx);
  std::array<Projection, 3> planes{Projection::yz, Projection::zx, Projection::xy};
  // The rounded normal only says where to look first; after NaN as well.
  const auto put_larger_first = [&](Projection& p, Projection& q) {
    if (std::abs(normal[static_cast<std::size_t>(p)]) < std::abs(normal[static_cast<std::size_t>(q)])) std::swap(p, q);
  };
  put_larger_first(planes[0], planes[1]);
  put_larger_first(planes[1], planes[2]);
  put_larger_first(planes[0], planes[1]);
  for (const Projection plane : planes)
    if (const int sign = orient2d(plane, a, b, c); sign != 0) return {plane, sign};
  assert(false && "a triangle on a line");
  return {planes[2], 0};
}

Projection dominant_projection(const PointRef& a, const PointRef& b, const PointRef& c) {
  return dominant_turn({a, b, c}).projection;
}

}  // namespace algebra3d
