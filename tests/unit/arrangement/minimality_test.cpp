// Results have no triangle that their set of points does not need, if their operands have none.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "algebra3d/kernel/arrangement/divide_and_conquer.h"
#include "support/rounds.h"
#include "unit/arrangement/micro_cases.h"
#include "unit/arrangement/minimality.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

std::size_t superfluous(const TriangleMesh& mesh) {
  return Superfluity(mesh).triangle_count();
}

void expect_as_small(const TriangleMesh& a, const TriangleMesh& b, const char* law) {
  EXPECT_EQ(a.face_count(), b.face_count()) << law;
}

void expect_minimal_results(const TriangleMesh& a, const TriangleMesh& b) {
  SetOperations engine;
  const TriangleMesh either = engine.difference_of_both(a, b), both = engine.unite(a, b),
                     common = engine.intersect(a, b);
  const TriangleMesh rest = engine.subtract(a, b), other_rest = engine.subtract(b, a);
  for (const TriangleMesh* mesh : {&either, &both, &common, &rest, &other_rest}) EXPECT_EQ(superfluous(*mesh), 0U);
  expect_as_small(either, engine.difference_of_both(b, a), "A^B = B^A");
  expect_as_small(either, engine.unite(rest, other_rest), "A^B = (A-B)+(B-A)");
  expect_as_small(either, engine.subtract(both, common), "A^B = (A+B)-(A*B)");
  expect_as_small(a, engine.unite(rest, common), "A = (A-B)+(A*B)");
  expect_as_small(a, engine.difference_of_both(either, b), "A = (A^B)^B");
  expect_as_small(both, engine.unite(either, common), "A+B = (A^B)+(A*B)");
  EXPECT_EQ(engine.complaints(), "");
}

TEST(MinimalResults, the_check_finds_what_is_superfluous) {
  EXPECT_EQ(superfluous(cube(0, 1)), 0U);
  EXPECT_EQ(superfluous(sphere(6, 8, 1)), 0U);
  // A corner in the middle of an edge, and one in the middle of a side that was triangulated round it.
  Maker maker;
  const Vec3 a{0, 0, 0}, b{2, 0, 0}, c{2, 2, 0}, d{0, 2, 0}, tip{1, 1, 2};
  const Vec3 on_edge{1, 0, 0}, inside{1, 1, 0};
  maker.triangle(b, on_edge, inside).triangle(on_edge, a, inside).triangle(a, d, inside).triangle(d, c, inside);
  maker.triangle(c, b, inside).triangle(a, on_edge, tip).triangle(on_edge, b, tip).triangle(b, c, tip);
  const TriangleMesh pyramid = maker.triangle(c, d, tip).triangle(d, a, tip).mesh();
  ASSERT_TRUE(prove_volume(pyramid)->is_valid());
  EXPECT_EQ(superfluous(pyramid), 10U - 6U);
}

// Facets of one operand in one plane, parted by an edge of four facets: what is left there is one facet.
TEST(MinimalResults, facets_across_a_nonmanifold_edge_become_one) {
  SetOperations engine;
  const TriangleMesh stairs = engine.unite(box({0, 0, 0}, {1, 1, 1}), box({0, 1, 1}, {1, 2, 2}));
  EXPECT_EQ(engine.difference_of_both(stairs, box({0, 1, 0}, {1, 2, 2})).face_count(), 12U);
  EXPECT_EQ(engine.unite(stairs, box({0, 1, 0}, {1, 2, 1})).face_count(), 2U * 6U + 2U * 4U);
  EXPECT_EQ(engine.complaints(), "");
}

// In the plane of the cube's top, which both have: a corner on an edge, and corners on it from both sides.
TEST(MinimalResults, an_edge_is_not_divided_where_its_own_plane_touches_it_in_a_point) {
  SetOperations engine;
  const TriangleMesh a = cube(0, 4), b = tetrahedron({2, 4, 4}, {1, 6, 4}, {3, 6, 4}, {2, 6, 2});
  EXPECT_EQ(engine.unite(a, b).face_count(), 12U + 4U);
  EXPECT_EQ(engine.difference_of_both(a, b).face_count(), 12U + 4U);
  const TriangleMesh c = tetrahedron({2, 4, 4}, {1, 6, 4}, {3, 6, 4}, {2, 6, 6});
  EXPECT_EQ(engine.unite(a, c).face_count(), 12U + 4U);
  EXPECT_EQ(engine.unite(engine.unite(a, b), box({0, 0, 4}, {4, 4, 5})).face_count(), 12U + 4U);
  EXPECT_EQ(engine.complaints(), "");
}

// A wedge that stands on the middle of the top with its edge: the edge has to be one of the top too.
TEST(MinimalResults, a_touching_edge_is_an_edge_of_the_facet_that_it_touches) {
  SetOperations engine;
  const TriangleMesh wedge = prism(std::vector<Corner>{{2, 4}, {3, 5}, {1, 5}}, 1, 3);
  const TriangleMesh united = engine.unite(cube(0, 4), wedge);
  // The touched side: six corners, one hole.
  EXPECT_EQ(united.face_count(), 5U * 2U + (6U + 2U - 2U) + 8U);
  EXPECT_EQ(superfluous(united), 0U);
}

TriangleMesh random_box(Chance& chance, int size) {
  Vec3 low = chance.grid_point(size), high = chance.grid_point(size);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (low[axis] > high[axis]) std::swap(low[axis], high[axis]);
    if (low[axis] == high[axis]) high[axis] += 1;
  }
  return box(low, high);
}

TEST(MinimalResults, of_random_unions_of_boxes) {
  for (std::uint64_t seed = 1; seed <= rounds(15U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(seed);
    SetOperations engine;
    const int size = chance.between(3, 5);
    const auto boxes = [&] {
      TriangleMesh result = random_box(chance, size);
      for (int n = chance.between(1, 4); n > 0; --n) result = engine.unite(result, random_box(chance, size));
      return result;
    };
    const TriangleMesh a = boxes();
    expect_minimal_results(a, boxes());
    EXPECT_EQ(engine.complaints(), "");
  }
}

TEST(MinimalResults, of_operands_that_touch_themselves) {
  const TriangleMesh corner_on_edge = joined({cube(0, 4), tetrahedron({4, 4, 2}, {6, 5, 1}, {6, 5, 3}, {5, 7, 2})});
  const TriangleMesh corner_on_face = joined({cube(0, 4), tetrahedron({2, 2, 4}, {3, 2, 6}, {1, 3, 6}, {1, 1, 6})});
  const TriangleMesh in_one_plane = joined({cube(0, 4), tetrahedron({2, 4, 4}, {1, 6, 4}, {3, 6, 4}, {2, 6, 2})});
  for (std::uint64_t seed = 0; seed < rounds(15U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(seed);
    const Vec3 low = chance.grid_point(6), size = chance.grid_point(5);
    const TriangleMesh b = box(low, low + size + Vec3{1, 1, 1});
    for (const TriangleMesh* a : {&corner_on_edge, &corner_on_face, &in_one_plane}) expect_minimal_results(*a, b);
  }
}

TEST(MinimalResults, of_many_operands_in_any_order) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(seed);
    SetOperations engine;
    std::vector<TriangleMesh> boxes;
    for (int n = chance.between(9, 20); n > 0; --n) boxes.push_back(random_box(chance, 6));
    std::vector<Operand> operands, reversed;
    TriangleMesh chain;
    for (const TriangleMesh& mesh : boxes) {
      operands.push_back({&mesh});
      reversed.insert(reversed.begin(), {&mesh});
      chain = engine.unite(chain, mesh);
    }
    const TriangleMesh united = *unite_solids(operands);
    EXPECT_EQ(superfluous(united), 0U);
    expect_as_small(united, chain, "aggregate and chain");
    expect_as_small(united, *unite_solids(reversed), "aggregate of the reversed operands");
    EXPECT_EQ(engine.complaints(), "");
  }
}

}  // namespace
}  // namespace algebra3d::solids
