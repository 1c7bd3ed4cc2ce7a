#include "algebra3d/repair/rims.h"

#include <cmath>

#include "unit/repair/soups.h"

namespace algebra3d::soups::rims_tests {
namespace {

constexpr double kAny = 1e9;

bool is_balanced_everywhere(const FacetList& facets) {
  return is_closed(*facets.mesh()) && is_consistently_oriented(*facets.mesh());
}

/// A cube, and a tent of two facets over an edge of the diagonal of its lid, of which one side is missing.
TriangleSoup cube_with_half_a_tent() {
  TriangleSoup soup = cube_soup(0, 2);
  const Vec3 top{1, 1, 3};
  // Half a pyramid over one facet of the lid, looking out; its side over the diagonal is left out.
  for (const SoupTriangle& t : cube_soup(0, 2).triangles) {
    if (t[0].z != 2 || t[1].z != 2 || t[2].z != 2) continue;
    for (std::size_t i = 0; i < 3; ++i)
      if ((t[i] - t[(i + 1) % 3]).x == 0 || (t[i] - t[(i + 1) % 3]).y == 0)
        soup.triangles.push_back({t[i], t[(i + 1) % 3], top});
    break;
  }
  return soup;
}

TEST(Rims, a_hole_between_a_boundary_and_edges_of_three_facets_is_covered) {
  FacetList facets = facets_of(cube_with_half_a_tent());
  ASSERT_FALSE(is_closed(*facets.mesh()));
  RepairReport report;
  ASSERT_TRUE(close_rims(facets, {kAny}, report).ok());
  EXPECT_TRUE(is_closed(*facets.mesh()));
  EXPECT_GE(count_of(report, RepairStep::holes), 1U);
  ASSERT_TRUE(close_rims(facets, {kAny, true}, report).ok());
  EXPECT_TRUE(is_balanced_everywhere(facets));
}

TEST(Rims, what_is_too_large_stays_open) {
  FacetList facets = facets_of(cube_with_half_a_tent());
  const auto before = facets.triangles;
  RepairReport report;
  ASSERT_TRUE(close_rims(facets, {1.0}, report).ok());
  EXPECT_EQ(facets.triangles, before);
  EXPECT_TRUE(report.is_empty());
}

TEST(Rims, loops_of_boundary_edges_are_no_concern) {
  TriangleSoup soup = cube_soup(0, 1);
  soup.triangles.resize(10);
  FacetList facets = facets_of(soup);
  RepairReport report;
  ASSERT_TRUE(close_rims(facets, {kAny}, report).ok());
  EXPECT_EQ(facets.triangles.size(), 10U);
}

TEST(Rims, inner_walls_are_covered_on_demand) {
  // A wall across a box, whose rim is made of edges of the box.
  TriangleSoup soup = joined(joined(box_soup({0, 0, 0}, {1, 1, 1}), box_soup({1, 0, 0}, {2, 1, 1})), TriangleSoup());
  std::erase_if(soup.triangles, [left = 2](const SoupTriangle& t) mutable {
    return t[0].x == 1 && t[1].x == 1 && t[2].x == 1 && left-- > 0;
  });
  for (const bool covers : {false, true}) {
    FacetList facets = facets_of(soup);
    RepairReport report;
    ASSERT_TRUE(close_rims(facets, {kAny, covers}, report).ok());
    EXPECT_EQ(facets.triangles.size(), covers ? 24U : 22U);
    EXPECT_EQ(is_balanced_everywhere(facets), covers);
  }
}

}  // namespace
}  // namespace algebra3d::soups::rims_tests
