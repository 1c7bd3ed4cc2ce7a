#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

// Many solids inside one another that do not touch. Which box is in which follows from their corners alone, so the
// volume of the places that an odd number of them holds is a sum with signs.
namespace algebra3d::solids {
namespace {

bool contains(const Box3& outer, const Box3& inner) {
  return outer.contains(inner.min) && outer.contains(inner.max);
}

/// Boxes on a grid of odd numbers apart from each other, or one within the other.
std::vector<Box3> random_boxes(std::size_t count, Chance& chance) {
  std::vector<Box3> boxes;
  while (boxes.size() < count) {
    const int reach = chance.below(3) == 0 ? 60 : 12;
    const Vec3 corner = chance.grid_point(60);
    const Box3 box{corner, corner + chance.grid_point(reach) + Vec3{1, 1, 1}};
    // Half a unit of room on all sides.
    const auto grown = [](const Box3& b, double by) {
      return Box3{b.min - Vec3{by, by, by}, b.max + Vec3{by, by, by}};
    };
    const bool is_apart = std::ranges::all_of(boxes, [&](const Box3& other) {
      return !other.intersects(grown(box, 0.5)) || contains(other, grown(box, 0.5)) || contains(box, grown(other, 0.5));
    });
    if (is_apart) boxes.push_back(box);
  }
  return boxes;
}

TriangleMesh turned_box(const Box3& b, bool is_turned) {
  const TriangleMesh mesh = box(b.min, b.max);
  return is_turned ? rotated(mesh, {1, 2, 3}, 0.7) : mesh;
}

Rational volume_held_by_an_odd_number(const std::vector<Box3>& boxes, const std::vector<TriangleMesh>& solids) {
  Rational volume;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto outside = std::ranges::count_if(boxes, [&](const Box3& b) { return contains(b, boxes[i]); }) - 1;
    volume += outside % 2 == 0 ? exact_volume_of(solids[i]) : -exact_volume_of(solids[i]);
  }
  return volume;
}

TriangleMesh held_by_an_odd_number(const std::vector<TriangleMesh>& solids) {
  std::vector<Operand> operands;
  for (const TriangleMesh& solid : solids) operands.push_back({&solid, 0});
  return combine_solids(operands, [](const WindingVector& windings) { return windings[0] % 2 != 0; }).value();
}

TEST(NestedSolids, are_counted_around_each_place) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(seed);
    const std::vector<Box3> boxes = random_boxes(10 + 15 * (seed % 4), chance);
    std::vector<TriangleMesh> solids;
    for (const Box3& b : boxes) solids.push_back(turned_box(b, seed % 2 == 0));
    const TriangleMesh odd = held_by_an_odd_number(solids);
    EXPECT_EQ(prove_volume(odd)->text(), "");
    EXPECT_EQ(exact_volume_of(odd), volume_held_by_an_odd_number(boxes, solids));
  }
}

TEST(NestedSolids, hundred_one_in_the_other_with_one_that_cuts_through_all) {
  std::vector<TriangleMesh> solids;
  Rational expected;
  for (int i = 100; i > 0; --i) {
    const double r = i;
    solids.push_back(box({-r, -r, -r}, {r, r, r}));
    expected += Rational(i % 2 == 0 ? 1 : -1) * exact_volume_of(solids.back());
  }
  EXPECT_EQ(exact_volume_of(held_by_an_odd_number(solids)), expected);
  // A rod of breadth 2 about the z axis, in which all is the other way round: of a box it takes 2 * 2 * 2 i.
  solids.push_back(box({-1, -1, -200}, {1, 1, 200}));
  Rational in_rod;
  for (int i = 1; i <= 100; ++i) in_rod += Rational(i % 2 == 0 ? 8 * i : -8 * i);
  const TriangleMesh cut = held_by_an_odd_number(solids);
  EXPECT_EQ(exact_volume_of(cut), expected - in_rod + (Rational(4 * 400) - in_rod));
  EXPECT_EQ(prove_volume(cut)->text(), "");
}

TEST(NestedSolids, of_a_hollow_one_and_others_in_its_cavity) {
  SetOperations engine;
  std::vector<TriangleMesh> solids;
  for (int i = 20; i > 0; i -= 2) {
    const double r = i, s = i - 0.5;
    solids.push_back(engine.subtract(box({-r, -r, -r}, {r, r, r}), box({-s, -s, -s}, {s, s, s})));
  }
  Rational sum;
  for (const TriangleMesh& solid : solids) sum += exact_volume_of(solid);
  EXPECT_EQ(exact_volume_of(held_by_an_odd_number(solids)), sum);
  Solids all;
  for (const TriangleMesh& solid : solids) all.push_back(&solid);
  EXPECT_EQ(exact_volume_of(engine.unite_all(all)), sum);
  EXPECT_TRUE(engine.intersect_all(all).is_empty());
  EXPECT_EQ(engine.complaints(), "");
}

}  // namespace
}  // namespace algebra3d::solids
