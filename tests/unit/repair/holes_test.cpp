#include "algebra3d/kernel/repair/detail/holes.h"

#include <atomic>
#include <limits>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

constexpr double kAnyHole = std::numeric_limits<double>::infinity();

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return length(p - a - t * (b - a));
}

TEST(Holes, of_one_triangle_are_closed_by_that_triangle) {
  for (int seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleSoup whole = soup_of(seed % 2 == 0 ? samples::torus(12, 8) : solids::geodesic_sphere(4));
    TriangleSoup soup = whole;
    // Far enough from each other to be holes of their own.
    std::vector<SoupTriangle> gone;
    for (int n = 0; n < 5; ++n) {
      const std::size_t i = index_below(chance, soup.triangles.size());
      const SoupTriangle t = soup.triangles[i];
      const auto touches = [&](const SoupTriangle& other) {
        return std::ranges::any_of(t, [&](const Vec3& p) { return std::ranges::find(other, p) != other.end(); });
      };
      if (std::ranges::any_of(gone, touches)) continue;
      gone.push_back(t);
      soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(i));
    }
    IndexedSoup indexed = indexed_soup(soup);
    RepairReport report;
    EXPECT_TRUE(close_holes(indexed, {kAnyHole}, report).ok());
    EXPECT_EQ(in_order(soup_of(indexed)), in_order(whole));
    EXPECT_EQ(count_of(report, RepairStep::holes), gone.size());
    EXPECT_EQ(report.entries.size(), 1U);
    // No sample of the new triangles is farther from the loop than the report says.
    for (const auto& [a, b, c] : gone)
      for (int n = 0; n < 20; ++n) {
        const double u = (1 + chance.unit()) / 2, v = (1 - u) * (1 + chance.unit()) / 2;
        const Vec3 p = a + u * (b - a) + v * (c - a);
        const double distance =
            std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
        EXPECT_LE(distance, report.deviation() * (1 + 1e-12));
      }
  }
}

TEST(Holes, of_holes_that_meet_in_a_vertex_each_is_closed) {
  // Opposite triangles at a corner of the octahedron.
  TriangleSoup soup = soup_of(solids::geodesic_sphere(1));
  const TriangleSoup whole = soup;
  std::erase_if(soup.triangles, [](const SoupTriangle& t) {
    const Vec3 sum = t[0] + t[1] + t[2];
    return sum.z > 0 && sum.x * sum.y > 0;
  });
  ASSERT_EQ(soup.triangles.size(), 6U);
  IndexedSoup indexed = indexed_soup(soup);
  RepairReport report;
  EXPECT_TRUE(close_holes(indexed, {kAnyHole}, report).ok());
  EXPECT_EQ(in_order(soup_of(indexed)), in_order(whole));
  EXPECT_EQ(count_of(report, RepairStep::holes), 2U);
}

TEST(Holes, larger_than_wanted_are_left_open) {
  TriangleSoup soup = box_soup({0, 0, 0}, {3, 4, 12});
  std::erase_if(soup.triangles, [](const SoupTriangle& t) { return t[0].z == 12 && t[1].z == 12 && t[2].z == 12; });
  // The diameter of the box round the loop is 5.
  for (const double largest : {0.0, 4.99, 5.0, 100.0}) {
    IndexedSoup indexed = indexed_soup(soup);
    RepairReport report;
    EXPECT_TRUE(close_holes(indexed, {largest}, report).ok());
    const bool is_closed_now = largest >= 5;
    EXPECT_EQ(is_closed(*indexed.mesh()), is_closed_now);
    EXPECT_EQ(count_of(report, RepairStep::holes), is_closed_now ? 1U : 0U);
    EXPECT_EQ(count_of(report, RepairStep::open_holes), is_closed_now ? 0U : 1U);
    EXPECT_EQ(indexed.triangles.size(), is_closed_now ? 12U : 10U);
    // From the middle of the new side it is 1.5 to the loop; half the longest edge is the least that covers it so.
    EXPECT_EQ(report.deviation(), is_closed_now ? 2.5 : 0);
  }
}

TEST(Holes, of_sheets_are_left_open_and_of_cups_closed) {
  // A box without lid: the hole has 1 / (1 + 4 h) of the area of the rest, and 3/4 is the most.
  for (const double height : {0.01, 0.08, 0.09, 1.0}) {
    SCOPED_TRACE(height);
    TriangleSoup soup = box_soup({0, 0, 0}, {1, 1, height});
    std::erase_if(soup.triangles,
                  [&](const SoupTriangle& t) { return t[0].z == height && t[1].z == height && t[2].z == height; });
    IndexedSoup indexed = indexed_soup(soup);
    RepairReport report;
    EXPECT_TRUE(close_holes(indexed, {kAnyHole}, report).ok());
    EXPECT_TRUE(is_closed(*indexed.mesh()));
  }
  IndexedSoup sheet = indexed_soup(wall_of_squares());
  RepairReport report;
  EXPECT_TRUE(close_holes(sheet, {kAnyHole}, report).ok());
  EXPECT_EQ(sheet.triangles.size(), 32U);
  EXPECT_EQ(count_of(report, RepairStep::open_patches), 1U);
  EXPECT_EQ(report.deviation(), 0);
}

TEST(Holes, both_ends_of_a_tube_are_closed_however_short_it_is) {
  for (const double height : {0.01, 10.0}) {
    TriangleSoup soup = box_soup({0, 0, 0}, {4, 4, height});
    std::erase_if(soup.triangles, [](const SoupTriangle& t) { return t[0].z == t[1].z && t[1].z == t[2].z; });
    IndexedSoup indexed = indexed_soup(soup);
    RepairReport report;
    EXPECT_TRUE(close_holes(indexed, {kAnyHole}, report).ok());
    EXPECT_EQ(solids::exact_volume_of(*indexed.mesh()), Rational(16) * Rational(height));
    EXPECT_EQ(count_of(report, RepairStep::holes), 2U);
  }
}

TEST(Holes, that_are_not_plane_are_covered_within_the_surface) {
  for (int seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = soup_of(solids::geodesic_sphere(6));
    const Vec3 direction = chance.direction(), axis = (1 / length(direction)) * direction;
    // A cap up to a third of the height; the rest of the loop goes up and down by an edge.
    std::erase_if(soup.triangles, [&](const SoupTriangle& t) { return dot(t[0] + t[1] + t[2], axis) > 1.6; });
    IndexedSoup indexed = indexed_soup(soup);
    const std::size_t count = indexed.triangles.size();
    ASSERT_LT(count, 288U);
    RepairReport report;
    EXPECT_TRUE(close_holes(indexed, {kAnyHole}, report).ok());
    EXPECT_TRUE(is_closed(*indexed.mesh()));
    EXPECT_TRUE(is_consistently_oriented(*indexed.mesh()));
    EXPECT_EQ(prove_volume(*indexed.mesh())->text(), "");
    const double volume = solids::exact_volume_of(*indexed.mesh()).nearest_double();
    EXPECT_LT(volume, solids::exact_volume_of(solids::geodesic_sphere(6)).nearest_double());
    EXPECT_GT(volume, 2);
  }
}

TEST(Holes, of_no_boundary_there_are_none) {
  IndexedSoup indexed = indexed_soup(cube_soup(0, 1));
  const auto before = indexed.triangles.values();
  RepairReport report;
  EXPECT_TRUE(close_holes(indexed, {kAnyHole}, report).ok());
  EXPECT_EQ(indexed.triangles.values(), before);
  IndexedSoup none = indexed_soup({});
  EXPECT_TRUE(close_holes(none, {kAnyHole}, report).ok());
  EXPECT_TRUE(report.is_empty());
}

TEST(Holes, distances_are_reported_at_every_size) {
  for (const double size : {1e-300, 1e-100, 1.0, 1e100, 1e300}) {
    SCOPED_TRACE(size);
    // A regular tetrahedron whose missing side has its middle a third of its height from the edges.
    const double s = size;
    TriangleSoup soup = soup_of(solids::mapped(solids::tetrahedron({1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}),
                                               [&](const Vec3& p) { return s * p; }));
    soup.triangles.pop_back();
    IndexedSoup indexed = indexed_soup(soup);
    RepairReport report;
    EXPECT_TRUE(close_holes(indexed, {kAnyHole}, report).ok());
    ASSERT_TRUE(is_closed(*indexed.mesh()));
    // Sides of 2 sqrt 2: no point is farther from the corners than the middle is.
    EXPECT_GE(report.deviation() / size, std::sqrt(6) / 3);
    EXPECT_NEAR(report.deviation() / size, std::sqrt(8.0 / 3), 1e-12);
  }
}

TEST(Holes, ends_when_asked_to) {
  TriangleSoup soup = cube_soup(0, 1);
  soup.triangles.pop_back();
  IndexedSoup indexed = indexed_soup(soup);
  RepairReport report;
  const std::atomic<bool> cancel = true;
  const auto status = close_holes(indexed, {kAnyHole}, report, &cancel);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::soups
