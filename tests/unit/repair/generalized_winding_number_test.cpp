#include "algebra3d/kernel/repair/detail/generalized_winding_number.h"

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

TEST(GeneralizedWindingNumbers, of_closed_triangles_are_those_that_lines_count) {
  for (int seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = soup_of(samples::torus(12, 8));
    for (int n = chance.between(0, 3); n > 0; --n) {
      const TriangleSoup other =
          shifted(soup_of(solids::geodesic_sphere(2)), {4 * chance.unit(), 4 * chance.unit(), chance.unit()});
      soup = joined(std::move(soup), chance.one_in(2) ? other : turned(other));
    }
    const IndexedSoup indexed = indexed_soup(soup);
    const GeneralizedWindingNumbers numbers(indexed);
    EXPECT_EQ(numbers.triangle_count(), soup.triangles.size());
    for (int i = 0; i < 40; ++i) {
      const Vec3 point{4 * chance.unit(), 4 * chance.unit(), chance.unit()};
      EXPECT_NEAR(numbers.at(point), winding_about(*indexed.mesh(), ExactPoint(point)), 1e-9);
    }
  }
}

TEST(GeneralizedWindingNumbers, are_shares_of_the_sphere_where_triangles_are_missing) {
  TriangleSoup octahedron = soup_of(solids::geodesic_sphere(1));
  for (int left = 8; left >= 0; --left) {
    const IndexedSoup indexed = indexed_soup(octahedron), back = indexed_soup(turned(octahedron));
    EXPECT_NEAR(GeneralizedWindingNumbers(indexed).at({0, 0, 0}), left / 8.0, 1e-12);
    EXPECT_NEAR(GeneralizedWindingNumbers(back).at({0, 0, 0}), -left / 8.0, 1e-12);
    if (left > 0) octahedron.triangles.pop_back();
  }
  TriangleSoup cube = cube_soup(-1, 1);
  std::erase_if(cube.triangles, [](const SoupTriangle& t) { return t[0].z == 1 && t[1].z == 1 && t[2].z == 1; });
  const IndexedSoup indexed = indexed_soup(cube);
  EXPECT_NEAR(GeneralizedWindingNumbers(indexed).at({0, 0, 0}), 5.0 / 6, 1e-12);
  EXPECT_NEAR(GeneralizedWindingNumbers(indexed).at({0, 0, 1e9}), 0, 1e-12);
}

TEST(GeneralizedWindingNumbers, degenerate_triangles_add_nothing) {
  TriangleSoup soup = cube_soup(-1, 1);
  soup.triangles.push_back({Vec3{0, 0, 5}, Vec3{0, 0, 5}, Vec3{3, 2, 1}});
  soup.triangles.push_back({Vec3{2, 2, 2}, Vec3{3, 3, 3}, Vec3{4, 4, 4}});
  const IndexedSoup indexed = indexed_soup(soup);
  EXPECT_NEAR(GeneralizedWindingNumbers(indexed).at({0.25, 0.5, 0.125}), 1, 1e-12);
}

}  // namespace
}  // namespace algebra3d::soups
