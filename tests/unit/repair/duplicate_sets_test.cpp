#include "algebra3d/kernel/repair/detail/duplicate_sets.h"

#include "algebra3d/kernel/repair/detail/opposite_sets.h"
#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

const SoupTriangle kTriangle{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};

TEST(DuplicateSets, have_all_triangles_with_the_same_corners) {
  TriangleSoup soup;
  soup.triangles = {kTriangle,
                    {Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, 1, 0}},
                    turned(kTriangle),
                    {kTriangle[1], kTriangle[2], kTriangle[0]}};
  const DuplicateSets sets = duplicate_sets(mesh_of(soup));
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_EQ(sets.front().triangles, (std::vector<FaceId>{FaceId(0), FaceId(2), FaceId(3)}));
  EXPECT_EQ(sets.front().balance, 1);
  EXPECT_FALSE(sets.front().is_balanced());
}

TEST(DuplicateSets, of_triangles_back_to_back_are_balanced) {
  TriangleSoup soup;
  soup.triangles = {kTriangle, turned(kTriangle)};
  const DuplicateSets sets = duplicate_sets(mesh_of(soup));
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_TRUE(sets.front().is_balanced());
}

TEST(DuplicateSets, of_a_closed_mesh_are_none) {
  EXPECT_TRUE(duplicate_sets(solids::cube(0, 1)).empty());
}

TEST(DuplicateSets, know_even_triangles_from_odd_ones) {
  for (const IndexTriangle& even : {IndexTriangle{1, 2, 3}, {2, 3, 1}, {3, 1, 2}}) EXPECT_TRUE(is_even(even));
  for (const IndexTriangle& odd : {IndexTriangle{1, 3, 2}, {3, 2, 1}, {2, 1, 3}}) EXPECT_FALSE(is_even(odd));
}

/// The triangles that stay of those of which both orientations are equally frequent.
IdVector<DuplicateSetId, FaceId> kept_of(const TriangleMesh& mesh) {
  const DuplicateSets sets = duplicate_sets(mesh);
  const IdVector<FaceId, bool> is_dropped(mesh.face_count());
  return OppositeSets(mesh, sets, is_dropped).kept();
}

// A cube of which one triangle is there twice, back to back: one single triangle meets each of its edges.
TEST(OppositeSets, stay_where_the_surface_would_have_a_hole) {
  TriangleSoup soup = cube_soup(0, 2);
  const SoupTriangle outward = soup.triangles[0];
  soup.triangles.insert(soup.triangles.begin(), turned(outward));
  const auto kept = kept_of(mesh_of(soup));
  ASSERT_EQ(kept.size(), 1U);
  // The one that looks out, as its neighbours do.
  EXPECT_EQ(kept.front(), FaceId(1));
}

// Between two cubes side by side, two single triangles meet the boundary of the double wall.
TEST(OppositeSets, go_where_nothing_needs_them) {
  const auto kept = kept_of(mesh_of(joined(cube_soup(0, 2), shifted(cube_soup(0, 2), {2, 0, 0}))));
  ASSERT_EQ(kept.size(), 2U);
  for (const FaceId face : kept) EXPECT_FALSE(face.is_valid());
}

TEST(OppositeSets, stay_where_all_is_double) {
  TriangleSoup soup = wall_of_squares();
  soup = joined(soup, turned(soup));
  const auto kept = kept_of(mesh_of(soup));
  EXPECT_EQ(kept.size(), 32U);
  for (const FaceId face : kept) EXPECT_TRUE(face.is_valid());
}

}  // namespace
}  // namespace algebra3d::soups
