// Smallest enclosing balls of random points against brute force over rationals: all balls through one to four points
// that contain the others. And against CGAL's exact Min_sphere_d.
#include "algebra3d/kernel/convex/enclosing_ball.h"

#include <gtest/gtest.h>

#include <CGAL/Cartesian_d.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Min_sphere_annulus_d_traits_d.h>
#include <CGAL/Min_sphere_d.h>

#include "algebra3d/kernel/exact/plane.h"
#include "support/rounds.h"
#include "unit/convex/clouds.h"

namespace algebra3d {
namespace {

using clouds::array_of;
using Traits = CGAL::Min_sphere_annulus_d_traits_d<CGAL::Cartesian_d<CGAL::Exact_rational>>;

Rational squared_radius_of_cgal(const std::vector<ExactPoint>& points) {
  std::vector<CGAL::Cartesian_d<CGAL::Exact_rational>::Point_d> cgal_points;
  for (const ExactPoint& p : points) {
    std::vector<CGAL::Exact_rational> c;
    for (std::size_t axis = 0; axis < 3; ++axis) c.emplace_back(p.rational()[axis].text());
    cgal_points.emplace_back(3, c.begin(), c.end());
  }
  const CGAL::Min_sphere_d<Traits> sphere(cgal_points.begin(), cgal_points.end());
  std::ostringstream text;
  text << sphere.squared_radius();
  return *Rational::parse(text.str());
}

Rational squared_distance(const RationalVec3& a, const RationalVec3& b) {
  return dot(a - b, a - b);
}

TEST(enclosing_ball, cgal_agrees_on_random_sets) {
  for (int seed = 0; seed < rounds(50); ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<ExactPoint> points = clouds::Cloud(static_cast<std::uint64_t>(seed)).draw();
    const PointArray array = array_of(points);
    const auto ball = smallest_enclosing_ball(array);
    ASSERT_TRUE(ball.ok() && ball->has_value());
    EXPECT_EQ((*ball)->squared_radius, squared_radius_of_cgal(points));
    const RoundedBall rounded = rounded_ball(**ball, array);
    if (!std::isfinite(rounded.radius)) continue;
    const Rational limit = Rational(rounded.radius) * Rational(rounded.radius);
    for (const ExactPoint& p : points) {
      EXPECT_LE(squared_distance(p.rational(), (*ball)->centre), (*ball)->squared_radius);
      EXPECT_LE(squared_distance(p.rational(), RationalVec3(rounded.centre)), limit);
    }
    if (testing::Test::HasFailure()) return;
  }
}

// By hand: the centre of a cuboid, and half of its diagonal.
TEST(enclosing_ball, of_simple_sets) {
  std::vector<ExactPoint> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(Vec3{(i & 1) * 2.0, (i & 2) * 1.5, (i & 4) * 1.5});
  const PointArray array = array_of(corners);
  const auto ball = smallest_enclosing_ball(array).value();
  EXPECT_EQ(ball->centre, RationalVec3(Vec3{1, 1.5, 3}));
  EXPECT_EQ(rounded_ball(*ball, array).radius, 3.5);
  EXPECT_FALSE(smallest_enclosing_ball(PointArray()).value().has_value());
  const PointArray one = array_of({Vec3{1, 2, 3}, Vec3{1, 2, 3}});
  EXPECT_EQ(smallest_enclosing_ball(one).value()->squared_radius, Rational(0));
  EXPECT_EQ(rounded_ball(*smallest_enclosing_ball(one).value(), one).radius, 0);
}

}  // namespace
}  // namespace algebra3d
