#include "algebra3d/kernel/repair/detail/nonmanifold_loops.h"

#include <cmath>

#include "unit/repair/soups.h"

namespace algebra3d::soups::nonmanifold_loops_tests {
namespace {

constexpr double kAnyLoop = 1e9;

bool is_balanced_everywhere(const IndexedSoup& indexed) {
  return is_closed(*indexed.mesh()) && is_consistently_oriented(*indexed.mesh());
}

/// A cube, and a tent of two triangles over an edge of the diagonal of its lid, of which one side is missing.
TriangleSoup cube_with_half_a_tent() {
  TriangleSoup soup = cube_soup(0, 2);
  const Vec3 top{1, 1, 3};
  // Half a pyramid over one triangle of the lid, looking out; its side over the diagonal is left out.
  for (const SoupTriangle& t : cube_soup(0, 2).triangles) {
    if (t[0].z != 2 || t[1].z != 2 || t[2].z != 2) continue;
    for (std::size_t i = 0; i < 3; ++i)
      if ((t[i] - t[(i + 1) % 3]).x == 0 || (t[i] - t[(i + 1) % 3]).y == 0)
        soup.triangles.push_back({t[i], t[(i + 1) % 3], top});
    break;
  }
  return soup;
}

TEST(NonmanifoldLoops, a_hole_between_a_boundary_and_edges_of_three_triangles_is_covered) {
  IndexedSoup indexed = indexed_soup(cube_with_half_a_tent());
  ASSERT_FALSE(is_closed(*indexed.mesh()));
  RepairReport report;
  ASSERT_TRUE(close_nonmanifold_loops(indexed, {kAnyLoop}, report).ok());
  EXPECT_TRUE(is_closed(*indexed.mesh()));
  EXPECT_GE(count_of(report, RepairStep::holes), 1U);
  ASSERT_TRUE(close_nonmanifold_loops(indexed, {kAnyLoop, true}, report).ok());
  EXPECT_TRUE(is_balanced_everywhere(indexed));
}

TEST(NonmanifoldLoops, what_is_too_large_stays_open) {
  IndexedSoup indexed = indexed_soup(cube_with_half_a_tent());
  const auto before = indexed.triangles.values();
  RepairReport report;
  ASSERT_TRUE(close_nonmanifold_loops(indexed, {1.0}, report).ok());
  EXPECT_EQ(indexed.triangles.values(), before);
  EXPECT_TRUE(report.is_empty());
}

TEST(NonmanifoldLoops, loops_of_boundary_edges_are_no_concern) {
  TriangleSoup soup = cube_soup(0, 1);
  soup.triangles.resize(10);
  IndexedSoup indexed = indexed_soup(soup);
  RepairReport report;
  ASSERT_TRUE(close_nonmanifold_loops(indexed, {kAnyLoop}, report).ok());
  EXPECT_EQ(indexed.triangles.size(), 10U);
}

TEST(NonmanifoldLoops, inner_walls_are_covered_on_demand) {
  // A wall across a box, whose rim is made of edges of the box.
  TriangleSoup soup = joined(joined(box_soup({0, 0, 0}, {1, 1, 1}), box_soup({1, 0, 0}, {2, 1, 1})), TriangleSoup());
  std::erase_if(soup.triangles, [left = 2](const SoupTriangle& t) mutable {
    return t[0].x == 1 && t[1].x == 1 && t[2].x == 1 && left-- > 0;
  });
  for (const bool covers : {false, true}) {
    IndexedSoup indexed = indexed_soup(soup);
    RepairReport report;
    ASSERT_TRUE(close_nonmanifold_loops(indexed, {kAnyLoop, covers}, report).ok());
    EXPECT_EQ(indexed.triangles.size(), covers ? 24U : 22U);
    EXPECT_EQ(is_balanced_everywhere(indexed), covers);
  }
}

}  // namespace
}  // namespace algebra3d::soups::nonmanifold_loops_tests
