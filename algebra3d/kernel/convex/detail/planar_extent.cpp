#include "algebra3d/kernel/convex/detail/planar_extent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

}  // namespace algebra3d::detail
