#include "algebra3d/kernel/exact/face_measures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/detail/bounded_pair.h"
#include "algebra3d/kernel/exact/detail/length_estimate.h"
#include "algebra3d/kernel/exact/plane.h"

namespace algebra3d {
namespace {

using detail::BoundedPair;
using PairVector = std::array<BoundedPair, 3>;
using Corners = std::span<const std::uint32_t>;

bool is_in_range(const PointRef& p) {
  using detail::LengthEstimate;
  return p.is_double() && LengthEstimate::is_in_range(p.approx.x) && LengthEstimate::is_in_range(p.approx.y) &&
         LengthEstimate::is_in_range(p.approx.z);
}
bool are_in_range(const PointArray& points, Corners corners) {
  return std::ranges::all_of(corners, [&](std::uint32_t corner) { return is_in_range(points[corner]); });
}

// ---- with pairs of doubles, where these decide

PairVector difference(const Vec3& a, const Vec3& b) {
  return {BoundedPair::difference(a.x, b.x), BoundedPair::difference(a.y, b.y), BoundedPair::difference(a.z, b.z)};
}

void add_cross(const PairVector& u, const PairVector& v, PairVector& sum) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum[i] = sum[i] + (u[j] * v[k] - u[k] * v[j]);
  }
}

/// Twice the vector area: the sum of the normals of the triangles that corner 0 forms with the edges.
PairVector doubled_area(const PointArray& points, Corners corners) {
  const Vec3 origin = points[corners[0]].approx;
  PairVector sum;
  PairVector before = difference(points[corners[1]].approx, origin);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const PairVector next = difference(points[corners[i]].approx, origin);
    add_cross(before, next, sum);
    before = next;
  }
  return sum;
}

/// The length of a vector; nothing if it may be zero.
std::optional<BoundedPair> length_of(const PairVector& v) {
  const BoundedPair square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  if (!(square.value > 4 * square.error)) return std::nullopt;
  return root_of(square);
}

/// A vector along an axis has no root to take.
std::optional<VectorArea> along_axis(const PairVector& doubled, std::size_t axis) {
  const std::optional<double> length = doubled[axis].nearest_double();
  if (!length || doubled[axis].size() <= 2 * doubled[axis].error) return std::nullopt;
  VectorArea result;
  result.normal[axis] = *length > 0 ? 1 : -1;
  result.area = std::abs(*length) / 2;
  return result;
}

/// Nothing where the errors leave the rounding of a number open.
std::optional<VectorArea> estimated(const PairVector& doubled) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (doubled[(axis + 1) % 3].is_zero() && doubled[(axis + 2) % 3].is_zero())
      return doubled[axis].is_zero() ? VectorArea() : along_axis(doubled, axis);
  const std::optional<BoundedPair> length = length_of(doubled);
  if (!length) return std::nullopt;
  const std::optional<double> doubled_length = length->nearest_double();
  if (!doubled_length) return std::nullopt;
  VectorArea result{.normal = {}, .area = *doubled_length / 2};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (doubled[axis].is_zero()) continue;
    const std::optional<double> component = (doubled[axis] / *length).nearest_double();
    if (!component) return std::nullopt;
    result.normal[axis] = *component;
  }
  return result;
}

// ---- with rationals

VectorArea rounded(const RationalVec3& doubled) {
  VectorArea result;
  const Rational square = dot(doubled, doubled);
  if (square.sign() == 0) return result;
  result.area = (square / Rational(4)).nearest_root();
  for (std::size_t axis = 0; axis < 3; ++axis)
    result.normal[axis] = doubled[axis].sign() * (doubled[axis] * doubled[axis] / square).nearest_root();
  return result;
}

/// The sum with another double. Exact where the rests are exact together, as they are of a few numbers of one size.
BoundedPair with_double(const BoundedPair& a, double b) {
  const detail::Rounded sum = detail::two_sum(a.value, b), rests = detail::two_sum(sum.rest, a.rest);
  const auto [value, rest] = detail::two_sum(sum.value, rests.value);
  return {value, rest, a.error + std::abs(rests.rest)};
}

std::optional<double> estimated_mean(const PointArray& points, Corners corners, std::size_t axis) {
  BoundedPair sum;
  for (const std::uint32_t corner : corners) sum = with_double(sum, points[corner].approx[axis]);
  if (sum.is_zero()) return 0.0;
  const auto count = static_cast<double>(corners.size());
  // The mean of two or four numbers is often in the middle between two doubles.
  if (sum.error == 0 && std::has_single_bit(corners.size())) return sum.value / count;
  return (sum / BoundedPair{count, 0, 0}).nearest_double();
}

double exact_mean(const PointArray& points, Corners corners, std::size_t axis) {
  Rational sum;
  for (const std::uint32_t corner : corners) sum += points[corner].coordinate(axis);
  return (sum / Rational(corners.size())).nearest_double();
}

}  // namespace

RationalVec3 exact_doubled_vector_area(const PointArray& points, std::span<const std::uint32_t> corners) {
  if (corners.empty()) return {};
  const RationalVec3 origin = points[corners[0]].rational();
  RationalVec3 sum, before;
  for (const std::uint32_t corner : corners.subspan(1)) {
    RationalVec3 next = points[corner].rational() - origin;
    sum = sum + cross(before, next);
    before = std::move(next);
  }
  return sum;
}

VectorArea nearest_vector_area(const PointArray& points, std::span<const std::uint32_t> corners) {
  if (corners.size() < 3) return {};
  if (are_in_range(points, corners)) {
    if (const auto result = estimated(doubled_area(points, corners))) return *result;
    detail::count_filter_failure();
  }
  return rounded(exact_doubled_vector_area(points, corners));
}

Vec3 nearest_mean(const PointArray& points, std::span<const std::uint32_t> corners) {
  const bool is_estimated = are_in_range(points, corners);
  Vec3 mean;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto estimate = is_estimated ? estimated_mean(points, corners, axis) : std::nullopt;
    if (is_estimated && !estimate) detail::count_filter_failure();
    mean[axis] = estimate ? *estimate : exact_mean(points, corners, axis);
  }
  return mean;
}

double nearest_distance(const PointRef& a, const PointRef& b) {
  if (is_in_range(a) && is_in_range(b)) {
    const PairVector v = difference(b.approx, a.approx);
    if (v[0].is_zero() && v[1].is_zero() && v[2].is_zero()) return 0;
    if (const auto length = length_of(v)) {
      if (const auto result = length->nearest_double()) return *result;
    }
    detail::count_filter_failure();
  }
  const RationalVec3 v = b.rational() - a.rational();
  return dot(v, v).nearest_root();
}

}  // namespace algebra3d
