#include "algebra3d/kernel/repair/detail/degenerate_triangles.h"

#include <cmath>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

using Corners = TriangleMesh::Triangle;

TEST(DegenerateTriangles, are_those_without_area_and_no_others) {
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    IndexedSoup indexed = random_triangles_on_grid(chance, 100, 3);
    std::vector<Corners> expected;
    std::uint64_t repeated_count = 0, collinear_count = 0;
    for (const Corners& t : indexed.triangles) {
      const Vec3 &a = indexed.points[t[0]], &b = indexed.points[t[1]], &c = indexed.points[t[2]];
      // Exact for small whole numbers.
      const Vec3 normal = cross(b - a, c - a);
      if (a == b || b == c || c == a)
        ++repeated_count;
      else if (normal == Vec3{})
        ++collinear_count;
      else
        expected.push_back(t);
    }
    RepairReport report;
    drop_degenerate_triangles(indexed, report);
    EXPECT_EQ(indexed.triangles.values(), expected);
    EXPECT_EQ(count_of(report, RepairStep::repeated_corners), repeated_count);
    EXPECT_EQ(count_of(report, RepairStep::collinear_corners), collinear_count);
    EXPECT_EQ(report.deviation(), 0);
  }
}

TEST(DegenerateTriangles, decisions_are_exact) {
  const double next = std::nextafter(0.5, 1.0);
  TriangleSoup soup;
  soup.triangles = {{Vec3{0, 0, 0}, Vec3{1, 1, 1}, Vec3{0.5, 0.5, 0.5}},
                    {Vec3{0, 0, 0}, Vec3{1, 1, 1}, Vec3{0.5, 0.5, next}},
                    {Vec3{0, 0, 0}, Vec3{1e-300, 1e-300, 0}, Vec3{1e-300, -1e-300, 0}},
                    {Vec3{-1e300, 0, 0}, Vec3{1e300, 0, 0}, Vec3{0, 1e-300, 0}},
                    {Vec3{-1e300, 0, 0}, Vec3{1e300, 0, 0}, Vec3{1e-300, 0, 0}}};
  IndexedSoup indexed = indexed_soup(soup);
  const std::vector<Corners> all = indexed.triangles.values();
  RepairReport report;
  drop_degenerate_triangles(indexed, report);
  EXPECT_EQ(indexed.triangles.values(), (std::vector<Corners>{all[1], all[2], all[3]}));
}

}  // namespace
}  // namespace algebra3d::soups
