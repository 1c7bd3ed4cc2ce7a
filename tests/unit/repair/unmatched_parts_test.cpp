#include "algebra3d/kernel/repair/detail/unmatched_parts.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "algebra3d/kernel/repair/detail/inside_test.h"
#include "unit/repair/repaired.h"

namespace algebra3d::soups {
namespace {

double area_of_parts(const MeasureFrame& frame, const std::vector<SurfacePart>& parts) {
  double sum = 0;
  for (const SurfacePart& part : parts) sum += part.polygon.area();
  return frame.scale().area(sum).in_doubles().value();
}

TEST(TriangleMatching, finds_common_triangles_in_either_orientation) {
  const TriangleMesh given = mesh_of(joined(turned(cube_soup(0, 2)), wall_at(1, 2, 0, 4, 2))),
                     solid = solids::cube(0, 2);
  const MeasureFrame frame(given, solid, 0, {});
  const TriangleMatching matching = match_triangles(frame, {});
  EXPECT_EQ(matching.given.triangles.size(), 2U);
  EXPECT_TRUE(matching.solid.triangles.empty());
  EXPECT_EQ(frame.scale().area(matching.matched_area).in_doubles(), 24.0);
}

TEST(TriangleMatching, counts_copies) {
  const TriangleMesh given = mesh_of(joined(wall_at(1, 0, 0, 1, 1), turned(wall_at(1, 0, 0, 1, 1)))), solid;
  const MeasureFrame frame(given, solid, 0, {});
  const TriangleMatching matching = match_triangles(frame, {});
  ASSERT_EQ(matching.given.triangles.size(), 2U);
  for (const std::uint64_t copies : matching.given.copies) EXPECT_EQ(copies, 2U);
}

// A wall of 4 by 2 at half height, from the middle of the cube to as far outside: it is cut at the side of the cube.
TEST(UnmatchedParts, are_cut_where_the_solid_crosses_them) {
  const TriangleMesh given = mesh_of(joined(cube_soup(0, 2), wall_at(1, 1, 0.5, 3, 1.5))), solid = solids::cube(0, 2);
  MeasureFrame frame(given, solid, 0, {});
  const TriangleMatching matching = match_triangles(frame, {});
  const auto left = parts_of_given(frame, matching);
  ASSERT_TRUE(left.ok());
  EXPECT_NEAR(area_of_parts(frame, left->parts), 2, 1e-9);
  EXPECT_NEAR(frame.scale().area(left->area_seen).in_doubles().value(), 26, 1e-9);
  const InsideTest test(solid);
  double inside = 0;
  for (const SurfacePart& part : left->parts)
    if (test.is_inside(frame.scale().unscaled(part.polygon.middle()))) inside += part.polygon.area();
  EXPECT_NEAR(frame.scale().area(inside).in_doubles().value(), 1, 1e-9);
}

TEST(UnmatchedParts, that_lie_upon_each_other_count_once) {
  const TriangleMesh given = mesh_of(joined(wall_at(5, 0, 0, 2, 2), wall_at(5, 1, 0, 3, 2))),
                     solid = solids::cube(0, 2);
  MeasureFrame frame(given, solid, 0, {});
  const auto left = parts_of_given(frame, match_triangles(frame, {}));
  ASSERT_TRUE(left.ok());
  EXPECT_NEAR(area_of_parts(frame, left->parts), 6, 1e-9);
  EXPECT_FALSE(left->lies_upon.empty());
}

TEST(UnmatchedParts, of_the_solid_are_what_lies_upon_nothing) {
  TriangleSoup open = cube_soup(0, 2);
  std::erase_if(open.triangles, [](const SoupTriangle& t) { return t[0].z == 2 && t[1].z == 2 && t[2].z == 2; });
  const TriangleMesh given = mesh_of(open), solid = solids::cube(0, 2);
  MeasureFrame frame(given, solid, 0, {});
  const auto parts = parts_of_solid(frame, match_triangles(frame, {}));
  ASSERT_TRUE(parts.ok());
  EXPECT_NEAR(area_of_parts(frame, *parts), 4, 1e-9);
}

TEST(InsideTest, tells_cavities_from_bodies) {
  const TriangleMesh solid = mesh_of(joined(cube_soup(0, 4), turned(cube_soup(1, 3))));
  const InsideTest test(solid);
  EXPECT_TRUE(test.is_inside({0.5, 0.5, 0.5}));
  EXPECT_FALSE(test.is_inside({2, 2, 2}));
  EXPECT_FALSE(test.is_inside({5, 2, 2}));
}

/// A chain of cubes along an axis, one behind the other, each with a cavity.
TriangleSoup chain_along(std::size_t axis) {
  TriangleSoup chain;
  for (int i = 0; i < 40; ++i) {
    Vec3 shift;
    shift[axis] = 4 * i;
    chain = joined(std::move(chain), shifted(joined(cube_soup(0, 3), turned(cube_soup(1, 2))), shift));
  }
  return chain;
}

// Whatever the axis along which the rays of many points go.
TEST(InsideTest, answers_many_points_as_geometry_does) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    SCOPED_TRACE("axis " + std::to_string(axis));
    const TriangleMesh solid = mesh_of(chain_along(axis));
    Chance chance(axis + 1);
    std::vector<Vec3> points;
    for (int i = 0; i < 3000; ++i) {
      Vec3 point{3.5 * chance.unit(), 3.5 * chance.unit(), 3.5 * chance.unit()};
      point[axis] = 165 * chance.unit();
      // On edges and diagonals of other cubes as seen along any axis.
      if (chance.one_in(3)) point[(axis + 1) % 3] = point[(axis + 2) % 3];
      if (chance.one_in(5)) point[(axis + 1) % 3] = 1.5;
      points.push_back(point);
    }
    const auto are_inside = InsideTest(solid).are_inside(points, {});
    ASSERT_TRUE(are_inside.ok());
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec3 here = points[i];
      here[axis] = std::fmod(here[axis], 4);
      const auto [least, most] = std::minmax({here.x, here.y, here.z});
      const bool is_in_cube = points[i][axis] < 160 && least > 0 && most < 3;
      const bool is_in_cavity = least > 1 && most < 2;
      EXPECT_EQ((*are_inside)[i], is_in_cube && !is_in_cavity) << "point " << i;
    }
  }
}

}  // namespace
}  // namespace algebra3d::soups
