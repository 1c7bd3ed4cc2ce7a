#include "algebra3d/kernel/repair/detail/duplicate_triangles.h"

#include <cmath>
#include <map>
#include <set>

#include "algebra3d/kernel/repair/detail/degenerate_triangles.h"
#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

using Corners = TriangleMesh::Triangle;

Corners sorted_corners(Corners corners) {
  std::ranges::sort(corners);
  return corners;
}

/// Triangles that hang together across edges, by flooding.
std::vector<std::size_t> parts_of(const std::vector<Corners>& triangles) {
  std::vector<std::size_t> part(triangles.size());
  for (std::size_t i = 0; i < part.size(); ++i) part[i] = i;
  const auto share_an_edge = [&](const Corners& a, const Corners& b) {
    return std::ranges::count_if(a, [&](std::uint32_t corner) { return std::ranges::find(b, corner) != b.end(); }) > 1;
  };
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t i = 0; i < part.size(); ++i)
      for (std::size_t k = 0; k < part.size(); ++k)
        if (part[k] < part[i] && share_an_edge(triangles[i], triangles[k])) {
          part[i] = part[k];
          has_changed = true;
        }
  }
  return part;
}

/// As many of the first as even permutations of its corners less odd ones say.
int balance_of(const std::vector<Corners>& triangles, const Corners& key) {
  int balance = 0;
  for (const Corners& t : triangles) {
    if (sorted_corners(t) != key) continue;
    const bool is_turned = t != key && t != Corners{key[1], key[2], key[0]} && t != Corners{key[2], key[0], key[1]};
    balance += is_turned ? -1 : 1;
  }
  return balance;
}

/// Of triangles that are there as often one way as the other: how much of the edges of their patch others need them at,
/// less how much others do not. A patch hangs together across edges that nothing else has.
double need_of(const IndexedSoup& indexed, const std::vector<Corners>& triangles, const Corners& start) {
  std::set<Corners> opposed, single;
  for (const Corners& t : triangles)
    (balance_of(triangles, sorted_corners(t)) == 0 ? opposed : single).insert(sorted_corners(t));
  const auto has = [](const Corners& t, std::uint32_t a, std::uint32_t b) {
    return std::ranges::find(t, a) != t.end() && std::ranges::find(t, b) != t.end();
  };
  std::vector<Corners> patch{start};
  double need = 0;
  for (std::size_t i = 0; i < patch.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = patch[i][k], b = patch[i][(k + 1) % 3];
      const auto meets = [&](const Corners& t) { return has(t, a, b); };
      const auto others = std::ranges::count_if(single, meets), all = std::ranges::count_if(opposed, meets);
      if (others == 0 && all == 2)
        for (const Corners& t : opposed)
          if (meets(t) && std::ranges::find(patch, t) == patch.end()) patch.push_back(t);
      if (others > 0 && all == 1) need += (others % 2 == 1 ? 1 : -1) * length(indexed.points[a] - indexed.points[b]);
    }
  return need;
}

TEST(DuplicateTriangles, one_is_kept_or_none_as_brute_force_says) {
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    IndexedSoup indexed = random_triangles_on_grid(chance, chance.between(2, 14), 3);
    RepairReport dropped, report;
    drop_degenerate_triangles(indexed, dropped);
    for (int n = chance.below(16); n > 0 && !indexed.triangles.empty(); --n) {
      Corners copy = indexed.triangles.values()[index_below(chance, indexed.triangles.size())];
      if (chance.one_in(2)) std::swap(copy[0], copy[2]);
      std::rotate(copy.begin(), copy.begin() + chance.below(3), copy.end());
      indexed.triangles.values().insert(
          indexed.triangles.values().begin() + chance.below(static_cast<int>(indexed.triangles.size())), copy);
    }
    const std::vector<Corners> given = indexed.triangles.values();
    const std::vector<std::size_t> part = parts_of(given);
    std::map<Corners, std::size_t> counts;
    for (const Corners& t : given) ++counts[sorted_corners(t)];
    // Parts of which something is not there as often one way as the other.
    std::set<std::size_t> unbalanced_parts;
    for (std::size_t i = 0; i < given.size(); ++i)
      if (balance_of(given, sorted_corners(given[i])) != 0) unbalanced_parts.insert(part[i]);
    drop_duplicate_triangles(indexed, report);

    EXPECT_EQ(count_of(report, RepairStep::duplicate_triangles), given.size() - indexed.triangles.size());
    EXPECT_EQ(report.deviation(), 0);
    std::map<Corners, std::size_t> left;
    for (const Corners& t : indexed.triangles) ++left[sorted_corners(t)];
    for (std::size_t i = 0; i < given.size(); ++i) {
      const Corners key = sorted_corners(given[i]);
      const int balance = balance_of(given, key);
      const double need = balance == 0 ? need_of(indexed, given, key) : 1;
      // Rounding decides between equal lengths.
      if (unbalanced_parts.contains(part[i]) && std::abs(need) < 1e-9) continue;
      const std::size_t expected = need < 0 && unbalanced_parts.contains(part[i]) ? 0 : 1;
      EXPECT_EQ(left[key], expected);
      // It looks the way most do.
      if (balance != 0 && left[key] == 1) {
        EXPECT_GT(balance * balance_of(indexed.triangles.values(), key), 0);
      }
    }
    // What is left is in the order given.
    auto place = given.begin();
    for (const Corners& t : indexed.triangles) {
      place = std::find(place, given.end(), t);
      ASSERT_NE(place, given.end());
      ++place;
    }
  }
}

TEST(DuplicateTriangles, of_a_thousand_one_is_kept) {
  TriangleSoup soup;
  for (int i = 0; i < 1001; ++i) {
    const SoupTriangle t{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
    soup.triangles.push_back(i < 501 ? turned(t) : t);
  }
  IndexedSoup indexed = indexed_soup(soup);
  RepairReport report;
  drop_duplicate_triangles(indexed, report);
  EXPECT_EQ(in_order(soup_of(indexed)), (std::vector<SoupTriangle>{{Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 0, 0}}}));
  EXPECT_EQ(count_of(report, RepairStep::duplicate_triangles), 1000U);
}

TEST(DuplicateTriangles, of_boxes_side_by_side_the_wall_between_them_goes) {
  IndexedSoup indexed = indexed_soup(joined(cube_soup(0, 2), shifted(cube_soup(0, 2), {2, 0, 0})));
  RepairReport report;
  drop_duplicate_triangles(indexed, report);
  EXPECT_EQ(indexed.triangles.size(), 20U);
  EXPECT_TRUE(is_closed(*indexed.mesh()));
  EXPECT_EQ(solids::exact_volume_of(*indexed.mesh()), Rational(16));
}

}  // namespace
}  // namespace algebra3d::soups
