#include "algebra3d/kernel/arrangement/divide_and_conquer.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

// By halves against all at once.
namespace algebra3d::solids {
namespace {

std::vector<Operand> operands_of(const std::vector<TriangleMesh>& solids) {
  std::vector<Operand> operands;
  for (const TriangleMesh& solid : solids) operands.push_back({&solid});
  return operands;
}

Solids pointers_to(const std::vector<TriangleMesh>& solids) {
  Solids pointers;
  for (const TriangleMesh& solid : solids) pointers.push_back(&solid);
  return pointers;
}

void expect_as_at_once(const std::vector<TriangleMesh>& solids) {
  SetOperations engine;
  const auto united = unite_solids(operands_of(solids)), common = intersect_solids(operands_of(solids));
  ASSERT_TRUE(united.ok() && common.ok());
  EXPECT_EQ(prove_volume(*united)->text(), "");
  EXPECT_EQ(prove_volume(*common)->text(), "");
  EXPECT_TRUE(engine.same(*united, engine.unite_all(pointers_to(solids))));
  EXPECT_TRUE(engine.same(*common, engine.intersect_all(pointers_to(solids))));
  EXPECT_EQ(engine.complaints(), "");
  EXPECT_EQ(triangles_of(*united), triangles_of(*unite_solids(operands_of(solids))));
}

TEST(DivideAndConquer, of_random_solids_is_one_arrangement_of_them) {
  for (std::uint64_t seed = 1; seed <= rounds(3U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SetOperations engine;
    RandomSolids random(seed, engine);
    std::vector<TriangleMesh> solids;
    for (std::uint64_t i = 0; i < 6 + 3 * (seed % 5); ++i) solids.push_back(random.operand());
    expect_as_at_once(solids);
  }
}

TEST(DivideAndConquer, of_solids_that_all_cross_one_another) {
  std::vector<TriangleMesh> solids;
  for (int i = 1; i <= (is_thorough() ? 13 : 8); ++i)
    solids.push_back(rotated(cube(-1, 1), {1, static_cast<double>(i), 3}, 0.5 * i));
  expect_as_at_once(solids);
}

TEST(DivideAndConquer, of_touching_cubes_is_a_box_of_twelve_triangles) {
  std::vector<TriangleMesh> cubes;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 3; ++k) {
        const Vec3 corner{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        cubes.push_back(box(corner, corner + Vec3{1, 1, 1}));
      }
  const auto united = unite_solids(operands_of(cubes));
  EXPECT_EQ(united->face_count(), 12U);
  EXPECT_EQ(exact_volume_of(*united), Rational(60));
  EXPECT_TRUE(intersect_solids(operands_of(cubes))->is_empty());
}

TEST(DivideAndConquer, with_gaps_of_one_unit_in_the_last_place_keeps_all_apart) {
  std::vector<TriangleMesh> cubes;
  Rational volume;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        const auto below = [](int n) { return std::nextafter(n + 1.0, 0.0); };
        cubes.push_back(box({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)},
                            {below(i), below(j), below(k)}));
        volume += exact_volume_of(cubes.back());
      }
  const auto united = unite_solids(operands_of(cubes));
  EXPECT_EQ(united->face_count(), 64U * 12);
  EXPECT_EQ(exact_volume_of(*united), volume);
  EXPECT_EQ(prove_volume(*united)->text(), "");
}

TEST(DivideAndConquer, of_few_solids) {
  EXPECT_TRUE(unite_solids({})->is_empty());
  const std::vector<TriangleMesh> one{cube(0, 1)};
  EXPECT_EQ(unite_solids(operands_of(one))->face_count(), 12U);
  EXPECT_EQ(intersect_solids(operands_of(one))->face_count(), 12U);
}

}  // namespace
}  // namespace algebra3d::solids
