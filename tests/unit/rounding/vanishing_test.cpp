#include "algebra3d/kernel/rounding/detail/vanishing.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/predicates.h"
#include "support/rounds.h"

namespace algebra3d {
namespace {

using Corners = std::array<Vec3, 4>;

bool finds_cell(const TriangleMesh& solid, double depth) {
  return *has_inner_cell(solid, CoordinateGrid::multiples(1), depth, nullptr);
}

/// Corners of a tetrahedron: random ones, flattened along an axis; multiples of 1/1024.
Corners random_corners(std::mt19937_64& random, double size, double thickness) {
  for (;;) {
    Corners corners;
    for (Vec3& corner : corners)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double range = axis == 2 ? thickness : size;
        corner[axis] = std::round(std::uniform_real_distribution<double>(-range, range)(random) * 1024) / 1024;
      }
    corners[3].z += corners[3].x;  // slanted
    if (orient3d(corners[0], corners[1], corners[2], corners[3]) != 0) return corners;
  }
}

constexpr std::array<TriangleMesh::Triangle, 4> kFaces{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};

TriangleMesh tetrahedron(const Corners& corners) {
  std::vector<TriangleMesh::Triangle> triangles(kFaces.begin(), kFaces.end());
  // Outward: the fourth corner is behind the first face.
  if (dot(cross(corners[1] - corners[0], corners[2] - corners[0]), corners[3] - corners[0]) > 0)
    for (auto& t : triangles) std::swap(t[1], t[2]);
  return {PointArray(std::vector<Vec3>(corners.begin(), corners.end())), triangles};
}

/// Whether a cell lies strictly within, by its corners: all are on the inner side of each face.
bool has_cell_by_corners(const Corners& corners, int reach) {
  const auto is_strictly_inside = [&](const Vec3& p) {
    for (std::size_t f = 0; f < 4; ++f) {
      const auto [a, b, c] = kFaces[f];
      const std::uint32_t other = 6 - a - b - c;
      if (orient3d(corners[a], corners[b], corners[c], p) !=
          orient3d(corners[a], corners[b], corners[c], corners[other]))
        return false;
    }
    return true;
  };
  for (int x = -reach; x < reach; ++x)
    for (int y = -reach; y < reach; ++y)
      for (int z = -reach; z < reach; ++z) {
        bool is_inside = true;
        for (int corner = 0; corner < 8 && is_inside; ++corner)
          is_inside =
              is_strictly_inside({static_cast<double>(x + (corner & 1)), static_cast<double>(y + (corner >> 1 & 1)),
                                  static_cast<double>(z + (corner >> 2))});
        if (is_inside) return true;
      }
  return false;
}

/// The radius of the inscribed sphere: no point is deeper.
double depth_of(const Corners& c) {
  double area = 0;
  for (const auto& [i, j, k] : kFaces) {
    const Vec3 normal = cross(c[j] - c[i], c[k] - c[i]);
    area += std::sqrt(dot(normal, normal)) / 2;
  }
  return std::abs(dot(cross(c[1] - c[0], c[2] - c[0]), c[3] - c[0])) / 6 * 3 / area;
}

TEST(Vanishing, a_cell_is_found_in_a_tetrahedron_exactly_if_its_corners_are_inside) {
  std::mt19937_64 random(39);
  int with_cell = 0, without = 0;
  for (int i = 0; i < rounds(75); ++i) {
    SCOPED_TRACE(i);
    const Corners corners = random_corners(random, 9, i % 3 == 0 ? 9 : i % 3 == 1 ? 3 : 0.5);
    const bool has_cell = has_cell_by_corners(corners, 20);
    (has_cell ? with_cell : without) += 1;
    EXPECT_EQ(finds_cell(tetrahedron(corners), 1.0001 * depth_of(corners)), has_cell);
    EXPECT_EQ(finds_cell(tetrahedron(corners), 100), has_cell) << "without a known depth";
  }
  EXPECT_GT(with_cell, rounds(7));
  EXPECT_GT(without, rounds(25));
}

TEST(Vanishing, cells_that_the_depth_rules_out_are_not_looked_for) {
  const Corners corners = {Vec3{-40, -40, -40}, {50, 0, 0}, {0, 50, 0}, {0, 0, 50}};
  EXPECT_TRUE(finds_cell(tetrahedron(corners), depth_of(corners)));
  EXPECT_FALSE(finds_cell(tetrahedron(corners), 0.49));
}

// Each triangle meets a million cells.
TEST(Vanishing, a_long_slanted_needle_has_no_cell) {
  const Corners corners = {Vec3{0, 0, 0}, {1e6, 0.7e6, 0.3e6}, {1e6, 0.7e6 + 0.1, 0.3e6}, {1e6, 0.7e6, 0.3e6 + 0.1}};
  EXPECT_FALSE(finds_cell(tetrahedron(corners), 3));
}

}  // namespace
}  // namespace algebra3d
