#include "algebra3d/values/spatial_relations/nearest_points.h"

#include <utility>

#include "algebra3d/kernel/distance/distance.h"
#include "algebra3d/values/spatial_relations/boundary_faces.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

bool has_inside(const SpatialSet& set) {
  return std::holds_alternative<Volume3d>(set) || std::holds_alternative<Box3>(set);
}

/// A common point of sets whose boundaries are apart: one may lie inside the other.
Result<std::optional<MeetingWitness>> enclosed_point(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  if (!has_inside(a) && !has_inside(b)) return std::optional<MeetingWitness>();
  return witness_of_meeting(a, b, monitor);
}

/// The corners of a box, or twice a single point; nothing for other sets.
struct Corners {
  ExactPoint min, max;
};
std::optional<Corners> corners_of(const SpatialSet& set) {
  if (const auto* box = std::get_if<Box3>(&set)) return Corners{box->min, box->max};
  const auto* points = std::get_if<PointSet>(&set);
  if (points == nullptr || points->points.size() != 1) return std::nullopt;
  return Corners{points->points[0], points->points[0]};
}

/// The sum of the squares of the gaps along the axes.
Rational squared_distance_of(const Corners& a, const Corners& b) {
  Rational sum;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Rational below = b.min.ref().coordinate(axis) - a.max.ref().coordinate(axis);
    const Rational above = a.min.ref().coordinate(axis) - b.max.ref().coordinate(axis);
    const Rational& gap = below.sign() > 0 ? below : above;
    if (gap.sign() > 0) sum += gap * gap;
  }
  return sum;
}

}  // namespace

Result<std::optional<NearestPoints>> nearest_points(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  const BoundaryFaces first(a), second(b);
  A3D_ASSIGN(std::optional<ClosestPoints> closest, closest_points(first.operand(), second.operand(), monitor));
  if (!closest) return std::optional<NearestPoints>();
  if (closest->squared_distance.sign() > 0) {
    A3D_ASSIGN(const std::optional<MeetingWitness> enclosed, enclosed_point(a, b, monitor));
    if (enclosed) return std::optional(NearestPoints{enclosed->point, enclosed->point, 0});
  }
  return std::optional(
      NearestPoints{std::move(closest->first), std::move(closest->second), std::move(closest->squared_distance)});
}

// Where sets cross, many pairs of triangles are at the distance 0, and each would be a candidate.
Result<std::optional<Rational>> squared_distance_of(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  const auto first_box = corners_of(a), second_box = corners_of(b);
  if (first_box && second_box) return std::optional(squared_distance_of(*first_box, *second_box));
  A3D_ASSIGN(const bool meet, do_meet(a, b, monitor));
  if (meet) return std::optional<Rational>(0);
  const BoundaryFaces first(a), second(b);
  return squared_distance(first.operand(), second.operand(), monitor);
}

Result<std::optional<DistanceRange>> distance_range_of(const SpatialSet& a, const SpatialSet& b, double reach,
                                                       const Monitor& monitor) {
  A3D_ASSIGN(const bool meet, do_meet(a, b, monitor));
  if (meet) return std::optional(DistanceRange{0, 0});
  const BoundaryFaces first(a), second(b);
  return distance_range(first.operand(), second.operand(), reach, monitor);
}

Result<bool> are_within(const SpatialSet& a, const SpatialSet& b, const Rational& distance, const Monitor& monitor) {
  if (distance.sign() < 0) return false;
  const BoundaryFaces first(a), second(b);
  A3D_ASSIGN(const bool are_near, are_within(first.operand(), second.operand(), distance, monitor));
  if (are_near) return true;
  A3D_ASSIGN(const std::optional<MeetingWitness> enclosed, enclosed_point(a, b, monitor));
  return enclosed.has_value();
}

std::optional<bool> are_within_by_boxes(const Box3& a, const Box3& b, double distance) {
  // For the rounding of sums of squares, and of subnormal numbers.
  constexpr double kMargin = 0x1p-40, kSmallest = 0x1p-1070;
  if (algebra3d::distance(a, b) * (1 - kMargin) > distance + kSmallest) return false;
  const Box3 both = unite(a, b);
  if (length(both.max - both.min) * (1 + kMargin) + kSmallest <= distance) return true;
  return std::nullopt;
}

}  // namespace algebra3d
