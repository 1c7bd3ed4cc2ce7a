#include "algebra3d/values/measures/detail/opposite_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace algebra3d {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// How the line of a ray meets a triangle, as far as rounded arithmetic decides it, and between which places.
struct RoundedMeeting {
  enum class Kind : std::uint8_t { missed, met, open } kind = Kind::open;
  double from = 0, to = 0;
};

/// A ray in doubles.
class RoundedRay {
 public:
  RoundedRay(const InwardRay& ray, double margin)
      : origin_(ray.origin()), direction_(ray.direction()), margin_(margin) {}

  /// False if the ray misses the box or meets it beyond a place.
  bool may_meet(const Box3& box, double most) const {
    double begin = -margin_, end = most + margin_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = box.min[axis] - origin_[axis] - margin_, high = box.max[axis] - origin_[axis] + margin_;
      if (std::abs(direction_[axis]) < 0x1p-60) {
        if (low > 0 || high < 0) return false;
        continue;
      }
      const double first = low / direction_[axis], second = high / direction_[axis];
      begin = std::max(begin, std::min(first, second));
      end = std::min(end, std::max(first, second));
    }
    return !(begin > end + margin_);
  }

  RoundedMeeting meeting(const std::array<Vec3, 3>& corners) const {
    std::array<Vec3, 3> relative;
    std::array<double, 3> lengths{}, heights{};
    for (std::size_t i = 0; i < 3; ++i) {
      relative[i] = corners[i] - origin_;
      lengths[i] = length(relative[i]);
      heights[i] = dot(direction_, relative[i]);
    }
    const auto [low, high] = std::minmax({heights[0], heights[1], heights[2]});
    RoundedMeeting result{RoundedMeeting::Kind::open, low - margin_, high + margin_};
    std::array<double, 3> sides{};
    double least = kUnbounded, most = -kUnbounded, largest_error = 0, sum = 0, weighted = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      sides[i] = dot(direction_, cross(relative[i], relative[j]));
      const double error = 4 * margin_ * (lengths[i] + lengths[j]) + 0x1p-47 * lengths[i] * lengths[j];
      largest_error = std::max(largest_error, error);
      least = std::min(least, sides[i] - error);
      most = std::max(most, sides[i] + error);
      sum += sides[i];
      weighted += sides[i] * heights[(i + 2) % 3];
    }
    if (are_on_both_sides(sides, lengths)) {
      result.kind = RoundedMeeting::Kind::missed;
    } else if (least > 0 || most < 0) {
      result.kind = RoundedMeeting::Kind::met;
      const double place = weighted / sum, error = 8 * largest_error / std::abs(sum) * (high - low) + 2 * margin_;
      result.from = std::max(result.from, place - error);
      result.to = std::min(result.to, place + error);
    }
    return result;
  }

 private:
  bool are_on_both_sides(const std::array<double, 3>& sides, const std::array<double, 3>& lengths) const {
    bool is_left = false, is_right = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const double error = 4 * margin_ * (lengths[i] + lengths[j]) + 0x1p-47 * lengths[i] * lengths[j];
      is_left = is_left || sides[i] > error;
      is_right = is_right || sides[i] < -error;
    }
    return is_left && is_right;
  }

  Vec3 origin_, direction_;
  double margin_;
};

}  // namespace

double OppositeSearch::margin_of(const Geometry& solid) {
  double largest = 0;
  for (const Vec3& p : solid.mesh.points().approx())
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return 0x1p-47 * largest;
}

/// All triangles that may be the first, and others.
void OppositeSearch::find_candidates(FaceId face, const InwardRay& ray) {
  candidates_.clear();
  const RoundedRay rounded(ray, margin_);
  const std::vector<Vec3>& points = solid_.mesh.points().approx();
  double most = kUnbounded;  // the first triangle is not farther
  solid_.hierarchy().for_each_where(
      [&](const Box3& box) { return rounded.may_meet(box, most); },
      [&](std::uint32_t other) {
        if (FaceId(other) == face) return;
        const auto [a, b, c] = solid_.mesh.triangle(FaceId(other));
        const RoundedMeeting meeting = rounded.meeting({points[a], points[b], points[c]});
        if (meeting.kind == RoundedMeeting::Kind::missed || meeting.to < 0 || meeting.from > most) return;
        candidates_.push_back({FaceId(other), meeting.from, meeting.to});
        if (meeting.kind == RoundedMeeting::Kind::met && meeting.from > 0) most = std::min(most, meeting.to);
      });
  std::erase_if(candidates_, [&](const Candidate& candidate) { return candidate.from > most; });
}

/// True if the line meets two triangles in an edge or corner that they have in common.
bool OppositeSearch::meet_in_one_point(FaceId a, const InwardRay::Meeting& of_a, FaceId b,
                                       const InwardRay::Meeting& of_b) const {
  // The corners at edges through which the line passes.
  const auto touched = [&](FaceId face, const InwardRay::Meeting& meeting) {
    std::array<std::pair<std::uint32_t, std::uint32_t>, 3> edges;
    std::size_t count = 0;
    const TriangleMesh::Triangle corners = solid_.mesh.triangle(face);
    for (std::size_t i = 0; i < 3; ++i)
      if (meeting.sides[i] == 0) edges[count++] = std::minmax({corners[i], corners[(i + 1) % 3]});
    return std::pair(edges, count);
  };
  const auto [edges_of_a, count_of_a] = touched(a, of_a);
  const auto [edges_of_b, count_of_b] = touched(b, of_b);
  for (std::size_t i = 0; i < count_of_a; ++i)
    for (std::size_t j = 0; j < count_of_b; ++j)
      if (edges_of_a[i] == edges_of_b[j]) return true;
  return false;
}

std::optional<OppositeSearch::Opposite> OppositeSearch::first_of_candidates(const InwardRay& ray) const {
  std::optional<std::pair<FaceId, InwardRay::Meeting>> first;
  for (const Candidate& candidate : candidates_) {
    const std::optional<InwardRay::Meeting> meeting = ray.meeting(solid_.mesh.corners(candidate.face));
    if (!meeting) return std::nullopt;
    if (!meeting->is_met()) continue;
    const std::optional<int> direction = meeting->direction();
    if (!direction) return std::nullopt;
    // Others may touch the centroid: the ray is inside right behind it, and must leave.
    if (*direction <= 0) continue;
    if (!first) {
      first.emplace(candidate.face, *meeting);
      continue;
    }
    std::optional<int> order = order_on_ray(*meeting, first->second);
    if (!order && meet_in_one_point(candidate.face, *meeting, first->first, first->second)) order = 0;
    if (!order) return std::nullopt;
    if (*order < 0 || (*order == 0 && candidate.face < first->first)) first.emplace(candidate.face, *meeting);
  }
  if (!first) return std::nullopt;
  const std::optional<double> thickness = ray.distance(first->second);
  return thickness ? std::optional(Opposite{first->first, *thickness}) : std::nullopt;
}

std::optional<OppositeSearch::Opposite> OppositeSearch::behind(FaceId face) {
  const std::optional<InwardRay> ray = InwardRay::from(solid_.mesh.corners(face));
  if (!ray) return std::nullopt;
  find_candidates(face, *ray);
  return first_of_candidates(*ray);
}

}  // namespace algebra3d
