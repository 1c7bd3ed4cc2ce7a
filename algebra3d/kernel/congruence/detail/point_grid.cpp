#include "algebra3d/kernel/congruence/detail/point_grid.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <span>

namespace algebra3d::detail {
namespace {

PointGrid grid_of(const std::vector<Vec3>& points, std::span<const std::uint32_t> numbers, double cell) {
  PointGrid grid(points, cell);
  for (const std::uint32_t number : numbers) grid.insert(number);
  return grid;
}

}  // namespace

ClosestPair closest_pair(const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::shuffle(order, std::mt19937(1));  // NOLINT(cert-msc51-cpp): the same pair each time
  const auto distance = [&](std::uint32_t a, std::uint32_t b) { return length(points[a] - points[b]); };
  ClosestPair closest{order[0], order[1], distance(order[0], order[1])};
  std::optional<PointGrid> grid(grid_of(points, {order.data(), 2}, closest.distance));
  for (std::size_t i = 2; i < order.size() && closest.distance > 0; ++i) {
    const std::uint32_t number = order[i];
    const double before = closest.distance;
    grid->for_each_near(points[number], before, [&](std::uint32_t other) {
      if (const double its = distance(number, other); its < closest.distance) closest = {number, other, its};
      return true;
    });
    if (closest.distance == before)
      grid->insert(number);
    else if (closest.distance > 0)
      grid.emplace(grid_of(points, {order.data(), i + 1}, closest.distance));
  }
  return closest;
}

}  // namespace algebra3d::detail
