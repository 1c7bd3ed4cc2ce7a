// Triangles that were written with a wrong corner.
#include "algebra3d/kernel/repair/detail/misconnected_triangles.h"

#include "unit/repair/repaired.h"

namespace algebra3d::soups {
namespace {

/// The octahedron abs(x) + abs(y) + abs(z) <= 1, one corner of one triangle of which is another point.
TriangleSoup octahedron(std::size_t triangle, std::size_t corner, const Vec3& wrong) {
  TriangleSoup soup;
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      for (const double z : {1.0, -1.0}) {
        const Vec3 a{x, 0, 0}, b{0, y, 0}, c{0, 0, z};
        soup.triangles.push_back(x * y * z > 0 ? SoupTriangle{a, b, c} : SoupTriangle{a, c, b});
      }
  soup.triangles[triangle][corner] = wrong;
  return soup;
}

TEST(MisconnectedTriangles, a_wrong_corner_behind_the_surface_leaves_no_dent) {
  for (std::size_t triangle = 0; triangle < 8; ++triangle)
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (const Vec3& wrong : {Vec3{}, Vec3{0.1, 0.05, -0.02}, Vec3{-1, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0},
                                Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
        const SolidFromSoup made = repaired(octahedron(triangle, corner, wrong));
        EXPECT_EQ(volume_of(made), Rational(4, 3)) << triangle << " " << corner << ": " << made.status();
      }
}

TEST(MisconnectedTriangles, are_found_inside_out_as_well) {
  const SolidFromSoup made = repaired(turned(octahedron(0, 2, {})));
  EXPECT_EQ(volume_of(made), Rational(4, 3)) << made.status();
}

TEST(MisconnectedTriangles, triangles_of_sheets_and_at_ragged_holes_are_none) {
  for (const TriangleSoup& soup : {wall_at(0, 0, 0, 1, 1), box_soup({0, 0, 0}, {1, 2, 3})}) {
    IndexedSoup indexed = indexed_soup(soup);
    RepairReport report;
    drop_misconnected_triangles(indexed, report);
    EXPECT_EQ(indexed.triangles.size(), soup.triangles.size());
    indexed.triangles.values().erase(indexed.triangles.values().begin());
    indexed.changed();
    drop_misconnected_triangles(indexed, report);
    EXPECT_EQ(indexed.triangles.size(), soup.triangles.size() - 1);
    EXPECT_TRUE(report.is_empty());
  }
}

}  // namespace
}  // namespace algebra3d::soups
