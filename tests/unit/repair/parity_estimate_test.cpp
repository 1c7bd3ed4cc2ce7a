#include "algebra3d/kernel/repair/detail/parity_estimate.h"

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

Agreement compared(const TriangleSoup& given, const TriangleSoup& solid) {
  return ParityEstimate(mesh_of(given)).compare(mesh_of(solid));
}

const TriangleSoup kBall = soup_of(solids::geodesic_sphere(6));

TEST(ParityEstimate, a_solid_agrees_with_its_own_triangles) {
  for (const TriangleSoup& soup :
       {cube_soup(0, 1), kBall, soup_of(samples::torus(20, 12)), joined(cube_soup(0, 4), turned(cube_soup(1, 3)))}) {
    const Agreement agreement = compared(soup, soup);
    EXPECT_GT(agreement.enclosed, 0);
    EXPECT_EQ(agreement.missing, 0);
    EXPECT_EQ(agreement.added, 0);
    EXPECT_EQ(agreement.held, agreement.enclosed);
  }
}

TEST(ParityEstimate, does_not_depend_on_which_way_triangles_look) {
  Chance chance(1);
  TriangleSoup soup = kBall;
  for (SoupTriangle& t : soup.triangles)
    if (chance.one_in(2)) t = turned(t);
  const Agreement agreement = compared(soup, kBall);
  EXPECT_NEAR(agreement.missing, 0, 1e-9);
  EXPECT_FALSE(agreement.is_doubtful());
}

TEST(ParityEstimate, bears_missing_and_repeated_triangles_and_sheets) {
  Chance chance(2);
  TriangleSoup soup;
  for (const SoupTriangle& t : kBall.triangles) {
    if (!chance.one_in(30)) soup.triangles.push_back(t);
    if (chance.one_in(10)) soup.triangles.push_back(turned(t));
  }
  soup.triangles.push_back({Vec3{-5, -5, 0.1}, Vec3{5, -5, 0.1}, Vec3{0, 9, 0.1}});
  EXPECT_FALSE(compared(soup, kBall).is_doubtful());
  EXPECT_TRUE(compared(soup, TriangleSoup()).is_wrong());
}

TEST(ParityEstimate, sees_a_body_that_is_lost) {
  TriangleSoup cubes;
  for (int i = 0; i < 4; ++i) cubes = joined(std::move(cubes), shifted(cube_soup(0, 1), {3.0 * i, 0, 0}));
  TriangleSoup three = cubes, one = cubes;
  three.triangles.resize(36);
  one.triangles.resize(12);
  EXPECT_TRUE(compared(cubes, three).is_doubtful());
  EXPECT_FALSE(compared(cubes, three).is_wrong());
  EXPECT_TRUE(compared(cubes, one).is_wrong());
}

TEST(ParityEstimate, sees_a_cavity_that_is_filled) {
  EXPECT_TRUE(compared(joined(cube_soup(0, 10), turned(cube_soup(1, 9))), cube_soup(0, 10)).is_doubtful());
}

TEST(ParityEstimate, takes_the_union_of_overlapping_bodies_for_right) {
  const TriangleSoup soup = joined(box_soup({0, 0, 0}, {4, 2, 2}), box_soup({1, 0, 0}, {6, 2, 2}));
  EXPECT_FALSE(compared(soup, box_soup({0, 0, 0}, {6, 2, 2})).is_doubtful());
}

TEST(ParityEstimate, says_nothing_of_what_encloses_nothing) {
  for (const TriangleSoup& soup : {TriangleSoup(), wall_of_squares()}) {
    const ParityEstimate enclosure(mesh_of(soup));
    EXPECT_TRUE(enclosure.is_empty());
    EXPECT_FALSE(enclosure.compare(TriangleMesh()).is_doubtful());
  }
}

}  // namespace
}  // namespace algebra3d::soups
