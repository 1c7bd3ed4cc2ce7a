// Bands between boundaries that run close to each other: boxes with gaps, whose volumes are products.
#include "algebra3d/kernel/repair/detail/bands.h"

#include <limits>

#include "unit/repair/repaired.h"

namespace algebra3d::soups::bands_tests {
namespace {

constexpr double kAnyBand = std::numeric_limits<double>::infinity();

/// The box without its lower or upper lid, or both.
TriangleSoup open_box(const Vec3& low, const Vec3& high, bool lacks_bottom, bool lacks_top) {
  TriangleSoup soup = box_soup(low, high);
  std::erase_if(soup.triangles, [&](const SoupTriangle& t) {
    const bool is_flat = t[0].z == t[1].z && t[1].z == t[2].z;
    return is_flat && (t[0].z == low.z ? lacks_bottom : lacks_top);
  });
  return soup;
}

TEST(Bands, join_a_lid_above_a_box_with_it) {
  const TriangleSoup box = open_box({0, 0, 0}, {1, 1, 1}, false, true);
  for (const double gap : {1.0 / 1024, 1.0 / 16}) {
    const TriangleSoup lid = wall_at(1 + gap, 0, 0, 1, 1);
    for (const TriangleSoup& soup : {joined(box, lid), joined(box, turned(lid)), joined(turned(box), lid)}) {
      const SolidFromSoup made = repaired(soup);
      EXPECT_EQ(volume_of(made), Rational(1) + Rational(gap)) << made.status();
      EXPECT_EQ(value_of(made.repair->amounts->left_out.area), 0);
      EXPECT_NEAR(value_of(made.repair->amounts->added.area), 4 * gap, 1e-9);
      EXPECT_EQ(count_of(*made.repair, RepairStep::holes), 1U);
    }
  }
}

TEST(Bands, join_two_halves) {
  const TriangleSoup low = open_box({0, 0, 0}, {4, 4, 2}, false, true);
  const TriangleSoup high = open_box({0, 0, 2.25}, {4, 4, 5}, true, false);
  for (const TriangleSoup& soup : {joined(low, high), joined(low, turned(high))})
    EXPECT_EQ(volume_of(repaired(soup)), Rational(80));
}

TEST(Bands, close_both_ends_of_a_pipe) {
  const TriangleSoup outer = open_box({0, 0, 0}, {8, 8, 10}, true, true);
  const TriangleSoup inner = open_box({1, 1, 0}, {7, 7, 10}, true, true);
  for (const TriangleSoup& soup : {joined(outer, turned(inner)), joined(outer, inner)}) {
    const SolidFromSoup made = repaired(soup);
    EXPECT_EQ(volume_of(made), Rational(280)) << made.status();
    EXPECT_NEAR(value_of(made.repair->amounts->added.area), 56, 1e-9);
  }
}

TEST(Bands, are_not_folded_back_upon_a_ring) {
  const TriangleSoup ring = open_box({0, 0, 0}, {10, 10, 1}, true, true);
  IndexedSoup indexed = indexed_soup(ring);
  RepairReport report;
  const auto found = close_bands(indexed, kAnyBand, report);
  ASSERT_TRUE(found.ok());
  EXPECT_FALSE(*found);
  EXPECT_EQ(indexed.triangles.size(), ring.triangles.size());
  EXPECT_EQ(volume_of(repaired(ring)), Rational(100));
}

TEST(Bands, between_distant_or_large_rims_are_not_made) {
  const TriangleSoup box = open_box({0, 0, 0}, {1, 1, 1}, false, true);
  for (const auto& [height, largest] : {std::pair(1.75, kAnyBand), std::pair(1.0625, 1.0)}) {
    IndexedSoup indexed = indexed_soup(joined(box, wall_at(height, 0, 0, 1, 1)));
    RepairReport report;
    const auto found = close_bands(indexed, largest, report);
    ASSERT_TRUE(found.ok());
    EXPECT_FALSE(*found);
    EXPECT_TRUE(report.is_empty());
  }
}

}  // namespace
}  // namespace algebra3d::soups::bands_tests
