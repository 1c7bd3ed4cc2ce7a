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

/// All triangles one by one.
double winding_number_by_sum(const TriangleSoup& soup, const Vec3& point) {
  double sum = 0;
  for (const SoupTriangle& t : soup.triangles) {
    TriangleSoup one;
    one.triangles = {t};
    const IndexedSoup indexed = indexed_soup(one);
    sum += GeneralizedWindingNumbers(indexed).at(point);
  }
  return sum;
}

// Parts that are seen from outside their boxes count by their boundaries: whatever the triangles are.
TEST(GeneralizedWindingNumbers, of_parts_are_those_of_their_triangles) {
  for (int seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = seed % 4 == 0 ? soup_of(random_triangles_on_grid(chance, 300, 4))
                                      : soup_of(seed % 2 == 0 ? samples::torus(24, 16) : solids::geodesic_sphere(7));
    if (seed % 4 != 0) soup = joined(soup, shifted(turned(cube_soup(-1, 1)), {1, 0, 0}));
    for (SoupTriangle& t : soup.triangles)
      if (chance.one_in(20)) t = turned(t);
    std::erase_if(soup.triangles, [&](const SoupTriangle&) { return chance.one_in(10); });
    const IndexedSoup indexed = indexed_soup(soup);
    const GeneralizedWindingNumbers numbers(indexed);
    for (int i = 0; i < 20; ++i) {
      const Vec3 point{4 * chance.unit(), 4 * chance.unit(), 3 * chance.unit()};
      EXPECT_NEAR(numbers.at(point), winding_number_by_sum(soup, point), 1e-9);
    }
  }
}

TEST(GeneralizedWindingNumbers, of_closed_surfaces_take_few_solid_angles) {
  std::vector<double> angles;
  for (const int n : {20, 40}) {
    const IndexedSoup indexed = indexed_soup(soup_of(solids::geodesic_sphere(n)));
    const GeneralizedWindingNumbers numbers(indexed);
    Chance chance(1);
    for (int i = 0; i < 100; ++i) numbers.at(0.9 * Vec3{chance.unit(), chance.unit(), chance.unit()});
    angles.push_back(static_cast<double>(numbers.angle_count()) / 100);
    EXPECT_LT(angles.back(), static_cast<double>(indexed.triangles.size()) / 4);
  }
  EXPECT_LT(angles[1], 3 * angles[0]);  // four times the triangles
}

TEST(GeneralizedWindingNumbers, degenerate_triangles_add_nothing) {
  TriangleSoup soup = cube_soup(-1, 1);
  soup.triangles.push_back({Vec3{0, 0, 5}, Vec3{0, 0, 5}, Vec3{3, 2, 1}});
  soup.triangles.push_back({Vec3{2, 2, 2}, Vec3{3, 3, 3}, Vec3{4, 4, 4}});
  const IndexedSoup indexed = indexed_soup(soup);
  EXPECT_NEAR(GeneralizedWindingNumbers(indexed).at({0.25, 0.5, 0.125}), 1, 1e-12);
}

// Each of many closed bodies is seen from outside as nothing, so that a point is asked of the body about it alone.
TEST(GeneralizedWindingNumbers, of_many_bodies_need_the_angles_of_one) {
  TriangleSoup soup;
  for (int i = 0; i < 100; ++i)
    soup = joined(std::move(soup), shifted(soup_of(solids::geodesic_sphere(2)), {0.1 * i, 2.5 * i, 0}));
  const IndexedSoup indexed = indexed_soup(soup);
  const GeneralizedWindingNumbers numbers(indexed);
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(numbers.at({0.1 * i, 2.5 * i, 0.1}), 1, 1e-9);
  const std::size_t of_one = soup.triangles.size() / 100;
  EXPECT_LE(numbers.angle_count(), 100 * of_one);
}

}  // namespace
}  // namespace algebra3d::soups
