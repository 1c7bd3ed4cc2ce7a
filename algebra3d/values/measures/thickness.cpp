#include "algebra3d/values/measures/thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "algebra3d/kernel/exact/inward_ray.h"
#include "algebra3d/kernel/search/oriented_boxes.h"
#include "algebra3d/values/measures/detail/ray_sections.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// Finds the triangle opposite to another one, that which a ray from its centroid meets first, straight inwards.
/// Rounded arithmetic with bounds finds the few that may be it; pairs of doubles decide. Refers to the solid. A search
/// belongs to one thread.
class OppositeSearch {
 public:
  /// `margin`: that of the solid.
  OppositeSearch(const Geometry& solid, double margin)
      : solid_(solid), boxes_(solid.hierarchy().oriented_boxes(solid.mesh)), margin_(margin) {}
  /// Above the errors of rounded places: centroids, corners and places are off by some roundings of the largest
  /// coordinate.
  static double margin_of(const Geometry& solid);

  struct Opposite {
    FaceId face;           ///< the lowest of the triangles that the ray meets there
    double thickness = 0;  ///< rounded to nearest
  };
  /// Nothing if pairs of doubles do not decide. Exact. Cost: that of the boxes that the ray meets up to there, some
  /// nanoseconds each, and some microseconds.
  std::optional<Opposite> behind(FaceId face);

 private:
  struct Candidate {
    FaceId face;
    double from = 0, to = 0;  ///< bounds of its place on the ray
  };

  void find_candidates(FaceId face, const InwardRay& ray);
  std::optional<Opposite> first_of_candidates(const InwardRay& ray) const;
  bool meet_in_one_point(FaceId a, const InwardRay::Meeting& of_a, FaceId b, const InwardRay::Meeting& of_b) const;

  const Geometry& solid_;
  const OrientedBoxes* boxes_;  // null where those along the axes do
  double margin_;
  std::vector<Candidate> candidates_;
};

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
      : origin_(ray.origin()), direction_(ray.direction()), margin_(margin) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      is_across_[axis] = is_across(direction_[axis]);
      inverse_[axis] = is_across_[axis] ? 0 : 1 / direction_[axis];
    }
  }

  /// A lower bound of where the ray meets the box of a node of a hierarchy, the oriented one if there are any; infinite
  /// if it misses it.
  double place_of(const BoxHierarchy& hierarchy, const OrientedBoxes* boxes, BoxHierarchy::Node node) const {
    const BoxHierarchy::Frame& frame = hierarchy.frame();
    const BoxHierarchy::Place box = hierarchy.place(node);
    const double unit = 2 / frame.scale;
    Vec3 middle;
    for (std::size_t axis = 0; axis < 3; ++axis)
      middle[axis] = box.middle[axis] * unit + (frame.origin[axis] - origin_[axis]);
    const Section section =
        boxes == nullptr ? section_of(box, middle, unit) : section_of(boxes->box(node), middle, unit);
    return section.begin > section.end + margin_ ? kUnbounded : section.begin - margin_;
  }

  RoundedMeeting meeting(const std::array<Vec3, 3>& corners) const {
    std::array<Vec3, 3> relative;
    std::array<double, 3> sizes{};  // at least the lengths
    for (std::size_t i = 0; i < 3; ++i) {
      relative[i] = corners[i] - origin_;
      sizes[i] = std::abs(relative[i].x) + std::abs(relative[i].y) + std::abs(relative[i].z);
    }
    std::array<double, 3> sides{};
    double least = kUnbounded, most = -kUnbounded, largest_error = 0;
    bool is_left = false, is_right = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = i < 2 ? i + 1 : 0;
      sides[i] = dot(direction_, cross(relative[i], relative[j]));
      const double error = 4 * margin_ * (sizes[i] + sizes[j]) + 0x1p-47 * sizes[i] * sizes[j];
      is_left = is_left || sides[i] > error;
      is_right = is_right || sides[i] < -error;
      largest_error = std::max(largest_error, error);
      least = std::min(least, sides[i] - error);
      most = std::max(most, sides[i] + error);
    }
    if (is_left && is_right) return {RoundedMeeting::Kind::missed, 0, 0};
    std::array<double, 3> heights{};
    for (std::size_t i = 0; i < 3; ++i) heights[i] = dot(direction_, relative[i]);
    const auto [low, high] = std::minmax({heights[0], heights[1], heights[2]});
    RoundedMeeting result{RoundedMeeting::Kind::open, low - margin_, high + margin_};
    if (least > 0 || most < 0) {
      result.kind = RoundedMeeting::Kind::met;
      const double sum = sides[0] + sides[1] + sides[2];
      const double place = (sides[0] * heights[2] + sides[1] * heights[0] + sides[2] * heights[1]) / sum;
      const double error = 8 * largest_error / std::abs(sum) * (high - low) + 2 * margin_;
      result.from = std::max(result.from, place - error);
      result.to = std::min(result.to, place + error);
    }
    return result;
  }

 private:
  /// Between which places the ray is in a box.
  struct Section {
    double begin, end;

    void cut(double first, double second) {
      begin = std::max(begin, std::min(first, second));
      end = std::min(end, std::max(first, second));
    }
    static Section none() { return {kUnbounded, -kUnbounded}; }
  };

  static bool is_across(double component) { return std::abs(component) < 0x1p-60; }

  /// In the box of a node, whose middle is given from the ray's origin.
  Section section_of(const BoxHierarchy::Place& box, const Vec3& middle, double unit) const {
    // Boxes reach 2^20 units of the frame, where floats are 2^-3 apart.
    constexpr double kRounding = 0.25;
    Section section{-margin_, kUnbounded};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double half = (box.half[axis] + kRounding) * unit + margin_;
      if (!is_across_[axis])
        section.cut((middle[axis] - half) * inverse_[axis], (middle[axis] + half) * inverse_[axis]);
      else if (std::abs(middle[axis]) > half)
        return Section::none();
    }
    return section;
  }

  /// The section of the ray in an oriented box. The margin is above what the rounding of the direction moves the ray
  /// aside within twice the extent of the solid.
  Section section_of(const OrientedBoxes::Box& box, const Vec3& middle, double unit) const {
    Section section{-margin_, kUnbounded};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 axis = box.axis(i);
      const double along = dot(axis, direction_), offset = dot(axis, middle);
      const double low = offset + box.low[i] * unit - 2 * margin_, high = offset + box.high[i] * unit + 2 * margin_;
      if (!is_across(along))
        section.cut(low / along, high / along);
      else if (low > 0 || high < 0)
        return Section::none();
    }
    return section;
  }

  Vec3 origin_, direction_;
  Vec3 inverse_;                     // of each component of the direction; 0 where the ray is across the axis
  std::array<bool, 3> is_across_{};  // at right angles to the axis but for roundings
  double margin_;
};

double OppositeSearch::margin_of(const Geometry& solid) {
  double largest = 0;
  for (const Vec3& p : solid.mesh.points().approx())
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return 0x1p-47 * largest;
}

/// Calls visit(f) for the faces of all nodes that a ray meets, near ones first; it returns a place beyond which faces
/// are of no interest from then on.
template <typename Visit>
void for_each_along(const RoundedRay& ray, const BoxHierarchy& hierarchy, const OrientedBoxes* boxes, Visit visit) {
  struct PlacedNode {
    BoxHierarchy::Node node;
    double place;
  };
  double limit = kUnbounded;
  std::vector<PlacedNode> stack{{hierarchy.root(), 0}};
  while (!stack.empty()) {
    const auto [node, place] = stack.back();
    stack.pop_back();
    if (place > limit) continue;
    if (node.level == 0) {
      for (const std::uint32_t face : hierarchy.leaf_faces(node.index)) limit = visit(face);
      continue;
    }
    const std::size_t before = stack.size();
    const std::uint32_t end = std::min(2 * node.index + 2, hierarchy.node_count(node.level - 1));
    for (std::uint32_t index = 2 * node.index; index < end; ++index) {
      const BoxHierarchy::Node child{node.level - 1, index};
      const double of_child = ray.place_of(hierarchy, boxes, child);
      if (of_child < kUnbounded && of_child <= limit) stack.push_back({child, of_child});
    }
    if (stack.size() == before + 2 && stack[before].place < stack[before + 1].place)
      std::swap(stack[before], stack[before + 1]);
  }
}

/// All triangles that may be the first, and others.
void OppositeSearch::find_candidates(FaceId face, const InwardRay& ray) {
  candidates_.clear();
  const RoundedRay rounded(ray, margin_);
  const std::vector<Vec3>& points = solid_.mesh.points().approx();
  double most = kUnbounded;  // the first triangle is not farther
  for_each_along(rounded, solid_.hierarchy(), boxes_, [&](std::uint32_t other) {
    if (FaceId(other) == face) return most;
    const auto [a, b, c] = solid_.mesh.triangle(FaceId(other));
    const RoundedMeeting meeting = rounded.meeting({points[a], points[b], points[c]});
    if (meeting.kind == RoundedMeeting::Kind::missed || meeting.to < 0 || meeting.from > most) return most;
    candidates_.push_back({FaceId(other), meeting.from, meeting.to});
    if (meeting.kind == RoundedMeeting::Kind::met && meeting.from > 0) most = std::min(most, meeting.to);
    return most;
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

RationalVec3 exact_centroid(const TriangleRef& triangle) {
  return Rational(1, 3) * (triangle[0].rational() + triangle[1].rational() + triangle[2].rational());
}

/// By exact sections of all triangles that the ray may meet.
FacetThickness exact_thickness_behind(const Geometry& solid, FaceId face) {
  const TriangleRef triangle = solid.mesh.corners(face);
  const RationalVec3 corner = triangle[0].rational();
  const RationalVec3 u = triangle[1].rational() - corner, v = triangle[2].rational() - corner;
  const Ray ray{exact_centroid(triangle), cross(v, u)};
  const std::vector<RaySection> sections = sections_of(ray, solid);
  // Other triangles may touch the centroid. The ray is inside right behind it, and must leave.
  const auto opposite =
      std::ranges::find_if(sections, [](const RaySection& section) { return section.first.sign() > 0; });
  const Rational square = opposite->first * opposite->first * dot(ray.direction, ray.direction);
  return {face, opposite->face, square.nearest_root()};
}

FacetThickness thickness_behind(OppositeSearch& search, const Geometry& solid, FaceId face) {
  const std::optional<OppositeSearch::Opposite> opposite = search.behind(face);
  return opposite ? FacetThickness{face, opposite->face, opposite->thickness} : exact_thickness_behind(solid, face);
}

}  // namespace

Result<std::vector<FacetThickness>> facet_thicknesses(const Volume3d& solid, const Monitor& monitor) {
  constexpr std::size_t kTask = 64;
  const Geometry& geometry = solid.geometry();
  const double margin = OppositeSearch::margin_of(geometry);
  const Stage stage(monitor, "measuring thickness", geometry.mesh.face_count());
  std::vector<FacetThickness> all =
      parallel_collect(geometry.mesh.face_count(), kTask, [&](std::size_t begin, std::size_t end) {
        std::vector<FacetThickness> part;
        Stage own(stage);
        OppositeSearch search(geometry, margin);
        for (std::size_t f = begin; f < end && own.begin_step(); ++f)
          part.push_back(thickness_behind(search, geometry, FaceId(f)));
        return part;
      });
  A3D_TRY(monitor.check());
  return all;
}

ExactPoint centroid_of(const TriangleRef& triangle) {
  return ExactPoint(exact_centroid(triangle));
}

}  // namespace algebra3d
