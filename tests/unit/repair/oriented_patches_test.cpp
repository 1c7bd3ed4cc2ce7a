#include "algebra3d/kernel/repair/detail/oriented_patches.h"

#include "algebra3d/kernel/repair/detail/patch_balance.h"
#include "algebra3d/kernel/repair/detail/patch_links.h"
#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

std::size_t flipped_count(const OrientedPatches& patches) {
  return static_cast<std::size_t>(std::ranges::count(patches.is_flipped(), true));
}

/// Pages of a book: triangles at the edge from (0 0 0) to (0 0 1), by the angle around it, as eighths of a turn.
TriangleSoup book(const std::vector<int>& eighths, const std::vector<bool>& are_turned) {
  const std::vector<Vec3> directions{{1, 0, 0},  {1, 1, 0},   {0, 1, 0},  {-1, 1, 0},
                                     {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}};
  TriangleSoup soup;
  for (std::size_t i = 0; i < eighths.size(); ++i) {
    const SoupTriangle page{Vec3{0, 0, 0}, Vec3{0, 0, 1}, directions[static_cast<std::size_t>(eighths[i])]};
    soup.triangles.push_back(are_turned[i] ? turned(page) : page);
  }
  return soup;
}

TEST(OrientedPatches, keep_the_orientation_with_more_area) {
  TriangleSoup soup = cube_soup(0, 2);
  soup.triangles[7] = turned(soup.triangles[7]);
  const OrientedPatches patches(indexed_soup(soup));
  EXPECT_EQ(patches.count(), 1U);
  EXPECT_EQ(flipped_count(patches), 1U);
  EXPECT_TRUE(patches.is_flipped()[FaceId(7)]);
}

TEST(OrientedPatches, are_numbered_by_their_first_triangle) {
  const OrientedPatches patches(indexed_soup(joined(cube_soup(0, 1), cube_soup(5, 6))));
  EXPECT_EQ(patches.count(), 2U);
  EXPECT_EQ(patches.of(FaceId(0)), ManifoldPatchId(0));
  EXPECT_EQ(patches.of(FaceId(23)), ManifoldPatchId(1));
}

TEST(PatchLinks, say_which_pages_that_follow_each_other_agree) {
  // Around the edge forward, back, forward, forward: the third agrees with the second, the fourth with nobody.
  const IndexedSoup soup = indexed_soup(book({0, 2, 4, 6}, {false, true, false, false}));
  const OrientedPatches patches(soup);
  const std::vector<PatchLink> links = patch_links(patches);
  ASSERT_EQ(links.size(), 4U);
  double sum = 0;
  for (const PatchLink& link : links) {
    EXPECT_EQ(std::abs(link.length), 1);
    const bool has_last = link.patch == ManifoldPatchId(3) || link.other == ManifoldPatchId(3);
    EXPECT_EQ(link.length < 0, has_last);
    sum += link.length;
  }
  EXPECT_EQ(sum, 0);
}

TEST(PatchLinks, are_none_where_all_edges_are_balanced) {
  EXPECT_TRUE(patch_links(OrientedPatches(indexed_soup(book({0, 2, 4, 6}, {false, false, true, true})))).empty());
}

TEST(PatchLinks, flip_what_does_not_agree) {
  IndexedSoup soup = indexed_soup(book({0, 2, 4, 6}, {false, true, false, false}));
  OrientedPatches patches(soup);
  flip_linked_patches(soup, patches);
  int balance = 0;
  for (const HalfedgeId h : patches.mesh().nonmanifold_edge(0))
    balance += patches.direction(h, patches.mesh().nonmanifold_edge(0)[0]);
  EXPECT_EQ(balance, 0);
}

TEST(PatchBalance, flips_patches_until_edges_are_balanced) {
  // With three pages no edge is balanced, and two the one way and one the other is the best.
  OrientedPatches patches(indexed_soup(book({0, 3, 5}, {false, false, false})));
  balance_patches(patches);
  EXPECT_EQ(flipped_count(patches), 1U);
  OrientedPatches balanced(indexed_soup(book({0, 3, 5}, {false, true, false})));
  balance_patches(balanced);
  EXPECT_EQ(flipped_count(balanced), 0U);
}

}  // namespace
}  // namespace algebra3d::soups
