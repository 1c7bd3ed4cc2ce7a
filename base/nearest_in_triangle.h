#pragma once

#include <algorithm>

namespace algebra3d {

/// A point of a triangle: the corner, plus these shares of the two edges that begin there. Both are at least 0, and
/// together at most 1 but for rounding.
template <typename Number>
struct TrianglePoint {
  Number first_share, second_share;
};

/// The nearest point to p of the triangle with the corners 0, u and v. Rounded; some point of the triangle also if it
/// has no area, or if products overflow. Vector: Vec3 or WideVec3. Source: [ericson2005], section 5.1.5.
template <typename Vector, typename Number = decltype(Vector::x)>
TrianglePoint<Number> nearest_in_triangle(const Vector& p, const Vector& u, const Vector& v) {
  const auto share = [](Number of, Number whole) {
    const Number quotient = of / whole;
    return quotient > 0 ? std::min(quotient, Number(1)) : Number(0);  // 0 if it is NaN
  };
  const Number d1 = dot(u, p), d2 = dot(v, p);
  if (d1 <= 0 && d2 <= 0) return {0, 0};
  const Vector from_u = p - u, from_v = p - v;
  const Number d3 = dot(u, from_u), d4 = dot(v, from_u);
  if (d3 >= 0 && d4 <= d3) return {1, 0};
  const Number of_v = d1 * d4 - d3 * d2;
  if (of_v <= 0 && d1 >= 0 && d3 <= 0) return {share(d1, d1 - d3), 0};
  const Number d5 = dot(u, from_v), d6 = dot(v, from_v);
  if (d6 >= 0 && d5 <= d6) return {0, 1};
  const Number of_u = d5 * d2 - d1 * d6;
  if (of_u <= 0 && d2 >= 0 && d6 <= 0) return {0, share(d2, d2 - d6)};
  const Number of_origin = d3 * d6 - d5 * d4;
  if (of_origin <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const Number second = share(d4 - d3, (d4 - d3) + (d5 - d6));
    return {1 - second, second};
  }
  const Number whole = of_origin + of_u + of_v, first = share(of_u, whole);
  return {first, std::min(share(of_v, whole), 1 - first)};
}

}  // namespace algebra3d
