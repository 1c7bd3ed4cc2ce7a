#include <atomic>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "algebra3d/kernel/arrangement/surface_arrangement.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "unit/arrangement/random_solids.h"

namespace algebra3d::solids {
namespace {

TriangleMesh union_of(const std::vector<TriangleMesh>& meshes) {
  std::vector<Operand> operands;
  for (const TriangleMesh& mesh : meshes) operands.push_back({&mesh, 0});
  Result<TriangleMesh> result = unite_surfaces(operands);
  EXPECT_TRUE(result.ok());
  if (!result.ok()) return {};
  EXPECT_EQ(prove_surface(*result)->text(), "");
  EXPECT_EQ(audit(*result), std::vector<std::string>());
  return std::move(result).value();
}

double area_of_surface(const TriangleMesh& mesh) {
  return nearest_area(mesh.points(), triangles_of(mesh)).value();
}

/// A rectangle of whole cells across an axis.
struct GridRectangle {
  std::size_t axis;
  int place;
  std::array<int, 2> low, high;
  bool is_turned;

  bool holds_cell(int i, int k) const { return low[0] <= i && i < high[0] && low[1] <= k && k < high[1]; }
  TriangleMesh mesh() const {
    const auto corner = [&](int i, int k) {
      Vec3 p;
      p[axis] = place;
      p[(axis + 1) % 3] = i;
      p[(axis + 2) % 3] = k;
      return p;
    };
    const Vec3 a = corner(low[0], low[1]), b = corner(high[0], low[1]), c = corner(high[0], high[1]),
               d = corner(low[0], high[1]);
    return is_turned ? Maker().quad(a, d, c, b).mesh() : Maker().quad(a, b, c, d).mesh();
  }
};

/// Per cell, by axis, place and both of its coordinates: whether it is turned in the first rectangle that covers it.
using Cells = std::map<std::array<int, 4>, bool>;

Cells cells_of(const std::vector<GridRectangle>& rectangles, int size) {
  Cells cells;
  for (const GridRectangle& r : rectangles)
    for (int i = 0; i < size; ++i)
      for (int k = 0; k < size; ++k)
        if (r.holds_cell(i, k)) cells.try_emplace({static_cast<int>(r.axis), r.place, i, k}, r.is_turned);
  return cells;
}

std::vector<GridRectangle> random_rectangles(Chance& chance, int count, int size) {
  std::vector<GridRectangle> result;
  for (int n = 0; n < count; ++n) {
    GridRectangle& r = result.emplace_back();
    r.axis = static_cast<std::size_t>(chance.below(3));
    r.place = chance.below(size);
    for (std::size_t i = 0; i < 2; ++i) {
      r.low[i] = chance.below(size - 1);
      r.high[i] = r.low[i] + 1 + chance.below(size - 1 - r.low[i]);
    }
    r.is_turned = chance.one_in(2);
  }
  return result;
}

// Cells are counted one by one.
TEST(UniteSurfaces, covers_each_cell_once_turned_as_in_the_first) {
  constexpr int kSize = 5;
  for (int seed = 1; seed <= 80; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const auto rectangles = random_rectangles(chance, chance.between(1, 8), kSize);
    std::vector<TriangleMesh> meshes;
    for (const GridRectangle& r : rectangles) meshes.push_back(r.mesh());
    const TriangleMesh result = union_of(meshes);
    const Cells cells = cells_of(rectangles, kSize);
    EXPECT_EQ(area_of_surface(result), static_cast<double>(cells.size()));
    // The net area of each plane tells that its pieces are turned as they should be.
    std::map<std::array<int, 2>, double> expected, found;
    for (const auto& [cell, is_turned] : cells) expected[{cell[0], cell[1]}] += is_turned ? -1 : 1;
    for (std::size_t f = 0; f < result.face_count(); ++f) {
      const TriangleRef t = result.corners(FaceId(f));
      const Vec3 normal = cross(t[1].approx - t[0].approx, t[2].approx - t[0].approx);
      const int axis = normal.x != 0 ? 0 : normal.y != 0 ? 1 : 2;
      const auto index = static_cast<std::size_t>(axis);
      found[{axis, static_cast<int>(t[0].approx[index])}] += normal[index] / 2;
    }
    for (const auto& [plane, area] : expected) EXPECT_NEAR(found[plane], area, 1e-9);
    EXPECT_EQ(found.size(), expected.size());
  }
}

TEST(UniteSurfaces, of_triangles_in_general_position_keeps_their_area) {
  for (int seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    std::vector<TriangleMesh> meshes;
    double area = 0;
    for (int n = chance.between(2, 8); n > 0; --n) {
      const auto corner = [&] { return 3 * Vec3{chance.unit(), chance.unit(), chance.unit()}; };
      const Vec3 a = corner(), b = corner(), c = corner();
      meshes.push_back(Maker().triangle(a, b, c).mesh());
      area += area_of_surface(meshes.back());
    }
    EXPECT_NEAR(area_of_surface(union_of(meshes)), area, 1e-12 * area);
  }
}

TEST(UniteSurfaces, of_one_surface_is_that_surface) {
  const TriangleMesh sphere = geodesic_sphere(3);
  const TriangleMesh result = union_of({sphere});
  EXPECT_EQ(result.face_count(), sphere.face_count());
  EXPECT_EQ(exact_volume_of(result), exact_volume_of(sphere));
}

TEST(UniteSurfaces, of_equal_surfaces_is_one_of_them) {
  const TriangleMesh box = cube(0, 2);
  EXPECT_EQ(exact_volume_of(union_of({box, box, box})), Rational(8));
  EXPECT_EQ(exact_volume_of(union_of({flipped(box), box})), Rational(-8));
  EXPECT_EQ(union_of({flipped(box), box}).face_count(), 12U);
}

TEST(UniteSurfaces, groups_mean_nothing) {
  const TriangleMesh a = cube(0, 4), b = cube(2, 6);
  const std::vector<Operand> same{{&a, 0}, {&b, 0}}, different{{&a, 0}, {&b, 1}};
  const auto first = unite_surfaces(same), second = unite_surfaces(different);
  EXPECT_EQ(triangles_of(*first), triangles_of(*second));
  // Both boxes whole: 2 * 6 * 16.
  EXPECT_EQ(area_of_surface(*first), 192);
}

TEST(UniteSurfaces, of_nothing_is_empty) {
  EXPECT_TRUE(union_of({}).is_empty());
  EXPECT_TRUE(union_of({TriangleMesh(), TriangleMesh()}).is_empty());
}

TEST(UniteSurfaces, limits_and_cancelling_are_errors) {
  const TriangleMesh a = cube(0, 4), b = cube(2, 6), far = cube(10, 12);
  const std::vector<Operand> crossing{{&a, 0}, {&b, 0}}, apart{{&a, 0}, {&far, 0}};
  const auto limited = unite_surfaces(crossing, {}, {Closure::together, 1});
  ASSERT_FALSE(limited.ok());
  EXPECT_EQ(limited.error().code, ErrorCode::limit_exceeded);
  EXPECT_TRUE(unite_surfaces(apart, {}, {Closure::together, 0}).ok());
  const std::atomic<bool> cancel = true;
  const auto cancelled = unite_surfaces(crossing, &cancel);
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::solids
