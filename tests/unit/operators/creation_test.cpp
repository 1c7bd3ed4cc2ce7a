#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/trigonometry.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "unit/operators/call_operator.h"

namespace algebra3d {
namespace {

using calls::call;
using calls::point;

const double kPi = std::numbers::pi;

std::string reason(const calls::Answer& answer) {
  EXPECT_FALSE(answer.is_defined());
  return answer.diagnostics.size() == 1 ? answer.diagnostics[0] : "no single reason";
}

TEST(CreateCube, takes_its_corners_in_any_order) {
  const auto solid = calls::cube(point(1, 5, -2), point(0, 7, -3));
  EXPECT_EQ(solid.box(), (Box3{{0, 5, -3}, {1, 7, -2}}));
  EXPECT_EQ(solid.mesh().face_count(), 12U);
  EXPECT_EQ(call("volume", solid).get<double>(), 2.0);
}

TEST(CreateCube, keeps_corners_that_are_no_doubles) {
  const auto third = calls::literal<Point3d>("(1/3 1/3 1/3)");
  EXPECT_EQ(call("volume", calls::cube(third, point(3, 3, 3))).get<double>(), Rational(512, 27).nearest_double());
}

TEST(CreateCube, without_extent_is_undefined) {
  EXPECT_NE(reason(call("createCube", point(0, 0, 0), point(1, 1, 0))).find("no extent"), std::string::npos);
}

TEST(CreateCylinder, has_the_volume_of_the_prism) {
  for (const int n : {3, 4, 7, 100}) {
    const auto solid = call("createCylinder", point(1, 2, 3), 2.0, 5.0, n).get<Volume3d>();
    EXPECT_EQ(solid.mesh().face_count(), 4U * n - 4);
    EXPECT_TRUE(is_closed(solid.mesh()));
    EXPECT_NEAR(call("volume", solid).get<double>(), 0.5 * n * 4 * std::sin(2 * kPi / n) * 5, 1e-13 * 60);
    EXPECT_EQ(solid.mesh().point(VertexId(0)).approx, (Vec3{3, 2, 3}));
  }
}

TEST(CreateCone, has_the_volume_of_the_pyramid) {
  for (const int n : {3, 4, 7, 100}) {
    const auto solid = call("createCone", point(1, 2, 3), 2.0, 5.0, n).get<Volume3d>();
    EXPECT_EQ(solid.mesh().face_count(), 2U * n - 2);
    EXPECT_NEAR(call("volume", solid).get<double>(), 0.5 * n * 4 * std::sin(2 * kPi / n) * 5 / 3, 1e-13 * 20);
    EXPECT_EQ(solid.box().max.z, 8.0);
  }
}

// The circle's points are those of circle_point, though most are mirrored.
TEST(CreateCylinder, has_the_corners_of_the_regular_polygon) {
  for (int n = 3; n <= 200; ++n) {
    const auto solid = call("createCylinder", point(0, 0, 0), 1.0, 1.0, n).get<Volume3d>();
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
      const CirclePoint corner = circle_point(i, n);
      ASSERT_EQ(solid.mesh().point(VertexId(i)).approx, (Vec3{corner.cosine, corner.sine, 0})) << i << " of " << n;
    }
  }
}

// Proofs by star shape where they hold, else in full; the verdict is the same.
TEST(CreateRound, what_rounding_has_left_is_valid_or_undefined) {
  int undefined_count = 0, defined_count = 0;
  for (const double far : {0.0, 1e3, 1e8, 1e15, 1e16, 4e16}) {
    for (const double size : {1e-3, 1.0, 5.0, 40.0}) {
      const auto where = point(far, -far, far);
      for (const auto& answer : {call("createSphere", where, size, 10), call("createCone", where, size, size, 7),
                                 call("createCylinder", where, size, size, 9)}) {
        const bool is_defined = answer.is_defined();
        ++(is_defined ? defined_count : undefined_count);
        EXPECT_TRUE(!is_defined || prove_volume(answer.get<Volume3d>().mesh())->is_valid());
      }
    }
  }
  EXPECT_GT(undefined_count, 10);
  EXPECT_GT(defined_count, 30);
}

TEST(CreateSphere, has_its_triangles_and_nearly_the_volume_of_a_ball) {
  for (const int n : {3, 4, 5, 12, 13, 200}) {
    const std::uint32_t even = n + n % 2;
    const auto solid = call("createSphere", point(1, 2, 3), 2.0, n).get<Volume3d>();
    EXPECT_EQ(solid.mesh().face_count(), even * (even - 2));
    EXPECT_EQ(*genus(solid.mesh()), 0);
    const auto centre = call("centroid", solid).get<Point3d>().position.approx();
    EXPECT_NEAR(centre.x, 1, 1e-12);
    EXPECT_NEAR(centre.y, 2, 1e-12);
    EXPECT_NEAR(centre.z, 3, 1e-12);
  }
  const auto fine = call("createSphere", point(0, 0, 0), 1.0, 400).get<Volume3d>();
  EXPECT_NEAR(call("volume", fine).get<double>(), 4 * kPi / 3, 1e-3);
  EXPECT_NEAR(call("area", fine).get<double>(), 4 * kPi, 1e-3);
}

TEST(CreateSphere, corners_lie_on_the_sphere_to_the_last_bit) {
  const auto solid = call("createSphere", point(0, 0, 0), 1.0, 24).get<Volume3d>();
  for (const Vec3& p : solid.mesh().points().approx()) EXPECT_NEAR(std::hypot(p.x, p.y, p.z), 1, 3e-16);
}

TEST(CreateRound, bad_measures_are_undefined_with_the_reason) {
  EXPECT_EQ(reason(call("createCylinder", point(0, 0, 0), 0.0, 1.0, 8)),
            "createCylinder: the radius is 0; it must be positive");
  EXPECT_EQ(reason(call("createCone", point(0, 0, 0), 1.0, -1.0, 8)),
            "createCone: the height is -1; it must be positive");
  EXPECT_EQ(reason(call("createSphere", point(0, 0, 0), 1.0, 2)),
            "createSphere: 2 corners; there must be 3 to 10000000");
  EXPECT_EQ(reason(call("createCone", point(0, 0, 0), 1.0, 1.0, 10'000'001)),
            "createCone: 10000001 corners; there must be 3 to 10000000");
  EXPECT_NE(reason(call("createSphere", point(0, 0, 0), 1.0, 10'000)).find("at most 40000000"), std::string::npos);
}

TEST(CreateRound, shapes_that_rounding_flattens_are_undefined) {
  const auto far = point(1e20, 0, 0);
  for (const auto& answer : {call("createCylinder", far, 1.0, 1.0, 8), call("createCone", far, 1.0, 1.0, 8)})
    EXPECT_NE(reason(answer).find("collapses when its corners are rounded"), std::string::npos);
  EXPECT_NE(reason(call("createSphere", far, 1.0, 8)).find("collapses when its corners are rounded"),
            std::string::npos);
}

TEST(CreateRound, corners_beyond_the_doubles_are_undefined) {
  const double largest = std::numeric_limits<double>::max();
  EXPECT_NE(reason(call("createCone", point(largest, 0, 0), largest, 1.0, 4)).find("beyond the range"),
            std::string::npos);
}

}  // namespace
}  // namespace algebra3d
