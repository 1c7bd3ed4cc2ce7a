// Masks over rings: what they reproduce, and long rings against short sums.
#include "algebra3d/kernel/subdivision/detail/ring_masks.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace algebra3d::subdivision {
namespace {

constexpr double kPi = std::numbers::pi;

/// On the unit circle from angle 0: x, y and x y.
std::vector<Vec3> arc(std::size_t count, double step) {
  std::vector<Vec3> ring;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = static_cast<double>(i) * step;
    ring.push_back({std::cos(angle), std::sin(angle), std::cos(angle) * std::sin(angle)});
  }
  return ring;
}

/// What is linear is halved on the way to a neighbour, and x y is quartered.
void expect_half_way(const Vec3& made, const Vec3& neighbour) {
  EXPECT_NEAR(made.x, neighbour.x / 2, 1e-14);
  EXPECT_NEAR(made.y, neighbour.y / 2, 1e-14);
  EXPECT_NEAR(made.z, neighbour.z / 4, 1e-14);
}

TEST(RingMasks, interior_edge_points_reproduce_the_plane) {
  for (std::size_t n = 5; n < 40; ++n) {
    const auto ring = arc(n, 2 * kPi / static_cast<double>(n));
    std::vector<Vec3> made;
    interior_edge_points({}, ring, made);
    for (std::size_t i = 0; i < n; ++i) expect_half_way(made[i], ring[i]);
  }
}

TEST(RingMasks, boundary_edge_points_reproduce_the_plane) {
  for (std::size_t k = 2; k < 40; ++k) {
    const auto ring = arc(k + 1, kPi / static_cast<double>(k));
    std::vector<Vec3> made;
    boundary_edge_points({}, ring, made);
    for (std::size_t i = 1; i < k; ++i) expect_half_way(made[i], ring[i]);
    // Weights sum to one.
    const Vec3 one{1, -2, 3};
    boundary_edge_points(one, std::vector<Vec3>(k + 1, one), made);
    for (std::size_t i = 1; i < k; ++i) EXPECT_LE(length(made[i] - one), 1e-14);
  }
}

TEST(RingMasks, long_rings_have_the_weights_of_the_papers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (const std::size_t n : {5U, 9U, 16U, 17U, 30U, 101U}) {
    std::vector<Vec3> ring;
    for (std::size_t i = 0; i < n; ++i) ring.push_back({coordinate(random), coordinate(random), coordinate(random)});
    std::vector<Vec3> corners, edges;
    doo_sabin_corners(ring, corners);
    interior_edge_points({}, ring, edges);
    const auto m = static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
      Vec3 corner, edge;
      for (std::size_t j = 0; j < n; ++j) {
        const double angle = 2 * kPi * (static_cast<double>(i) - static_cast<double>(j)) / m;
        corner = corner + (i == j ? (m + 5) / (4 * m) : (3 + 2 * std::cos(angle)) / (4 * m)) * ring[j];
        edge = edge + ((0.25 + std::cos(angle) + std::cos(2 * angle) / 2) / m) * ring[j];
      }
      EXPECT_LE(length(corners[i] - corner), 1e-14);
      EXPECT_LE(length(edges[i] - edge), 1e-14);
    }
  }
}

}  // namespace
}  // namespace algebra3d::subdivision
