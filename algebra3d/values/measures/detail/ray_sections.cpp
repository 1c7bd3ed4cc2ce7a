#include "algebra3d/values/measures/detail/ray_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace algebra3d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Finds out, in rounded arithmetic, which boxes a ray certainly misses.
class RayFilter {
 public:
  explicit RayFilter(const Ray& ray) {
    Rational largest;
    for (std::size_t axis = 0; axis < 3; ++axis) largest = std::max(largest, ray.direction[axis].abs());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin_[axis] = ray.origin[axis].nearest_double();
      sign_[axis] = ray.direction[axis].sign();
      direction_[axis] = (ray.direction[axis] / largest).nearest_double();
    }
  }

  bool may_meet(const Box3& box) const {
    double begin = 0, end = kInfinity;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double size = std::max({std::abs(origin_[axis]), std::abs(box.min[axis]), std::abs(box.max[axis])});
      const double margin = 0x1p-49 * size + kRounding;
      const double low = box.min[axis] - origin_[axis] - margin, high = box.max[axis] - origin_[axis] + margin;
      if (sign_[axis] == 0) {
        if (low > 0 || high < 0) return false;
      } else if (std::abs(direction_[axis]) > kLeast) {
        const double first = low / direction_[axis], second = high / direction_[axis];
        const double near = std::min(first, second), far = std::max(first, second);
        begin = std::max(begin, near - std::abs(near) * 0x1p-50 - kRounding);
        end = std::min(end, far + std::abs(far) * 0x1p-50 + kRounding);
      }
    }
    return !(begin > end);
  }

 private:
  static constexpr double kLeast = 0x1p-500;      // of components that limit a ray
  static constexpr double kRounding = 0x1p-1070;  // of subnormal numbers, more than that

  Vec3 origin_, direction_;
  std::array<int, 3> sign_{};
};

/// Finds out, by signs, which triangles the line of a ray meets.
class Line {
 public:
  enum class Meeting : std::uint8_t { none, some, unknown };

  explicit Line(const Ray& ray) : begin_(ray.origin) {
    const RationalVec3 end = ray.origin + ray.direction;
    is_known_ = true;
    for (std::size_t axis = 0; axis < 3; ++axis) is_known_ = is_known_ && std::isfinite(end[axis].nearest_double());
    if (is_known_) end_ = ExactPoint(end);
  }

  /// Exact for triangles that are not coplanar with the line; `some` for all that are. Unknown if the end of the
  /// direction is beyond the range of doubles.
  Meeting meeting(const TriangleRef& triangle) const {
    if (!is_known_) return Meeting::unknown;
    bool is_left = false, is_right = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const int side = orient3d(begin_, end_, triangle[i], triangle[(i + 1) % 3]);
      is_left = is_left || side > 0;
      is_right = is_right || side < 0;
    }
    return is_left && is_right ? Meeting::none : Meeting::some;
  }

 private:
  ExactPoint begin_, end_;
  bool is_known_ = false;
};

/// Clips a section by the edges of the triangle, in a projection in which it is not degenerate. False if nothing is
/// left.
bool clip(const Ray& ray, const std::array<RationalVec3, 3>& corners, Projection plane, int turn, Rational& first,
          std::optional<Rational>& last) {
  const std::size_t x = first_axis(plane), y = second_axis(plane);
  for (std::size_t i = 0; i < 3; ++i) {
    const RationalVec3 &a = corners[i], &b = corners[(i + 1) % 3];
    const Rational edge_x = turn * (b[x] - a[x]), edge_y = turn * (b[y] - a[y]);
    // Not negative on the inner side of the edge: constant + t * slope.
    const Rational constant = edge_x * (ray.origin[y] - a[y]) - edge_y * (ray.origin[x] - a[x]);
    const Rational slope = edge_x * ray.direction[y] - edge_y * ray.direction[x];
    if (slope.sign() == 0) {
      if (constant.sign() < 0) return false;
      continue;
    }
    Rational bound = -constant / slope;
    if (slope.sign() > 0)
      first = std::max(first, bound);
    else if (!last || bound < *last)
      last = std::move(bound);
  }
  return !last || first <= *last;
}

/// The section of a triangle that is not degenerate; nothing if the ray misses it. `is_met` says that the line of the
/// ray meets it or is coplanar with it.
std::optional<RaySection> section_of_triangle(const Ray& ray, const TriangleRef& triangle, bool is_met) {
  const std::array<RationalVec3, 3> corners{triangle[0].rational(), triangle[1].rational(), triangle[2].rational()};
  const RationalVec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const Rational height = dot(normal, corners[0] - ray.origin), rise = dot(normal, ray.direction);
  Rational first(0);
  std::optional<Rational> last;
  if (rise.sign() == 0) {
    if (height.sign() != 0) return std::nullopt;
  } else {
    last = first = height / rise;
    if (first.sign() < 0) return std::nullopt;
  }
  if (rise.sign() != 0 && is_met) return RaySection{first, first, {}, rise.sign()};
  const auto [plane, turn] = dominant_turn(triangle);
  if (rise.sign() != 0) {
    // The only point is clipped as a ray of its own, without a direction.
    Rational begin(0);
    std::optional<Rational> end;
    if (!clip({ray.at(first), RationalVec3()}, corners, plane, turn, begin, end)) return std::nullopt;
  } else if (!clip(ray, corners, plane, turn, first, last)) {
    return std::nullopt;
  }
  return RaySection{std::move(first), *std::move(last), {}, rise.sign()};
}

}  // namespace

std::vector<RaySection> sections_of(const Ray& ray, const Geometry& geometry) {
  std::vector<RaySection> sections;
  const RayFilter boxes(ray);
  const Line line(ray);
  const auto add = [&](std::uint32_t face) {
    const TriangleRef triangle = geometry.mesh.corners(FaceId(face));
    const Line::Meeting meeting = line.meeting(triangle);
    if (meeting == Line::Meeting::none) return;
    std::optional<RaySection> section = section_of_triangle(ray, triangle, meeting == Line::Meeting::some);
    if (!section) return;
    section->face = FaceId(face);
    sections.push_back(*std::move(section));
  };
  geometry.hierarchy().for_each_where([&](const Box3& box) { return boxes.may_meet(box); }, add);
  std::ranges::sort(sections, {}, [](const RaySection& section) { return std::tie(section.first, section.face); });
  return sections;
}

}  // namespace algebra3d
