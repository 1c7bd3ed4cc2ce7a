// Operands that touch themselves in points that are not vertices of all that meets there, which is valid (validity.h).
#include <gtest/gtest.h>

#include <string>

#include "unit/arrangement/micro_cases.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

void expect_laws(const TriangleMesh& a, const TriangleMesh& b) {
  SetOperations engine;
  const TriangleMesh united = engine.unite(a, b), common = engine.intersect(a, b), rest = engine.subtract(a, b);
  EXPECT_EQ(exact_volume_of(united) + exact_volume_of(common), exact_volume_of(a) + exact_volume_of(b));
  EXPECT_EQ(exact_volume_of(rest) + exact_volume_of(common), exact_volume_of(a));
  EXPECT_TRUE(engine.same(engine.unite(rest, common), a));
  EXPECT_EQ(engine.complaints(), "");
}

void expect_laws_with_boxes(const TriangleMesh& a) {
  ASSERT_TRUE(prove_volume(a)->is_valid());
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(seed);
    const Vec3 low = chance.grid_point(5), size = chance.grid_point(5);
    expect_laws(a, box(low, low + size + Vec3{1, 1, 1}));
  }
}

TEST(SelfTouchingOperand, with_a_corner_on_an_edge) {
  expect_laws_with_boxes(joined({cube(0, 4), tetrahedron({4, 4, 2}, {6, 5, 1}, {6, 5, 3}, {5, 7, 2})}));
}

TEST(SelfTouchingOperand, with_a_corner_on_a_face) {
  expect_laws_with_boxes(joined({cube(0, 4), tetrahedron({2, 2, 4}, {3, 2, 6}, {1, 3, 6}, {1, 1, 6})}));
}

// Both edges lie in the plane of a face of the box or pass through it in that point.
TEST(SelfTouchingOperand, with_edges_that_cross_in_a_point) {
  const TriangleMesh a = joined({cube(0, 4), tetrahedron({2, 3, 5}, {2, 5, 3}, {1, 6, 6}, {3, 6, 6})});
  expect_laws(a, box({1, 2, 1}, {2, 6, 5}));
  expect_laws_with_boxes(a);
}

}  // namespace
}  // namespace algebra3d::solids
