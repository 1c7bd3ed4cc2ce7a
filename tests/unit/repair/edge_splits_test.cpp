#include "algebra3d/kernel/repair/detail/edge_splits.h"

#include "algebra3d/kernel/repair/detail/split_selection.h"
#include "algebra3d/kernel/repair/detail/vertex_merging.h"
#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

/// One triangle above an edge from (0 0 0) to (4 0 0), and two below it that meet in (2 0 0).
TriangleSoup t_junction() {
  TriangleSoup soup;
  soup.triangles = {{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{2, 4, 0}},
                    {Vec3{2, 0, 0}, Vec3{0, 0, 0}, Vec3{2, -4, 0}},
                    {Vec3{4, 0, 0}, Vec3{2, 0, 0}, Vec3{2, -4, 0}}};
  return soup;
}

TEST(EdgeSplits, are_found_at_vertices_on_edges) {
  const IndexedSoup soup = indexed_soup(t_junction());
  const std::vector<EdgeSplit> splits = find_splits(soup, 0, is_exactly_on);
  ASSERT_EQ(splits.size(), 1U);
  EXPECT_EQ(splits[0].edge, HalfedgeId(0));
  EXPECT_EQ(splits[0].parameter, 0.5);
  EXPECT_EQ(soup.point(splits[0].vertex), (Vec3{2, 0, 0}));
}

TEST(EdgeSplits, make_a_fan_around_the_opposite_corner) {
  TriangleSoup given;
  given.triangles = {{Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{0, 3, 0}}};
  IndexedSoup soup = indexed_soup(given);
  soup.points.push_back({1, 0, 0});
  soup.points.push_back({2, 0, 0});
  RepairReport report;
  EXPECT_TRUE(
      split_edges(soup, {{HalfedgeId(0), 2.0 / 3, VertexId(4)}, {HalfedgeId(0), 1.0 / 3, VertexId(3)}}, report));
  EXPECT_EQ(soup.triangles.values(), (std::vector<IndexTriangle>{{0, 3, 2}, {3, 4, 2}, {4, 1, 2}}));
  EXPECT_EQ(count_of(report, RepairStep::t_junctions), 2U);
  EXPECT_EQ(report.deviation(), 0);
}

TEST(EdgeSplits, of_one_triangle_are_made_at_one_edge_at_a_time) {
  TriangleSoup given;
  given.triangles = {{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{0, 2, 0}}};
  IndexedSoup soup = indexed_soup(given);
  soup.points.push_back({1, 0, 0});
  soup.points.push_back({1, 1, 0});
  RepairReport report;
  EXPECT_FALSE(split_edges(soup, {{HalfedgeId(0), 0.5, VertexId(3)}, {HalfedgeId(1), 0.5, VertexId(4)}}, report));
  EXPECT_EQ(soup.triangles.size(), 2U);
}

TEST(SplitSelection, keeps_splits_whose_parts_all_meet_others) {
  const IndexedSoup soup = indexed_soup(t_junction());
  const std::vector<EdgeSplit> splits = find_splits(soup, 0, is_exactly_on);
  EXPECT_EQ(splits_that_stitch(soup, splits), splits);
}

TEST(SplitSelection, leaves_out_splits_of_which_a_part_meets_nothing) {
  TriangleSoup given = t_junction();
  given.triangles.pop_back();
  const IndexedSoup soup = indexed_soup(given);
  const std::vector<EdgeSplit> splits = find_splits(soup, 0, is_exactly_on);
  ASSERT_EQ(splits.size(), 1U);
  EXPECT_TRUE(splits_that_stitch(soup, splits).empty());
}

TEST(VertexMerging, moves_the_higher_vertex_to_the_lower) {
  TriangleSoup given;
  given.triangles = {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}},
                     {Vec3{1, 0, 0.01}, Vec3{0, 0, 0.02}, Vec3{0, -1, 0}}};
  IndexedSoup soup = indexed_soup(given);
  RepairReport report;
  merge_boundary_vertices(soup, 0.05, report);
  EXPECT_EQ(soup.triangles.values(), (std::vector<IndexTriangle>{{0, 1, 2}, {1, 0, 5}}));
  EXPECT_EQ(count_of(report, RepairStep::gaps), 2U);
  EXPECT_EQ(report.deviation(), 0.02);
}

TEST(VertexMerging, never_merges_more_than_a_third_of_an_edge_nor_one_triangle) {
  TriangleSoup given;
  // The corners of the small triangle are nearer to each other than the tolerance, and a gap beside it is wider than a
  // third of its edges.
  given.triangles = {{Vec3{0, 0, 0}, Vec3{0.03, 0, 0}, Vec3{0, 0.03, 0}},
                     {Vec3{1, 0, 0}, Vec3{0, 0, 0.02}, Vec3{1, -1, 0}}};
  IndexedSoup soup = indexed_soup(given);
  const auto before = soup.triangles;
  RepairReport report;
  merge_boundary_vertices(soup, 0.05, report);
  EXPECT_EQ(soup.triangles, before);
  EXPECT_TRUE(report.is_empty());
}

}  // namespace
}  // namespace algebra3d::soups
