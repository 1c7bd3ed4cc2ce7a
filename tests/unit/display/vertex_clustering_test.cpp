#include "algebra3d/values/display/vertex_clustering.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "base/scheduler.h"
#include "unit/display/values.h"

namespace algebra3d {
namespace {

struct Triangles {
  std::vector<Vec3> points;
  std::vector<IndexTriangle> triangles;

  TrianglesView view() const { return {points, triangles}; }
};

Triangles sphere_triangles() {
  const TriangleMesh mesh = unit_sphere(200, 300);
  return {mesh.points().approx(), triangles_of(mesh)};
}

/// The surface of a cube from -1 to 1, n by n squares on each side; corners are not shared between the sides.
Triangles fine_cube(std::uint32_t n) {
  Triangles cube;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1})
      for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
          Vec3 point;
          point[axis] = side;
          point[(axis + 1) % 3] = (side > 0 ? 1 : -1) * (2.0 * i / n - 1);
          point[(axis + 2) % 3] = 2.0 * j / n - 1;
          if (i < n && j < n) {
            const auto a = static_cast<std::uint32_t>(cube.points.size());
            cube.triangles.push_back({a, a + n + 1, a + n + 2});
            cube.triangles.push_back({a, a + n + 2, a + 1});
          }
          cube.points.push_back(point);
        }
  return cube;
}

double enclosed_volume(const std::vector<Vec3>& points, const std::vector<IndexTriangle>& triangles) {
  double volume = 0;
  for (const auto& [a, b, c] : triangles) volume += dot(points[a], cross(points[b], points[c])) / 6;
  return volume;
}

TEST(VertexClustering, keeps_nearly_as_many_triangles_as_it_may) {
  const Triangles sphere = sphere_triangles();
  for (const std::size_t most : {100U, 1000U, 20000U, 60000U}) {
    const auto level = clustered(sphere.view(), most);
    EXPECT_LE(level->triangles.size(), most);
    EXPECT_GE(level->triangles.size(), 7 * most / 10);
  }
}

TEST(VertexClustering, a_sphere_stays_one) {
  const Triangles sphere = sphere_triangles();
  const double volume = enclosed_volume(sphere.points, sphere.triangles);
  for (const std::size_t most : {1000U, 20000U}) {
    const auto level = clustered(sphere.view(), most);
    EXPECT_NEAR(enclosed_volume(level->points, level->triangles), volume, 0.02 * volume);
    std::size_t folded = 0;
    for (const auto& [a, b, c] : level->triangles) {
      const Vec3 &p = level->points[a], &q = level->points[b], &r = level->points[c];
      EXPECT_NEAR(length(p), 1, 10.0 / static_cast<double>(most));
      folded += static_cast<std::size_t>(dot(cross(q - p, r - p), p + q + r) < 0);
    }
    // Where a cell cuts the surface at a flat angle.
    EXPECT_LT(folded, level->triangles.size() / 100) << "seen from inside";
  }
}

/// A grid that does not fit the cube: the least sum of squares is at its corners and edges nevertheless.
TEST(VertexClustering, corners_and_edges_stay_sharp) {
  const Triangles cube = fine_cube(100);
  const auto level = clustered(cube.view(), 2000);
  EXPECT_NEAR(enclosed_volume(level->points, level->triangles), 8, 0.05);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 expected{(corner & 4) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 1) != 0 ? 1.0 : -1.0};
    double nearest = Box3::kInfinity;
    for (const Vec3& point : level->points) nearest = std::min(nearest, length(point - expected));
    EXPECT_LT(nearest, 0.001) << "cells have a side of about 0.1";
  }
  for (const Vec3& point : level->points)
    EXPECT_NEAR(std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}), 1, 1e-3) << "on a side";
}

TEST(VertexClustering, tells_how_far_vertices_were_moved) {
  const Triangles sphere = sphere_triangles();
  const auto fine = clustered(sphere.view(), 20000);
  const auto coarse = clustered(fine->view(), 500);
  double farthest = 0, farthest_fine = 0;
  for (std::size_t i = 0; i < sphere.points.size(); ++i) {
    const std::uint32_t point = fine->point_of[i], coarser = coarse->point_of[point];
    const double moved = length(sphere.points[i] - fine->points[point]);
    EXPECT_LE(moved, fine->moved[point] * (1 + 1e-12));
    farthest_fine = std::max(farthest_fine, moved);
    if (coarser == kNone) continue;
    EXPECT_LE(length(sphere.points[i] - coarse->points[coarser]), coarse->moved[coarser] * (1 + 1e-12));
    farthest = std::max(farthest, length(sphere.points[i] - coarse->points[coarser]));
  }
  EXPECT_DOUBLE_EQ(fine->deviation(), farthest_fine);
  EXPECT_GE(coarse->deviation(), farthest);
  EXPECT_LE(coarse->deviation(), farthest + farthest_fine) << "an upper bound by the way over the finer level";
}

/// The sums of a level are those of all its original triangles and vertices, whatever was between.
TEST(VertexClustering, sums_add_up_over_levels) {
  const Triangles cube = fine_cube(50);
  const auto fine = clustered(cube.view(), 5000);
  const auto coarse = clustered(fine->view(), 100);
  ClusterSums total;
  for (const ClusterSums& sums : coarse->sums) total += sums;
  EXPECT_EQ(total.count, static_cast<double>(cube.points.size()));
  // Each of three corners has the doubled area of its triangles, 48 in all: a third of it faces along each axis.
  EXPECT_NEAR(total.a[0], 48, 1e-9);
  EXPECT_NEAR(total.a[3], 48, 1e-9);
  EXPECT_NEAR(total.a[5], 48, 1e-9);
}

TEST(VertexClustering, drops_repetitions_and_keeps_both_sides_of_a_sheet) {
  // Four layers a hair apart: two seen from above, two from below.
  Triangles layers;
  for (const double z : {0.0, 1e-9, 2e-9, 3e-9}) {
    const auto a = static_cast<std::uint32_t>(layers.points.size());
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      layers.points.push_back({x, y, z});
    if (z < 1.5e-9)
      layers.triangles.insert(layers.triangles.end(), {{a, a + 1, a + 2}, {a, a + 2, a + 3}});
    else
      layers.triangles.insert(layers.triangles.end(), {{a + 2, a + 1, a}, {a + 3, a + 2, a}});
  }
  const auto level = clustered(layers.view(), 8);
  const std::set<IndexTriangle> found(level->triangles.begin(), level->triangles.end());
  EXPECT_EQ(found, (std::set<IndexTriangle>{{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}}));
  EXPECT_EQ(level->triangles.size(), 4U);
}

TEST(VertexClustering, points_without_triangles_are_in_no_cluster) {
  Triangles triangle{{{5, 5, 5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 2, 3}}};
  const auto level = clustered(triangle.view(), 1);
  EXPECT_EQ(level->point_of[0], kNone);
  EXPECT_EQ(level->points.size(), 3U);
}

TEST(VertexClustering, does_not_depend_on_the_number_of_threads) {
  const Triangles sphere = sphere_triangles();
  const auto level = clustered(sphere.view(), 5000);
  with_threads(1, [&] {
    const auto alone = clustered(sphere.view(), 5000);
    EXPECT_EQ(alone->points, level->points);
    EXPECT_EQ(alone->triangles, level->triangles);
  });
}

TEST(VertexClustering, can_be_interrupted) {
  const std::atomic<bool> cancel = true;
  const auto level = clustered(sphere_triangles().view(), 100, Monitor(&cancel));
  ASSERT_FALSE(level.ok());
  EXPECT_EQ(level.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d
