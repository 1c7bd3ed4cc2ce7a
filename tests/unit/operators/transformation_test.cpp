#include <cmath>

#include <gtest/gtest.h>

#include "unit/operators/call_operator.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using calls::Answer;
using calls::call;
using calls::literal;
using calls::point;
using calls::vector;

Volume3d part() {
  return *std::move(*Volume3d::prove(samples::torus(12, 8, {0.1, 20.3, -7.7})));
}

void expect_equal(const Volume3d& a, const Volume3d& b) {
  EXPECT_EQ(compare(Value::of(a), Value::of(b)), std::strong_ordering::equal);
}

TEST(Rotate, four_quarter_turns_give_the_solid_back) {
  const Volume3d before = part();
  for (const Vector3d& axis : {vector(0, 0, 1), vector(0, -3, 0), vector(0.5, 0, 0)}) {
    // About the origin a quarter turn permutes coordinates and changes signs.
    Volume3d solid = before;
    for (int i = 0; i < 4; ++i) solid = call("rotate", solid, point(0, 0, 0), axis, 90.0).get<Volume3d>();
    expect_equal(solid, before);
  }
}

TEST(Rotate, turns_by_the_right_hand) {
  EXPECT_EQ(call("rotate", point(1, 0, 0), point(0, 0, 0), vector(0, 0, 2), 90.0).text(), "(0.0 1.0 0.0)");
  EXPECT_EQ(call("rotate", point(0, 1, 0), point(0, 0, 0), vector(7, 0, 0), 90.0).text(), "(0.0 0.0 1.0)");
  EXPECT_EQ(call("rotate", point(3, 1, 0), point(1, 1, 0), vector(0, 0, 1), -90.0).text(), "(1.0 -1.0 0.0)");
}

TEST(Rotate, keeps_volume_and_lengths_nearly) {
  const Volume3d before = part();
  const Volume3d after = call("rotate", before, point(1, 2, 3), vector(1, 2, -1), 37.0).get<Volume3d>();
  EXPECT_NEAR(call("volume", after).get<double>(), call("volume", before).get<double>(), 1e-11);
  const double angle = 37.0 / 180 * std::numbers::pi;
  const Vec3 image =
      call("rotate", point(1, 0, 0), point(0, 0, 0), vector(0, 0, 1), 37.0).get<Point3d>().position.approx();
  EXPECT_NEAR(image.x, std::cos(angle), 1e-15);
  EXPECT_NEAR(image.y, std::sin(angle), 1e-15);
}

TEST(Rotate, about_no_axis_is_undefined) {
  const Answer answer = call("rotate", part(), point(1, 2, 3), vector(0, 0, 0), 37.0);
  EXPECT_FALSE(answer.is_defined());
  EXPECT_EQ(answer.diagnostics, std::vector<std::string>{"rotate: the axis is the zero vector"});
}

TEST(Mirror, twice_gives_the_solid_back_where_images_are_doubles) {
  const Volume3d before = calls::cube(point(1, 2, 3), point(4, 8, 5));
  for (const char* plane : {"(2 0 0 1)", "(0 1 1 0)", "(-7 0 -2 0)"}) {
    const Volume3d image = call("mirror", before, literal<Plane3d>(plane)).get<Volume3d>();
    EXPECT_EQ(call("volume", image).get<double>(), 36.0) << plane;
    expect_equal(call("mirror", image, literal<Plane3d>(plane)).get<Volume3d>(), before);
  }
}

TEST(Mirror, swaps_second_and_third_corner_and_keeps_the_order) {
  const auto surface = literal<Surface3d>("(((0 0 1) (1 0 1) (0 1 1)) ((5 5 5) (6 5 5) (5 6 7)))");
  EXPECT_EQ(call("mirror", surface, literal<Plane3d>("(0 0 0 1)")).text(),
            "(((0.0 0.0 -1.0) (0.0 1.0 -1.0) (1.0 0.0 -1.0)) ((5.0 5.0 -5.0) (5.0 6.0 -7.0) (6.0 5.0 -5.0)))");
}

TEST(Translate, by_doubles_is_rounded_once) {
  const double x = 0.1, by = 0.2;
  EXPECT_EQ(call("translate", point(x, 0, 0), vector(by, 0, 0)).get<Point3d>().position.approx().x, x + by);
  expect_equal(call("translate",
                    call("translate", calls::cube(point(0, 0, 0), point(1, 2, 3)), vector(10, 20, 30)).get<Volume3d>(),
                    vector(-10, -20, -30))
                   .get<Volume3d>(),
               calls::cube(point(0, 0, 0), point(1, 2, 3)));
}

TEST(Translate, that_rounding_would_flatten_keeps_the_exact_image) {
  const Answer answer = call("translate", calls::cube(point(0, 0, 0), point(1, 1, 1)), vector(1e17, 0, 0));
  ASSERT_TRUE(answer.is_defined());
  EXPECT_EQ(call("volume", answer.get<Volume3d>()).get<double>(), 1.0);
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_NE(answer.diagnostics[0].find("kept as fractions"), std::string::npos);
  // And back again.
  expect_equal(call("translate", answer.get<Volume3d>(), vector(-1e17, 0, 0)).get<Volume3d>(),
               calls::cube(point(0, 0, 0), point(1, 1, 1)));
}

TEST(Translate, fractions_that_become_doubles_are_doubles) {
  const auto by_third = literal<Vector3d>("(1/3 0 0)");
  EXPECT_EQ(call("translate", literal<Point3d>("(2/3 0 0)"), by_third).text(), "(1.0 0.0 0.0)");
}

TEST(Translate, out_of_the_range_of_doubles_is_undefined) {
  const Answer answer = call("translate", calls::cube(point(0, 0, 0), point(1e308, 1, 1)), vector(1e308, 0, 0));
  EXPECT_FALSE(answer.is_defined());
  EXPECT_EQ(answer.diagnostics,
            std::vector<std::string>{"translate: a coordinate of the image is beyond the range of doubles"});
}

TEST(Scale, multiplies_the_volume_by_the_cube_of_the_factor) {
  const Volume3d before = calls::cube(point(1, 2, 3), point(4, 8, 5));
  EXPECT_EQ(call("volume", call("scale", before, point(1, 1, 1), 0.5).get<Volume3d>()).get<double>(), 4.5);
  EXPECT_EQ(call("volume", call("scale", before, point(1, 1, 1), -2).get<Volume3d>()).get<double>(), 288.0);
  EXPECT_EQ(call("volume", call("scaleDir", before, point(1, 1, 1), vector(2, -3, 1)).get<Volume3d>()).get<double>(),
            216.0);
}

TEST(Scale, by_zero_is_undefined_for_solids_and_fine_for_points) {
  const Answer answer = call("scale", part(), point(0, 0, 0), 0.0);
  EXPECT_FALSE(answer.is_defined());
  EXPECT_EQ(answer.diagnostics, std::vector<std::string>{"scale: a zero factor would flatten the shape"});
  EXPECT_EQ(call("scale", point(1, 2, 3), point(4, 5, 6), 0.0).text(), "(4.0 5.0 6.0)");
  EXPECT_EQ(call("scale", literal<Points3d>("((1 2 3) (3 2 1))"), point(4, 5, 6), 0.0).text(), "((4.0 5.0 6.0))");
}

TEST(Scale, of_points_moves_each) {
  EXPECT_EQ(call("scaleDir", literal<Points3d>("((1 2 3) (3 2 1))"), point(0, 0, 0), vector(-1, 1, 2)).text(),
            "((-3.0 2.0 2.0) (-1.0 2.0 6.0))");
}

TEST(Scale, to_subnormal_size_keeps_a_valid_solid) {
  const Answer answer = call("scale", part(), point(0, 0, 0), 1e-320);
  ASSERT_TRUE(answer.is_defined());
  EXPECT_TRUE((*Volume3d::prove(answer.get<Volume3d>().mesh())).is_defined());
}

}  // namespace
}  // namespace algebra3d
