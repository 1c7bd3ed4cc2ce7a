// One operation after another on its own result: nothing is rounded, so nothing may get worse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

/// The cube of side 2 in a random direction, its corners rounded to multiples of 2^-14.
TriangleMesh random_cube(Chance& chance) {
  const Vec3 axis = chance.direction();
  const auto rounded = [](double x) { return std::round(x * 0x1p14) * 0x1p-14; };
  return mapped(rotated(cube(-1, 1), axis, 3 * chance.unit()), [&](const Vec3& p) {
    return Vec3{rounded(p.x), rounded(p.y), rounded(p.z)};
  });
}

/// Digits of the longest coordinate, numerator and denominator together.
std::size_t longest_coordinate(const TriangleMesh& mesh) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i < mesh.points().size(); ++i)
    for (std::size_t axis = 0; axis < 3 && !mesh.points()[i].is_double(); ++axis)
      longest = std::max(longest, mesh.points()[i].coordinate(axis).text().size());
  return longest;
}

// A vertex is where three planes of operands meet, however many operations came before. Corners are integers below 2^15
// in units of 2^-14, so a plane's normal has 33 bits and its offset 50; three planes meet at quotients of determinants
// with at most 119 and 102 bits, and the unit adds 14 to the latter: 36 and 35 digits, a sign and a stroke.
constexpr std::size_t kMaxDigits = 73;

TEST(Iteration, intersections_in_a_row_stay_exact_and_valid) {
  Chance chance(1);
  SetOperations engine, unproved(Proofs::none);
  TriangleMesh common = random_cube(chance);
  Rational volume = exact_volume_of(common);
  const int steps = is_thorough() ? 80 : 41;
  for (int step = 1; step < steps; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const TriangleMesh next = random_cube(chance);
    ASSERT_TRUE(prove_volume(next)->is_valid());
    const TriangleMesh rest = (step % 10 == 0 ? engine : unproved).subtract(common, next);
    const TriangleMesh both = engine.intersect(common, next);
    const Rational volume_of_both = exact_volume_of(both);
    ASSERT_EQ(volume_of_both + exact_volume_of(rest), volume);
    ASSERT_LE(longest_coordinate(both), kMaxDigits);
    ASSERT_EQ(engine.complaints() + unproved.complaints(), "");
    if (step % 20 == 0) {
      ASSERT_EQ(exact_volume_of(engine.unite(common, next)) + volume_of_both, volume + exact_volume_of(next));
    }
    common = both;
    volume = volume_of_both;
  }
  // Each cube holds the ball with radius 1, but for the rounding.
  EXPECT_GT(volume.nearest_double(), 4.188);
  EXPECT_LT(volume.nearest_double(), 4.4);
}

TEST(Iteration, unions_in_a_row_are_the_union_of_all) {
  Chance chance(2);
  SetOperations engine;
  std::vector<TriangleMesh> cubes;
  for (int i = 0; i < 12; ++i) cubes.push_back(shifted(random_cube(chance), {0.25 * i, 0, 0}));
  TriangleMesh united;
  Solids all;
  for (const TriangleMesh& mesh : cubes) {
    united = engine.unite(united, mesh);
    all.push_back(&mesh);
  }
  EXPECT_TRUE(engine.same(engine.unite_all(all), united));
  EXPECT_LE(longest_coordinate(united), kMaxDigits);
  EXPECT_EQ(engine.complaints(), "");
}

}  // namespace
}  // namespace algebra3d::solids
