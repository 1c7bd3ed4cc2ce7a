#include "algebra3d/kernel/distance/detail/rounded_closest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace algebra3d::distances {
namespace {

/// A bound of all roundings here, of numbers of size 1.
constexpr double kRoundings = 0x1p-46;
/// More than the root of the loss of products by underflow.
constexpr double kUnderflow = 0x1p-500;
/// Grows a number by more than a few roundings.
constexpr double kGrowth = 1 + 0x1p-50;

constexpr Feature kInside = 7;  // of a triangle

Feature bit(std::size_t corner) {
  return static_cast<Feature>(1U << corner);
}

/// Corners in units, from an origin that both simplices have in common.
struct RoundedSimplex {
  std::array<Vec3, 3> corners;
  std::size_t size;

  std::span<const Vec3> points() const { return std::span(corners).first(size); }
};

/// The edges of a simplex by the numbers of their corners; a point is an edge from its corner to itself.
using EdgeEnds = std::pair<std::size_t, std::size_t>;
std::span<const EdgeEnds> edges_of(const RoundedSimplex& simplex) {
  static constexpr std::array<EdgeEnds, 3> kEdges{{{0, 1}, {1, 2}, {2, 0}}};
  static constexpr std::array<EdgeEnds, 1> kPoint{{{0, 0}}};
  if (simplex.size == 1) return kPoint;
  return std::span(kEdges).first(simplex.size == 2 ? 1 : 3);
}

/// Points of two simplices, and the features in which they lie.
struct PointPair {
  Vec3 first, second;
  ClosestFeatures features;
  double squared_distance = std::numeric_limits<double>::infinity();

  void take_if_nearer(const Vec3& p, const Vec3& q, const ClosestFeatures& of) {
    const Vec3 between = q - p;
    if (const double distance = dot(between, between); distance < squared_distance) *this = {p, q, of, distance};
  }
};

/// A point of an edge: the share of the edge before it, and the feature that it is in.
struct EdgePoint {
  double share;
  Feature feature;
};

/// The point nearest to one of the edge's line; any one if `share` is NaN, as for edges without length.
EdgePoint clamped(double share, const EdgeEnds& ends) {
  if (!(share > 0)) return {0, bit(ends.first)};
  if (share >= 1) return {1, bit(ends.second)};
  return {share, static_cast<Feature>(bit(ends.first) | bit(ends.second))};
}

void try_edges(const RoundedSimplex& a, const EdgeEnds& of_a, const RoundedSimplex& b, const EdgeEnds& of_b,
               PointPair& best) {
  const Vec3 &p = a.corners[of_a.first], &q = b.corners[of_b.first];
  const Vec3 u = a.corners[of_a.second] - p, v = b.corners[of_b.second] - q, between = p - q;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), u_between = dot(u, between), v_between = dot(v, between);
  EdgePoint on_a = clamped((uv * v_between - u_between * vv) / (uu * vv - uv * uv), of_a);
  const EdgePoint on_b = clamped((uv * on_a.share + v_between) / vv, of_b);
  on_a = clamped((uv * on_b.share - u_between) / uu, of_a);  // it may have been clamped to the wrong end
  best.take_if_nearer(p + on_a.share * u, q + on_b.share * v, {on_a.feature, on_b.feature});
}

/// The foot of a point in the inside of a triangle; false if it lies outside.
bool find_foot(const Vec3& point, const RoundedSimplex& triangle, Vec3& foot) {
  const Vec3 &corner = triangle.corners[0], u = triangle.corners[1] - corner, v = triangle.corners[2] - corner;
  const Vec3 to_point = point - corner, normal = cross(u, v);
  const double size = dot(normal, normal);
  const double of_u = dot(cross(to_point, v), normal) / size, of_v = dot(cross(u, to_point), normal) / size;
  foot = corner + (of_u * u + of_v * v);
  return of_u > 0 && of_v > 0 && of_u + of_v < 1;
}

PointPair nearest_points(const RoundedSimplex& a, const RoundedSimplex& b) {
  PointPair best;
  for (const EdgeEnds& of_a : edges_of(a))
    for (const EdgeEnds& of_b : edges_of(b)) try_edges(a, of_a, b, of_b, best);
  Vec3 foot;
  if (b.size == 3)
    for (std::size_t i = 0; i < a.size; ++i)
      if (find_foot(a.corners[i], b, foot)) best.take_if_nearer(a.corners[i], foot, {bit(i), kInside});
  if (a.size == 3)
    for (std::size_t i = 0; i < b.size; ++i)
      if (find_foot(b.corners[i], a, foot)) best.take_if_nearer(foot, b.corners[i], {kInside, bit(i)});
  return best;
}

/// How far the simplices are apart along a direction, which is to be of length 1.
double gap_along(const Vec3& direction, const RoundedSimplex& a, const RoundedSimplex& b) {
  double end_of_a = -std::numeric_limits<double>::infinity(), begin_of_b = -end_of_a;
  for (const Vec3& corner : a.points()) end_of_a = std::max(end_of_a, dot(direction, corner));
  for (const Vec3& corner : b.points()) begin_of_b = std::min(begin_of_b, dot(direction, corner));
  return begin_of_b - end_of_a;
}

double largest_coordinate(std::span<const Vec3> points) {
  double largest = 0;
  for (const Vec3& p : points)
    for (std::size_t axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p[axis]));
  return largest;
}

/// How far the rounded corners may be from the exact ones in each coordinate, in coordinate units.
double rounding_of_exact(const Simplex& simplex) {
  double largest = 0;
  for (const PointRef& corner : std::span(simplex.corners).first(simplex.size))
    if (!corner.is_double()) largest = std::max(largest, largest_coordinate({&corner.approx, 1}));
  return 0x1p-52 * largest;
}

RoundedSimplex rounded(const Simplex& simplex, const Vec3& halved_origin, double half_scale) {
  RoundedSimplex result{{}, simplex.size};
  for (std::size_t i = 0; i < simplex.size; ++i)
    result.corners[i] = half_scale * (0.5 * simplex.corners[i].approx - halved_origin);
  return result;
}

}  // namespace

RoundedDistances::RoundedDistances(const Box3& box) {
  double half_extent = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    half_extent = std::max(half_extent, box.max[axis] / 2 - box.min[axis] / 2);
  half_scale_ = half_extent > 0 ? std::ldexp(1.0, std::clamp(-std::ilogb(half_extent), -1000, 1000)) : 1;
  smallest_rounding_ = 8 * std::numeric_limits<double>::denorm_min() * half_scale_;
}

DistanceBounds RoundedDistances::bounds(const Simplex& a, const Simplex& b) const {
  const Vec3 halved_origin = 0.5 * a.corners[0].approx;
  const RoundedSimplex first = rounded(a, halved_origin, half_scale_), second = rounded(b, halved_origin, half_scale_);
  const PointPair nearest = nearest_points(first, second);
  const double distance = std::sqrt(nearest.squared_distance);
  const double extent = std::max(largest_coordinate(first.points()), largest_coordinate(second.points()));
  const double of_exact = (rounding_of_exact(a) + rounding_of_exact(b)) * half_scale_;
  const double error = kRoundings * extent + 4 * of_exact + smallest_rounding_ + kUnderflow;
  const Vec3 direction = distance > 0 ? (1 / distance) * (nearest.second - nearest.first) : Vec3{};
  const double gap = distance > 0 ? gap_along(direction, first, second) : 0;
  const double upper = (distance + error) * kGrowth, lower = std::max(0.0, gap - error) / kGrowth;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {std::max(0.0, std::nextafter(lower / half_scale_ * 2, -kInfinity)),
          std::nextafter(upper / half_scale_ * 2, kInfinity), nearest.features, direction};
}

}  // namespace algebra3d::distances
