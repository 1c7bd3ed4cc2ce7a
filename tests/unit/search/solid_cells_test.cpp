// Answers of cells about points, beside the winding number over all triangles.
#include "algebra3d/kernel/search/solid_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algebra3d/kernel/exact/vertical_line.h"
#include "unit/arrangement/solids.h"
#include "unit/search/slab_samples.h"

namespace algebra3d {
namespace {

bool is_inside_by_all(const TriangleMesh& mesh, const Vec3& point) {
  int winding_number = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const LineCrossing crossing = cross_vertical_line(point, mesh.corners(FaceId(f)));
    if (crossing.side == -1) winding_number += crossing.sign;
  }
  return winding_number != 0;
}

struct Made {
  std::unique_ptr<const SolidCells> cells;
  std::size_t asked = 0;
};

Made cells_of(const TriangleMesh& mesh, std::size_t cell_count) {
  Made made;
  const auto are_inside = [&](std::span<const Vec3> points) {
    std::vector<bool> inside;
    for (const Vec3& point : points) inside.push_back(is_inside_by_all(mesh, point));
    made.asked += points.size();
    return inside;
  };
  made.cells = SolidCells::make(mesh, Box3::around(mesh.points().approx()), cell_count, are_inside);
  return made;
}

/// The mesh turned about an oblique axis, so that flat sides lie along no axis, scaled and moved.
TriangleMesh turned(const TriangleMesh& mesh, double scale, const Vec3& by) {
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.points().approx())
    points.push_back(by + scale * Vec3{2.0 / 3 * p.x - 1.0 / 3 * p.y + 2.0 / 3 * p.z,
                                       2.0 / 3 * p.x + 2.0 / 3 * p.y - 1.0 / 3 * p.z,
                                       -1.0 / 3 * p.x + 2.0 / 3 * p.y + 2.0 / 3 * p.z});
  return {PointArray(std::move(points)), solids::triangles_of(mesh)};
}

struct Told {
  std::size_t points = 0, told = 0;
};

/// Random points in a box somewhat larger than the solid.
Told compare_with_all(const TriangleMesh& mesh, const SolidCells& cells, std::size_t count) {
  std::mt19937 random(5);  // NOLINT(cert-msc51-cpp): the same in every run
  std::uniform_real_distribution<double> unit(-0.1, 1.1);
  const Box3 box = Box3::around(mesh.points().approx());
  Told result{count};
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 point;
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = box.min[axis] + unit(random) * (box.max[axis] - box.min[axis]);
    const std::optional<bool> told = cells.is_inside(point);
    if (!told) continue;
    ++result.told;
    EXPECT_EQ(*told, is_inside_by_all(mesh, point)) << point.x << " " << point.y << " " << point.z;
  }
  return result;
}

/// No cell tells of a point on a triangle.
void expect_nothing_on_triangles(const TriangleMesh& mesh, const SolidCells& cells) {
  std::mt19937 random(6);  // NOLINT(cert-msc51-cpp): the same in every run
  std::uniform_real_distribution<double> unit(0, 1);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef corners = mesh.corners(FaceId(f));
    for (const PointRef& corner : corners) EXPECT_FALSE(cells.is_inside(corner.approx)) << f;
    for (int i = 0; i < 20; ++i) {
      const double u = unit(random), v = (1 - u) * unit(random);
      const Vec3 point =
          corners[0].approx + u * (corners[1].approx - corners[0].approx) + v * (corners[2].approx - corners[0].approx);
      // Rounding may move it out of the box, where it is outside.
      const std::optional<bool> told = cells.is_inside(point);
      EXPECT_TRUE(!told || !Box3::around(mesh.points().approx()).contains(point)) << f;
    }
  }
}

TEST(SolidCells, PointsAreWhereTheWindingNumberSays) {
  for (const auto& [scale, offset] : {std::pair{1.0, 0.0}, {1e-9, 1.0}, {1e30, -1e30}, {1.0, 1e6}}) {
    const TriangleMesh mesh = round_mesh(24, scale, {offset, offset, offset});
    const Made made = cells_of(mesh, 20000);
    ASSERT_TRUE(made.cells != nullptr) << scale;
    const Told told = compare_with_all(mesh, *made.cells, 2000);
    EXPECT_GT(told.told, told.points * 3 / 4) << scale;
    expect_nothing_on_triangles(mesh, *made.cells);
  }
}

TEST(SolidCells, LargeTrianglesLeaveOutCellsBesideTheirPlane) {
  for (const double offset : {0.0, 1e5, -3e-7}) {
    const TriangleMesh mesh = turned(solids::cube(0, 3), 1, {offset, offset, offset});
    const Made made = cells_of(mesh, 8000);
    ASSERT_TRUE(made.cells != nullptr);
    const Told told = compare_with_all(mesh, *made.cells, 3000);
    EXPECT_GT(told.told, told.points * 2 / 3);
    expect_nothing_on_triangles(mesh, *made.cells);
  }
}

TEST(SolidCells, EachConnectedSetOfCellsIsAskedOnce) {
  // Outside, between the shells and within the cavity; the walls are thicker than a cell.
  const TriangleMesh outer = solids::cube(0, 20), cavity = solids::cube(5, 15);
  std::vector<Vec3> points(outer.points().approx().begin(), outer.points().approx().end());
  points.insert(points.end(), cavity.points().approx().begin(), cavity.points().approx().end());
  std::vector<TriangleMesh::Triangle> triangles = solids::triangles_of(outer);
  for (const auto& [a, b, c] : solids::triangles_of(cavity)) triangles.push_back({8 + a, 8 + c, 8 + b});
  const TriangleMesh mesh(PointArray(std::move(points)), triangles);
  const Made made = cells_of(mesh, 8000);
  ASSERT_TRUE(made.cells != nullptr);
  EXPECT_EQ(made.asked, 2U);  // the cells at the sides are reached, so none is outside
  EXPECT_EQ(made.cells->is_inside({10, 10, 10}), std::optional(false));
  EXPECT_EQ(made.cells->is_inside({2.5, 10, 10}), std::optional(true));
  EXPECT_EQ(made.cells->is_inside({5, 10, 10}), std::nullopt);
  EXPECT_EQ(made.cells->is_inside({-1, 10, 10}), std::optional(false));
}

TEST(SolidCells, ThinBoxesHaveFewSlices) {
  for (const Vec3& sizes : {Vec3{1, 1, 1e-12}, Vec3{1e-12, 3, 1e-12}, Vec3{1e6, 1, 1}}) {
    const TriangleMesh mesh = solids::box({0, 0, 0}, sizes);
    const Made made = cells_of(mesh, 5000);
    ASSERT_TRUE(made.cells != nullptr);
    compare_with_all(mesh, *made.cells, 500);
    expect_nothing_on_triangles(mesh, *made.cells);
  }
}

TEST(SolidCells, ManyLargeTrianglesHaveNone) {
  // Each of the slanted needles reaches across the box.
  std::mt19937 random(8);  // NOLINT(cert-msc51-cpp): the same in every run
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    points.push_back({unit(random) * 0.1, unit(random) * 0.1, unit(random) * 0.1});
    points.push_back({1 - unit(random) * 0.1, 1 - unit(random) * 0.1, 1 - unit(random) * 0.1});
    points.push_back(points.back() + Vec3{0.01, 0, 0});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_EQ(cells_of({PointArray(std::move(points)), triangles}, 6000).cells, nullptr);
}

}  // namespace
}  // namespace algebra3d
