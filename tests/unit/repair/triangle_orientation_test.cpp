#include "algebra3d/kernel/repair/detail/triangle_orientation.h"

#include <map>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

/// Per edge: how many triangles run along it from the smaller to the larger end, less those that run back.
std::map<std::pair<Vec3, Vec3>, int> edge_balances(const TriangleSoup& soup) {
  std::map<std::pair<Vec3, Vec3>, int> balances;
  for (const SoupTriangle& t : soup.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &from = t[i], &to = t[(i + 1) % 3];
      balances[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  return balances;
}

TriangleSoup oriented(const TriangleSoup& soup, RepairReport& report) {
  IndexedSoup indexed = indexed_soup(soup);
  orient_triangles(indexed, report);
  return soup_of(indexed);
}

TEST(TriangleOrientation, the_side_with_more_area_stays) {
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleSoup whole = soup_of(seed % 2 == 0 ? samples::torus(9, 7) : solids::sphere(5, 8, 2));
    TriangleSoup soup = whole;
    double turned_area = 0;
    std::uint64_t turned_count = 0;
    const int share = chance.between(2, 6);
    for (SoupTriangle& t : soup.triangles) {
      if (!chance.one_in(share) && seed % 3 != 0) continue;
      if (seed % 3 == 0 && chance.one_in(share)) continue;
      t = turned(t);
      turned_area += area_of(t);
      ++turned_count;
    }
    // Where both sides are as large, either may stay.
    if (std::abs(turned_area / area_of(whole) - 0.5) < 0.01) continue;
    const bool most_are_turned = turned_area > area_of(whole) / 2;
    RepairReport report;
    const TriangleSoup result = oriented(soup, report);
    EXPECT_EQ(in_order(result), in_order(most_are_turned ? turned(whole) : whole));
    EXPECT_EQ(count_of(report, RepairStep::flipped_triangles),
              most_are_turned ? whole.triangles.size() - turned_count : turned_count);
    EXPECT_EQ(report.deviation(), 0);
    // The order of the triangles makes no difference.
    shuffle(soup, chance);
    EXPECT_EQ(in_order(oriented(soup, report)), in_order(result));
  }
}

TEST(TriangleOrientation, separate_bodies_are_oriented_each_for_itself) {
  const TriangleSoup sphere = soup_of(solids::geodesic_sphere(3)), far = shifted(sphere, {9, 0, 0});
  TriangleSoup damaged = sphere;
  damaged.triangles[7] = turned(damaged.triangles[7]);
  RepairReport report;
  const TriangleSoup result = oriented(joined(damaged, turned(far)), report);
  EXPECT_EQ(in_order(result), in_order(joined(sphere, turned(far))));
  EXPECT_EQ(count_of(report, RepairStep::flipped_triangles), 1U);
}

TEST(TriangleOrientation, what_agrees_stays_as_it_is) {
  const TriangleSoup body = joined(soup_of(samples::torus(8, 8)), wall_of_squares());
  for (const TriangleSoup& soup : {body, turned(body), TriangleSoup()}) {
    RepairReport report;
    EXPECT_EQ(oriented(soup, report).triangles, soup.triangles);
    EXPECT_TRUE(report.is_empty());
  }
}

TEST(TriangleOrientation, strips_are_oriented_as_far_as_their_twist_allows) {
  for (int half_turns = 0; half_turns < 6; ++half_turns) {
    SCOPED_TRACE(half_turns);
    Chance chance(static_cast<std::uint64_t>(half_turns));
    TriangleSoup soup = soup_of(samples::twisted_band(20, half_turns));
    for (SoupTriangle& t : soup.triangles)
      if (chance.one_in(3)) t = turned(t);
    RepairReport report;
    const TriangleSoup result = oriented(soup, report);
    std::size_t disagreeing_count = 0;
    for (const auto& [edge, balance] : edge_balances(result)) disagreeing_count += std::abs(balance) == 2 ? 1 : 0;
    // Round a strip of an odd number of half turns, one edge has to disagree at least.
    if (half_turns % 2 == 0) {
      EXPECT_EQ(disagreeing_count, 0U);
    } else {
      EXPECT_EQ(disagreeing_count % 2, 1U);
    }
  }
}

// Two cups on both sides of a wall: the edges of three triangles have a balance of 3 or 1, and 1 can be had.
TEST(TriangleOrientation, parts_are_turned_to_balance_edges_of_many_triangles) {
  const TriangleSoup below = box_soup({0, 0, 0}, {4, 2, 1}), above = box_soup({0, 0, 1}, {4, 2, 3});
  const auto is_between = [](const SoupTriangle& t) { return t[0].z == 1 && t[1].z == 1 && t[2].z == 1; };
  std::array<TriangleSoup, 3> parts{below, above, below};
  std::erase_if(parts[0].triangles, is_between);
  std::erase_if(parts[1].triangles, is_between);
  std::erase_if(parts[2].triangles, [&](const SoupTriangle& t) { return !is_between(t); });
  for (int pattern = 0; pattern < 8; ++pattern) {
    SCOPED_TRACE(pattern);
    TriangleSoup soup;
    for (int i = 0; i < 3; ++i) {
      const TriangleSoup& part = parts[static_cast<std::size_t>(i)];
      soup = joined(soup, (pattern >> i & 1) != 0 ? turned(part) : part);
    }
    RepairReport report;
    for (const auto& [edge, balance] : edge_balances(oriented(soup, report))) {
      const bool is_at_wall = edge.first.z == 1 && edge.second.z == 1;
      const bool is_in_wall = edge.first.x != edge.second.x && edge.first.y != edge.second.y;
      EXPECT_EQ(std::abs(balance), is_at_wall && !is_in_wall ? 1 : 0);
    }
  }
}

TEST(TriangleOrientation, a_fan_of_pages_is_balanced) {
  TriangleSoup soup;
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.06 * i;
    soup.triangles.push_back({Vec3{0, 0, 0}, Vec3{0, 0, 1}, Vec3{std::cos(angle), std::sin(angle), 0}});
  }
  RepairReport report;
  const TriangleSoup result = oriented(soup, report);
  EXPECT_EQ(edge_balances(result)[std::minmax(Vec3{0, 0, 0}, Vec3{0, 0, 1})], 0);
  EXPECT_EQ(count_of(report, RepairStep::flipped_triangles), 50U);
}

}  // namespace
}  // namespace algebra3d::soups
