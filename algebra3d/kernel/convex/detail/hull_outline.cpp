#include "algebra3d/kernel/convex/detail/hull_outline.h"

#include <numbers>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/predicates_filter.h"
#include "algebra3d/kernel/exact/principal_axes.h"
#include "base/interruption_scope.h"

namespace algebra3d::detail {
namespace {

double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double apart(const PlanePoint& a, const PlanePoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

PlaneCircle circle_of(const PlanePoint& a, const PlanePoint& b) {
  const PlanePoint centre{(a.x + b.x) / 2, (a.y + b.y) / 2};
  return {centre, std::max(apart(centre, a), apart(centre, b))};
}

PlaneCircle circle_of(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, area = 2 * (bx * cy - by * cx);
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const PlanePoint centre{a.x + (cy * b2 - by * c2) / area, a.y + (bx * c2 - cx * b2) / area};
  return {centre, std::max({apart(centre, a), apart(centre, b), apart(centre, c)})};
}

bool has_outside(const PlaneCircle& circle, const PlanePoint& p) {
  return apart(circle.centre, p) > circle.radius * (1 + 0x1p-45);
}

constexpr std::size_t kMaxPoints = 400;   // for one search, so that a direction takes some ten microseconds
constexpr std::size_t kMaxNormals = 200;  // that are tried first

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (const Vec3& p : points) sum = sum + p;
  return 1 / static_cast<double>(points.size()) * sum;
}

/// Vertices that are farthest in evenly spread directions, along a spiral of golden angles.
std::vector<Vec3> spread_points(const std::vector<Vec3>& points) {
  if (points.size() <= kMaxPoints) return points;
  std::vector<Vec3> chosen;
  for (std::size_t i = 0; i < kMaxPoints; ++i) {
    poll_interruption();
    const double z = 1 - (2 * static_cast<double>(i) + 1) / kMaxPoints, around = std::sqrt(1 - z * z);
    const double angle = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5.0));
    const Vec3 direction{around * std::cos(angle), around * std::sin(angle), z};
    chosen.push_back(*std::ranges::max_element(points, {}, [&](const Vec3& p) { return dot(p, direction); }));
  }
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

/// The direction in which the points, which are of the size 1, spread most unlike in the others; a place to begin. All
/// entries of the matrix are multiples of a small part of its trace, so that its exact axes cost little for needles and
/// sheets too.
Vec3 main_axis_of(const std::vector<Vec3>& points) {
  double xx = 0, yy = 0, zz = 0, yz = 0, zx = 0, xy = 0;
  for (const Vec3& p : points) {
    xx += p.x * p.x, yy += p.y * p.y, zz += p.z * p.z;
    yz += p.y * p.z, zx += p.z * p.x, xy += p.x * p.y;
  }
  const double trace = xx + yy + zz;
  if (!(trace > 0)) return {1, 0, 0};  // far from the origin, exact points may have the same nearest doubles
  const auto coarse = [trace](double entry) { return Rational((entry + trace) - trace); };
  const Rational least(0x1p-40 * trace);  // makes all eigenvalues positive, and leaves the axes where they are
  const PrincipalAxes axes =
      principal_axes({coarse(xx) + least, coarse(yy) + least, coarse(zz) + least, coarse(yz), coarse(zx), coarse(xy)});
  const auto& [low, middle, high] = axes.values;
  return high * low > middle * middle ? axes.axes[2] : axes.axes[0];
}

}  // namespace

std::vector<PlanePoint> planar_hull(std::vector<PlanePoint> points) {
  std::ranges::sort(points,
                    [](const PlanePoint& a, const PlanePoint& b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  std::vector<PlanePoint> hull;
  // The lower chain, then the upper one on top of it.
  for (int chain = 0; chain < 2; ++chain) {
    const std::size_t base = hull.size();
    for (const PlanePoint& p : points) {
      while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

PlaneRectangle smallest_rectangle(std::span<const PlanePoint> hull) {
  PlaneRectangle best{{1, 0}, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const PlanePoint &p = hull[i], &q = hull[(i + 1) % hull.size()];
    const double size = apart(p, q);
    if (size == 0) continue;
    const PlanePoint along{(q.x - p.x) / size, (q.y - p.y) / size};
    double left = 0, right = 0, high = 0;
    for (const PlanePoint& r : hull) {
      const double x = (r.x - p.x) * along.x + (r.y - p.y) * along.y, y = (r.y - p.y) * along.x - (r.x - p.x) * along.y;
      left = std::min(left, x), right = std::max(right, x), high = std::max(high, y);
    }
    if ((right - left) * high < best.area) best = {along, (right - left) * high};
  }
  if (std::isinf(best.area)) best.area = 0;  // one point
  return best;
}

double diameter(std::span<const PlanePoint> hull) {
  double largest = 0;
  for (const PlanePoint& p : hull)
    for (const PlanePoint& q : hull) largest = std::max(largest, apart(p, q));
  return largest;
}

// Incremental; the order of the points decides the time only. Points within rounding of the circle count as inside; the
// radius is enlarged to hold them in the end.
PlaneCircle smallest_circle(std::span<const PlanePoint> points) {
  PlaneCircle circle{points.empty() ? PlanePoint{} : points[0], 0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!has_outside(circle, points[i])) continue;
    circle = {points[i], 0};
    for (std::size_t j = 0; j < i; ++j) {
      if (!has_outside(circle, points[j])) continue;
      circle = circle_of(points[i], points[j]);
      for (std::size_t k = 0; k < j; ++k)
        if (has_outside(circle, points[k])) circle = circle_of(points[i], points[j], points[k]);
    }
  }
  for (const PlanePoint& p : points) circle.radius = std::max(circle.radius, apart(circle.centre, p));
  return circle;
}

HullOutline::HullOutline(const TriangleMesh& hull) {
  const Box3 box = Box3::around(hull.points().approx());
  const Vec3 half = 0.5 * box.max - 0.5 * box.min, centre = box.min + half;
  unit_ = length_unit(box);
  std::vector<Vec3> vertices;
  for (const Vec3& p : hull.points().approx()) {
    const Vec3 relative = p - centre;
    vertices.push_back({relative.x / unit_, relative.y / unit_, relative.z / unit_});
  }
  const Vec3 inside = mean_of(vertices);
  for (Vec3& p : vertices) p = p - inside;

  inner_radius_ = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, Vec3>> facets;
  for (std::size_t f = 0; f < hull.face_count(); ++f) {
    poll_interruption_at(f);
    const auto [a, b, c] = hull.triangle(FaceId(f));
    const Vec3 normal = cross(vertices[b] - vertices[a], vertices[c] - vertices[a]);
    const double area = length(normal);
    if (!(area > 0)) {
      inner_radius_ = 0;
      continue;
    }
    inner_radius_ = std::min(inner_radius_, dot(1 / area * normal, vertices[a]));
    facets.emplace_back(-area, 1 / area * normal);
  }
  inner_radius_ = std::max(0.0, inner_radius_ - 0x1p-40);  // for roundings
  const std::size_t normal_count = std::min(kMaxNormals, facets.size());
  std::ranges::partial_sort(facets, facets.begin() + static_cast<std::ptrdiff_t>(normal_count));
  for (std::size_t i = 0; i < normal_count; ++i) normals_.push_back(facets[i].second);

  points_ = spread_points(vertices);
  for (const Vec3& p : points_) radius_ = std::max(radius_, length(p));
  main_axis_ = main_axis_of(points_);
}

HullOutline::View HullOutline::seen_along(const Vec3& direction) const {
  poll_interruption();  // some microseconds, up to a millisecond where a projection has many corners
  View view;
  const Vec3 across = cross(direction, std::abs(direction.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  view.x_axis = 1 / length(across) * across;
  view.y_axis = cross(direction, view.x_axis);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::vector<PlanePoint> projected;
  projected.reserve(points_.size());
  for (const Vec3& p : points_) {
    const double height = dot(p, direction);
    low = std::min(low, height), high = std::max(high, height);
    projected.push_back({dot(p, view.x_axis), dot(p, view.y_axis)});
  }
  view.height = high - low;
  view.outline = planar_hull(std::move(projected));
  return view;
}

}  // namespace algebra3d::detail
