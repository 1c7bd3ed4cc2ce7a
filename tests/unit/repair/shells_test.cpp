#include "algebra3d/kernel/repair/detail/shells.h"

#include "algebra3d/kernel/repair/detail/manifold_patches.h"
#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

std::vector<Rational> volumes_of(const TriangleSoup& soup) {
  const auto shells = find_shells(indexed_soup(soup), {});
  EXPECT_TRUE(shells.ok());
  std::vector<Rational> volumes;
  for (const Shell& shell : *shells) volumes.push_back(shell.volume);
  return volumes;
}

TEST(Shells, of_bodies_that_touch_in_an_edge_are_two) {
  const TriangleSoup soup = joined(cube_soup(0, 2), shifted(cube_soup(0, 3), {2, 2, 0}));
  EXPECT_EQ(volumes_of(soup), (std::vector<Rational>{Rational(8), Rational(27)}));
}

TEST(Shells, that_are_inside_out_have_a_negative_volume) {
  EXPECT_EQ(volumes_of(turned(cube_soup(0, 2))), std::vector<Rational>{Rational(-8)});
  EXPECT_EQ(volumes_of(joined(cube_soup(0, 4), turned(cube_soup(1, 3)))),
            (std::vector<Rational>{Rational(64), Rational(-8)}));
}

// One side of each of the two cubes is missing, where they touch: each is open, and together they are closed.
TEST(Shells, are_united_across_edges_where_each_alone_is_unbalanced) {
  TriangleSoup soup = joined(cube_soup(0, 2), shifted(cube_soup(0, 2), {2, 0, 0}));
  std::erase_if(soup.triangles, [](const SoupTriangle& t) { return t[0].x == 2 && t[1].x == 2 && t[2].x == 2; });
  EXPECT_EQ(volumes_of(soup), std::vector<Rational>{Rational(16)});
}

TEST(Shells, flip_with_their_volume) {
  const auto shells = find_shells(indexed_soup(cube_soup(0, 2)), {});
  Shell shell = shells->front();
  EXPECT_EQ(shell.triangles.size(), 12U);
  shell.flip();
  EXPECT_TRUE(shell.is_flipped);
  EXPECT_EQ(shell.volume, Rational(-8));
  EXPECT_EQ(shell.size(), Rational(8));
}

TEST(ManifoldPatches, end_at_edges_of_more_than_two_triangles) {
  // Two cubes with one edge in common, round which four triangles meet.
  const TriangleSoup soup = joined(cube_soup(0, 2), shifted(cube_soup(0, 2), {2, 2, 0}));
  const TriangleMesh mesh = mesh_of(soup);
  DisjointIds<FaceId> patches = manifold_patches(mesh);
  EXPECT_EQ(patches.find(FaceId(11)), FaceId(0));
  EXPECT_EQ(patches.find(FaceId(23)), FaceId(12));
}

TEST(ManifoldPatches, do_not_depend_on_orientation) {
  TriangleSoup soup = cube_soup(0, 2);
  for (std::size_t i = 0; i < soup.triangles.size(); i += 2) soup.triangles[i] = turned(soup.triangles[i]);
  DisjointIds<FaceId> patches = manifold_patches(mesh_of(soup));
  for (std::uint32_t f = 0; f < 12; ++f) EXPECT_EQ(patches.find(FaceId(f)), FaceId(0));
}

}  // namespace
}  // namespace algebra3d::soups
