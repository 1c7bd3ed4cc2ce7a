#include "algebra3d/kernel/repair/detail/surface_distance.h"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>

namespace algebra3d {
namespace {

Vec3 middle_of(const Triangle3& t) {
  return (1.0 / 3) * t[0] + (1.0 / 3) * t[1] + (1.0 / 3) * t[2];
}

std::array<Triangle3, 4> quarters(const Triangle3& t) {
  const Vec3 ab = 0.5 * (t[0] + t[1]), bc = 0.5 * (t[1] + t[2]), ca = 0.5 * (t[2] + t[0]);
  return {{{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}}};
}

/// The largest distance of a point of a triangle from another one. Distances from one triangle are convex, so it is
/// that of a corner.
double farthest_corner(const Triangle3& triangle, const Triangle3& other) {
  double result = 0;
  for (const Vec3& corner : triangle) result = std::max(result, distance(corner, other));
  return result;
}

/// No point of a triangle is farther from its middle than a corner.
double radius_about(const Vec3& middle, const Triangle3& triangle) {
  double result = 0;
  for (const Vec3& corner : triangle) result = std::max(result, length(corner - middle));
  return result;
}

/// A triangle of which some point may be that far away.
struct Open {
  double at_most;
  std::uint32_t number;  // ties are broken in the order in which they came
  Triangle3 triangle;

  friend bool operator<(const Open& a, const Open& b) {
    return a.at_most != b.at_most ? a.at_most < b.at_most : a.number > b.number;
  }
};

}  // namespace

SurfaceDistance::SurfaceDistance(std::vector<Triangle3> triangles) : triangles_(std::move(triangles)) {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) entries.push_back({box_of(triangles_[i]), i});
  tree_ = rtree::RTree<std::uint32_t>::bulk_load(entries);
}

SurfaceDistance::Nearest SurfaceDistance::nearest(const Vec3& point) const {
  Nearest best{std::numeric_limits<double>::infinity(), 0};
  auto cursor = tree_.nearest(Box3::of(point));
  for (auto next = cursor.next(); next && next->distance < best.distance; next = cursor.next())
    if (const double away = distance(point, triangles_[next->payload]); away < best.distance)
      best = {away, next->payload};
  return best;
}

FarthestBounds SurfaceDistance::bounds(const Triangle3& triangle) const {
  const Vec3 middle = middle_of(triangle);
  const Nearest from_middle = nearest(middle);
  FarthestBounds result{from_middle.distance, std::numeric_limits<double>::infinity(), middle};
  if (is_empty()) return result;
  result.at_most = std::min(farthest_corner(triangle, triangles_[from_middle.triangle]),
                            from_middle.distance + radius_about(middle, triangle));
  return result;
}

/// The answer of one search, in the window around the middle, to whether all of a triangle is near. The window is wider
/// than the distance, since its sides are rounded.
SurfaceDistance::Nearness SurfaceDistance::nearness(const Triangle3& triangle, double distance) const {
  const Vec3 middle = middle_of(triangle);
  const double margin = 2 * distance;
  const Vec3 around{margin, margin, margin};
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t number : tree_.window(Box3{middle - around, middle + around})) {
    const double away = algebra3d::distance(middle, triangles_[number]);
    if (away > distance) continue;
    if (farthest_corner(triangle, triangles_[number]) <= distance) return Nearness::near;
    nearest = std::min(nearest, away);
  }
  if (!(nearest <= distance)) return Nearness::far;
  return nearest + radius_about(middle, triangle) <= distance ? Nearness::near : Nearness::unknown;
}

bool SurfaceDistance::is_near(const Triangle3& triangle, double distance) const {
  constexpr int kMostLooks = 100;
  std::vector<Triangle3> open{triangle};
  for (int looks = 0; !open.empty(); ++looks) {
    if (looks == kMostLooks) return false;
    const Triangle3 next = open.back();
    open.pop_back();
    const Nearness found = nearness(next, distance);
    if (found == Nearness::far) return false;
    if (found == Nearness::unknown)
      for (const Triangle3& part : quarters(next)) open.push_back(part);
  }
  return true;
}

FarthestBounds SurfaceDistance::farthest(std::span<const Triangle3> triangles) const {
  constexpr std::uint32_t kMostLooks = 40'000;
  constexpr double kApart = 1.01;
  FarthestBounds best;
  std::priority_queue<Open> open;
  std::uint32_t looks = 0;
  const auto look_at = [&](const Triangle3& triangle) {
    const FarthestBounds found = bounds(triangle);
    if (found.at_least > best.at_least) best = {found.at_least, 0, found.where};
    if (found.at_most > best.at_least) open.push({found.at_most, looks, triangle});
    ++looks;
  };
  for (const Triangle3& triangle : triangles) {
    // Corners alone first: as a rule an open patch is farthest away in one of them.
    for (const Vec3& corner : triangle)
      if (const double away = to(corner); away > best.at_least) best = {away, 0, corner};
    look_at(triangle);
  }
  const std::uint32_t most = looks + kMostLooks;
  while (!open.empty() && open.top().at_most > kApart * best.at_least && looks < most) {
    const Open next = open.top();
    open.pop();
    for (const Triangle3& part : quarters(next.triangle)) look_at(part);
  }
  best.at_most = std::max(best.at_least, open.empty() ? 0 : open.top().at_most);
  return best;
}

}  // namespace algebra3d
