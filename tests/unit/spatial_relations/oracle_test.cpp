// All predicates against brute force (brute_force.h) on random pairs of points, boxes, surfaces and solids on a small
// grid, where most pairs touch in corners, edges or faces.
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "support/rounds.h"
#include "unit/spatial_relations/random_sets.h"

namespace algebra3d {
namespace {

auto as_tuple(const SpatialRelation& r) {
  return std::tuple(r.do_meet, r.do_interiors_meet, r.is_first_inside, r.is_second_inside, r.shared_dimension,
                    r.shared_boundary_dimension);
}

SpatialRelation swapped(SpatialRelation relation) {
  std::swap(relation.is_first_inside, relation.is_second_inside);
  return relation;
}

void expect_agreement(const TestSet& a, const TestSet& b, const SpatialRelation& expected) {
  const SpatialSet first = a.set(), second = b.set();
  EXPECT_EQ(as_tuple(*relation_of(first, second)), as_tuple(expected));
  EXPECT_EQ(*do_meet(first, second), expected.do_meet);
  EXPECT_EQ(*do_touch(first, second), expected.do_meet && !expected.do_interiors_meet);
  EXPECT_EQ(*is_inside(first, second), expected.is_first_inside);
  EXPECT_EQ(*do_overlap(first, second),
            expected.do_interiors_meet && !expected.is_first_inside && !expected.is_second_inside);
  const auto witness = witness_of_meeting(first, second);
  EXPECT_EQ(witness->has_value(), expected.do_meet);
  if (!witness->has_value()) return;
  const std::array<ExactPoint, 1> point{(*witness)->point};
  EXPECT_TRUE(*is_inside(PointSet{point}, first));
  EXPECT_TRUE(*is_inside(PointSet{point}, second));
}

TEST(SpatialRelationOracle, brute_force_agrees_on_random_pairs) {
  std::map<std::tuple<bool, bool, bool, bool, int, int>, int> seen;
  const std::uint64_t first = first_seed();
  for (std::uint64_t seed = first; seed < first + rounds(40U); ++seed) {
    SCOPED_TRACE(seed);
    RandomSets sets(seed);
    const TestSet a = sets.draw(), b = sets.draw();
    const SpatialRelation expected = brute_force::relation(a.oracle, b.oracle);
    ++seen[as_tuple(expected)];
    expect_agreement(a, b, expected);
    expect_agreement(b, a, swapped(expected));
    if (testing::Test::HasFailure()) return;
  }
  RecordProperty("distinct_relations", static_cast<int>(seen.size()));
  EXPECT_GE(seen.size(), is_thorough() ? 20U : 15U);
}

}  // namespace
}  // namespace algebra3d
