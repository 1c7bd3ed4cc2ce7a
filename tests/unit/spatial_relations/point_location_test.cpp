#include "algebra3d/values/spatial_relations/point_location.h"

#include <gtest/gtest.h>

#include <optional>

#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/solids.h"

namespace algebra3d {
namespace {

// By hand: on an axis-parallel box every place follows from the coordinates.
TEST(point_location, a_box_is_as_its_coordinates_say) {
  const Volume3d box = Volume3d::trusted(solids::box({0, 0, 0}, {2, 3, 4}));
  std::vector<ExactPoint> points;
  for (int x = -1; x <= 5; ++x)
    for (int y = -1; y <= 7; ++y)
      for (int z = -1; z <= 9; ++z) points.emplace_back(Vec3{x / 2.0, y / 2.0, z / 2.0});
  points.emplace_back(RationalVec3(Rational(1, 3), Rational(1, 7), Rational(4)));
  points.emplace_back(RationalVec3(Rational(1, 3), Rational(1, 7), Rational(4) + *Rational::parse("1e-40")));
  points.emplace_back(RationalVec3(Rational(1, 3), Rational(1, 7), Rational(4) - *Rational::parse("1e-40")));
  const std::vector<PointRef> refs(points.begin(), points.end());
  const std::vector<Placement> together = place_in_solid(refs, box.geometry());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const RationalVec3 p = points[i].rational();
    const std::array<Rational, 3> sizes{Rational(2), Rational(3), Rational(4)};
    Placement expected = Placement::inside;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (p[axis] < Rational(0) || sizes[axis] < p[axis]) {
        expected = Placement::outside;
        break;
      }
      if (p[axis] == Rational(0) || p[axis] == sizes[axis]) expected = Placement::boundary;
    }
    EXPECT_EQ(place_in_solid(points[i], box.geometry()), expected) << i;
    EXPECT_EQ(together[i], expected) << i;
  }
}

TEST(point_location, many_points_are_placed_as_one_after_the_other) {
  const Volume3d ball = Volume3d::trusted(solids::geodesic_sphere(4));
  solids::Chance chance(7);
  std::vector<Vec3> points;
  for (int i = 0; i < 20000; ++i) {
    const double x = chance.unit(), y = chance.unit();
    points.push_back({x, y, chance.unit()});
  }
  for (const Vec3& corner : ball.mesh().points().approx()) points.push_back(corner);
  const std::vector<PointRef> refs(points.begin(), points.end());
  const std::vector<Placement> together = place_in_solid(refs, ball.geometry());
  std::array<int, 3> seen{};
  std::optional<Volume3d> other_ball;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // So often a new one that its cells are never made: by rays alone.
    if (i % 256 == 0) other_ball = Volume3d::trusted(solids::geodesic_sphere(4));
    ASSERT_EQ(together[i], place_in_solid(refs[i], other_ball->geometry())) << i;
    ASSERT_EQ(together[i], place_in_solid(refs[i], ball.geometry())) << i;
    ++seen[static_cast<std::size_t>(together[i])];
  }
  for (const int count : seen) EXPECT_GT(count, 50);
}

TEST(point_location, cells_are_made_when_they_are_worth_their_cost) {
  const Volume3d ball = Volume3d::trusted(solids::geodesic_sphere(4));
  std::size_t asked = 0;
  const auto are_inside = [&](std::span<const Vec3> middles) {
    ++asked;
    return std::vector<bool>(middles.size());
  };
  EXPECT_EQ(ball.geometry().cells_after(256, are_inside), nullptr);
  EXPECT_EQ(asked, 0U);
  const SolidCells* const cells = ball.geometry().cells_after(1024, are_inside);
  EXPECT_NE(cells, nullptr);
  EXPECT_EQ(ball.geometry().cells_after(1, are_inside), cells);
  EXPECT_EQ(asked, 1U);
}

TEST(point_location, exact_points_beside_a_solid_with_cells_are_placed) {
  const Volume3d ball = Volume3d::trusted(solids::geodesic_sphere(4));
  std::vector<ExactPoint> points;
  points.emplace_back(RationalVec3(Rational(1, 3), Rational(1, 7), Rational(1, 11)));
  points.emplace_back(RationalVec3(Rational(1, 3), Rational(1, 7), Rational(10, 3)));
  std::vector<PointRef> refs(4096, points[0]);
  refs.emplace_back(points[1]);
  const std::vector<Placement> together = place_in_solid(refs, ball.geometry());
  EXPECT_EQ(together.front(), Placement::inside);
  EXPECT_EQ(together.back(), Placement::outside);
}

TEST(point_location, a_point_on_a_surface_is_inside_or_on_a_boundary_edge) {
  const Surface3d surface = Surface3d::trusted(solids::Maker().quad({0, 0, 0}, {2, 0, 0}, {2, 2, 2}, {0, 2, 2}).mesh());
  EXPECT_EQ(place_on_surface(Vec3{1, 1, 1}, surface.geometry()), Placement::inside);  // on the diagonal
  EXPECT_EQ(place_on_surface(Vec3{1, 0, 0}, surface.geometry()), Placement::boundary);
  EXPECT_EQ(place_on_surface(Vec3{2, 2, 2}, surface.geometry()), Placement::boundary);
  EXPECT_EQ(place_on_surface(Vec3{1, 1, 1.5}, surface.geometry()), Placement::outside);
}

}  // namespace
}  // namespace algebra3d
