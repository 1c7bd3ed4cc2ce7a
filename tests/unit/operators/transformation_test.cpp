#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
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

/// Random tetrahedra with small integers as coordinates: unions and intersections of them have fractions.
class RandomSolids {
 public:
  Volume3d tetrahedron() {
    for (;;) {
      samples::MeshMaker maker;
      maker.tetrahedron(corner(), corner(), corner(), corner());
      if (auto solid = Volume3d::prove(maker.mesh()); solid.ok() && solid->is_defined()) return **solid;
    }
  }
  Vec3 corner() { return {coordinate(), coordinate(), coordinate()}; }

 private:
  double coordinate() { return static_cast<double>(random_() % 17) - 8; }

  std::mt19937 random_{5};  // NOLINT(cert-msc51-cpp): the same numbers each time
};

bool has_fractions(const Volume3d& solid) {
  return solid.mesh().points().exact_count() > 0;
}

using Motion = std::function<Volume3d(const Volume3d&)>;

/// Maps that give doubles for small integers, exactly.
std::vector<Motion> exact_motions() {
  const auto motion = [](const char* name, auto... arguments) {
    return Motion([=](const Volume3d& solid) { return call(name, solid, arguments...).template get<Volume3d>(); });
  };
  const auto plane = [](const char* text) { return literal<Plane3d>(text); };
  return {motion("rotate", point(0, 0, 0), vector(0, 0, 1), 90.0),
          motion("rotate", point(1, -2, 0.5), vector(0, 3, 0), -90.0),
          motion("rotate", point(1, -2, 0.5), vector(1, 0, 0), 180.0),
          motion("rotate", point(3, 0, 0), vector(1, 0, -1), 180.0),
          motion("mirror", plane("(0 0 0 1)")),
          motion("mirror", plane("(-7 0 -2 0)")),
          motion("mirror", plane("((1 2 3) (1 1 0))")),
          motion("translate", vector(0.5, -1024, 3)),
          motion("translate", vector(0x1p40, 0, 0x1p-20)),
          motion("scale", point(0, 0, 0), 0.25),
          motion("scale", point(1, 1, 1), -3.0),
          motion("scaleDir", point(1, 2, 3), vector(2, -0.5, 1))};
}

TEST(ExactImages, of_set_operations_are_those_of_the_moved_operands) {
  RandomSolids random;
  const std::vector<Motion> motions = exact_motions();
  std::size_t with_fractions = 0;
  for (int i = 0; i < 60; ++i) {
    const Volume3d a = random.tetrahedron(), b = random.tetrahedron();
    const Motion& move = motions[static_cast<std::size_t>(i) % motions.size()];
    for (const char* operation : {"union", "intersection", "minus"}) {
      const Volume3d together = call(operation, a, b).get<Volume3d>(), image = move(together);
      expect_equal(image, call(operation, move(a), move(b)).get<Volume3d>());
      with_fractions += has_fractions(together) ? 1 : 0;
      EXPECT_TRUE(audit(image.mesh()).empty());
      EXPECT_TRUE((*Volume3d::prove(image.mesh())).is_defined());
    }
  }
  EXPECT_GT(with_fractions, 60U);
}

TEST(ExactImages, of_surfaces_are_those_of_the_moved_operands) {
  const auto a = literal<Surface3d>("(((0 0 0) (7 1 0) (2 5 1)) ((0 0 3) (7 1 3) (2 5 5)))");
  const auto b = literal<Surface3d>("(((1 0 -3) (4 1 8) (2 6 1)))");
  const Surface3d cut = call("union", a, b).get<Surface3d>();
  ASSERT_GT(cut.mesh().points().exact_count(), 0U);
  const auto turn = [](const Surface3d& s) {
    return call("rotate", s, point(1, 2, 0.5), vector(0, 1, 0), 90.0).get<Surface3d>();
  };
  EXPECT_EQ(compare(Value::of(turn(cut)), call("union", turn(a), turn(b)).single()), std::strong_ordering::equal);
}

TEST(ExactImages, there_and_back_is_the_same_value) {
  RandomSolids random;
  std::mt19937_64 numbers(9);
  std::uniform_real_distribution<double> any(-1e3, 1e3);
  for (int i = 0; i < 40; ++i) {
    const Volume3d solid = call("union", random.tetrahedron(), random.tetrahedron()).get<Volume3d>();
    if (!has_fractions(solid)) continue;
    const double x = any(numbers), y = any(numbers), z = any(numbers);
    const Volume3d moved = call("translate", solid, vector(x, y, z)).get<Volume3d>();
    expect_equal(call("translate", moved, vector(-x, -y, -z)).get<Volume3d>(), solid);
    const Volume3d grown = call("scale", solid, point(x, y, z), -4.0).get<Volume3d>();
    expect_equal(call("scale", grown, point(x, y, z), -0.25).get<Volume3d>(), solid);
    Volume3d turned = solid;
    for (int k = 0; k < 4; ++k) turned = call("rotate", turned, point(x, y, z), vector(0, z, 0), 90.0).get<Volume3d>();
    expect_equal(turned, solid);
  }
}

TEST(ExactImages, of_points_with_fractions) {
  const auto third = literal<Point3d>("(1/3 0 0.1)");
  EXPECT_EQ(call("rotate", third, point(1, 0, 0), vector(0, 0, 1), 90.0).text(), "(1.0 -2/3 0.1)");
  EXPECT_EQ(call("translate", third, vector(1, 2, 3)).text().substr(0, 9), "(4/3 2.0 ");
  EXPECT_EQ(call("scale", third, point(0, 0, 0), 0.5).text(), "(1/6 0.0 0.05)");
  // Sets: each point by itself, so that sets of points and their unions are moved alike.
  const auto set = literal<Points3d>("((0.1 0 0) (1/3 0 0))");
  EXPECT_EQ(call("translate", set, vector(0.2, 0, 0)).text(),
            "((0.30000000000000004 0.0 0.0) (" + (Rational(1, 3) + Rational(0.2)).text() + " 0.0 0.0))");
}

TEST(ExactImages, other_maps_round_fractions_once) {
  const auto thirds = literal<Point3d>("(1/3 1/7 0)");
  EXPECT_TRUE(call("rotate", thirds, point(0, 0, 0), vector(0, 0, 1), 37.0).get<Point3d>().position.is_double());
  EXPECT_TRUE(call("mirror", thirds, literal<Plane3d>("((0 0 0) (1 1 1))")).get<Point3d>().position.is_double());
}

}  // namespace
}  // namespace algebra3d
