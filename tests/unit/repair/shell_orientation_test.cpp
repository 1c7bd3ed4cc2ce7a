#include "algebra3d/kernel/repair/detail/shell_orientation.h"

#include <atomic>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

/// A cube that may hold others, and which way it looks.
struct Skin {
  double low, high, x;
  bool looks_in;

  Rational volume() const { return Rational((high - low) * (high - low) * (high - low)); }
  TriangleSoup soup() const {
    const TriangleSoup cube = shifted(cube_soup(low, high), {x, 0, 0});
    return looks_in ? turned(cube) : cube;
  }
  bool holds(const Skin& other) const { return x == other.x && low < other.low && other.high < high; }
};

/// The rules of the header, for cubes of which no two have the same size.
std::vector<Skin> oriented_by_the_rules(std::vector<Skin> skins) {
  std::ranges::sort(skins, [](const Skin& a, const Skin& b) { return a.volume() > b.volume(); });
  const std::vector<Skin> given = skins;
  for (std::size_t i = 0; i < skins.size(); ++i) {
    int around = 0;
    bool goes_along = false;  // with the smallest that holds it
    for (std::size_t k = 0; k < i; ++k) {
      if (!skins[k].holds(skins[i])) continue;
      around += skins[k].looks_in ? -1 : 1;
      goes_along = skins[k].looks_in != given[k].looks_in && given[i].looks_in != given[k].looks_in;
    }
    if (goes_along)
      skins[i].looks_in = !given[i].looks_in;
    else if (around <= 0)
      skins[i].looks_in = false;
  }
  return skins;
}

TriangleSoup soup_of_all(const std::vector<Skin>& skins) {
  TriangleSoup soup;
  for (const Skin& skin : skins) soup = joined(std::move(soup), skin.soup());
  return soup;
}

TEST(ShellOrientation, follows_the_rules_for_nested_shells_in_any_order) {
  for (int seed = 1; seed <= 80; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    std::vector<Skin> skins;
    const int count = chance.between(1, 7);
    // Onions at two places; sizes differ by quarters.
    for (int i = 0; i < count; ++i)
      skins.push_back({i * 1.0, 20 - i - chance.below(2) * 0.25, chance.one_in(3) ? 40.0 : 0.0, chance.one_in(2)});
    TriangleSoup soup = soup_of_all(skins);
    shuffle(soup, chance);
    IndexedSoup indexed = indexed_soup(soup);
    const auto before = indexed.triangles.values();
    RepairReport report;
    ASSERT_TRUE(orient_shells(indexed, report).ok());
    const std::vector<Skin> expected = oriented_by_the_rules(skins);
    EXPECT_EQ(in_order(soup_of(indexed)), in_order(soup_of_all(expected)));
    std::uint64_t flipped_triangles = 0;
    for (std::size_t f = 0; f < before.size(); ++f)
      flipped_triangles += before[f] == indexed.triangles.values()[f] ? 0 : 1;
    EXPECT_EQ(12 * count_of(report, RepairStep::flipped_shells), flipped_triangles);
    EXPECT_EQ(report.deviation(), 0);
  }
}

// Hollows that cross each other, which together are one.
TEST(ShellOrientation, cavities_may_overlap) {
  const TriangleSoup block = cube_soup(0, 20);
  const TriangleSoup first = turned(box_soup({2, 8, 8}, {18, 12, 12})),
                     second = turned(box_soup({8, 2, 9}, {12, 17, 13}));
  const TriangleSoup third = turned(box_soup({9, 9, 3}, {11, 11, 10}));
  for (const TriangleSoup& soup :
       {joined(joined(block, first), second), joined(joined(joined(block, first), second), third)}) {
    IndexedSoup indexed = indexed_soup(soup);
    RepairReport report;
    ASSERT_TRUE(orient_shells(indexed, report).ok());
    EXPECT_EQ(in_order(soup_of(indexed)), in_order(soup));
    EXPECT_EQ(count_of(report, RepairStep::flipped_shells), 0U);
  }
  // A body that is inside out, in the hollow: nothing of it is in the material.
  const TriangleSoup inner = box_soup({4, 9, 9}, {6, 11, 11});
  IndexedSoup indexed = indexed_soup(joined(joined(block, first), turned(inner)));
  RepairReport report;
  ASSERT_TRUE(orient_shells(indexed, report).ok());
  EXPECT_EQ(in_order(soup_of(indexed)), in_order(joined(joined(block, first), inner)));
}

TEST(ShellOrientation, what_is_inside_out_is_so_with_its_cavities_and_what_is_in_them) {
  const TriangleSoup onion = joined(joined(cube_soup(0, 8), turned(cube_soup(1, 7))), cube_soup(2, 6));
  const TriangleSoup beside = shifted(cube_soup(0, 9), {20, 0, 0});
  for (const bool is_beside_a_larger_one : {false, true}) {
    const TriangleSoup right = is_beside_a_larger_one ? joined(onion, beside) : onion;
    IndexedSoup indexed = indexed_soup(is_beside_a_larger_one ? joined(turned(onion), beside) : turned(onion));
    RepairReport report;
    ASSERT_TRUE(orient_shells(indexed, report).ok());
    EXPECT_EQ(in_order(soup_of(indexed)), in_order(right));
    EXPECT_EQ(count_of(report, RepairStep::flipped_shells), 3U);
  }
}

TEST(ShellOrientation, a_cavity_that_looks_right_stays_when_its_body_is_turned) {
  IndexedSoup indexed = indexed_soup(joined(turned(cube_soup(0, 4)), turned(cube_soup(1, 3))));
  RepairReport report;
  ASSERT_TRUE(orient_shells(indexed, report).ok());
  EXPECT_EQ(in_order(soup_of(indexed)), in_order(joined(cube_soup(0, 4), turned(cube_soup(1, 3)))));
}

TEST(ShellOrientation, what_sticks_out_is_no_cavity_however_the_axes_lie) {
  const TriangleSoup cube = cube_soup(0, 4), bar = turned(box_soup({-1, 1, 1}, {2, 2, 2}));
  for (std::size_t turn = 0; turn < 3; ++turn) {
    TriangleSoup soup = joined(cube, bar);
    for (SoupTriangle& t : soup.triangles)
      for (Vec3& corner : t) corner = {corner[turn], corner[(turn + 1) % 3], corner[(turn + 2) % 3]};
    IndexedSoup indexed = indexed_soup(soup);
    RepairReport report;
    ASSERT_TRUE(orient_shells(indexed, report).ok());
    EXPECT_EQ(count_of(report, RepairStep::flipped_shells), 1U);
  }
}

TEST(ShellOrientation, solids_stay_as_they_are) {
  for (const TriangleMesh& mesh :
       {samples::torus(9, 7), samples::MeshMaker().box({0, 0, 0}, {6, 6, 6}).box({1, 1, 1}, {5, 5, 5}, true).mesh(),
        TriangleMesh()}) {
    IndexedSoup indexed = indexed_soup(soup_of(mesh));
    const auto before = indexed.triangles.values();
    RepairReport report;
    ASSERT_TRUE(orient_shells(indexed, report).ok());
    EXPECT_EQ(indexed.triangles.values(), before);
    EXPECT_TRUE(report.is_empty());
  }
}

TEST(ShellOrientation, what_is_not_quite_closed_is_turned_by_its_pyramids) {
  for (int seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup sphere = soup_of(solids::geodesic_sphere(3));
    sphere.triangles.erase(sphere.triangles.begin() + chance.below(72));
    const TriangleSoup cube = shifted(cube_soup(0, 9), {20, 0, 0});
    IndexedSoup indexed = indexed_soup(joined(cube, turned(sphere)));
    RepairReport report;
    ASSERT_TRUE(orient_shells(indexed, report).ok());
    EXPECT_EQ(in_order(soup_of(indexed)), in_order(joined(cube, sphere)));
    EXPECT_EQ(count_of(report, RepairStep::flipped_shells), 1U);
  }
}

// They were one shell once, whose volume was the difference of both.
TEST(ShellOrientation, bodies_that_touch_in_an_edge_are_shells_by_themselves) {
  const TriangleSoup first = box_soup({0, 0, 0}, {3, 3, 3}), second = box_soup({3, 3, 0}, {5, 5, 3});
  for (const bool is_first : {false, true}) {
    IndexedSoup indexed = indexed_soup(is_first ? joined(turned(first), second) : joined(first, turned(second)));
    ASSERT_EQ(indexed.mesh()->nonmanifold_edge_count(), 1U);
    RepairReport report;
    ASSERT_TRUE(orient_shells(indexed, report).ok());
    EXPECT_EQ(in_order(soup_of(indexed)), in_order(joined(first, second)));
  }
}

TEST(ShellOrientation, dangling_sheets_do_not_keep_a_body_from_being_turned) {
  // Two boxes as one, with a dangling sheet twice at the edge between their upper sides: that edge has four triangles.
  TriangleSoup soup = joined(cube_soup(0, 2), shifted(cube_soup(0, 2), {2, 0, 0}));
  std::erase_if(soup.triangles, [](const SoupTriangle& t) { return t[0].x == 2 && t[1].x == 2 && t[2].x == 2; });
  const SoupTriangle sheet{Vec3{2, 0, 2}, Vec3{2, 2, 2}, Vec3{2, 1, 4}};
  soup.triangles.push_back(sheet);
  soup.triangles.push_back({sheet[0], sheet[2], sheet[1]});
  IndexedSoup indexed = indexed_soup(turned(soup));
  RepairReport report;
  ASSERT_TRUE(orient_shells(indexed, report).ok());
  EXPECT_EQ(solids::exact_volume_of(*indexed.mesh()), Rational(16));
  EXPECT_TRUE(is_consistently_oriented(*indexed.mesh()));
}

// Each of two cups has its rim at the edges of four triangles, where the ceiling between them is there twice.
TEST(ShellOrientation, parts_that_are_balanced_only_together_are_turned_together) {
  const TriangleSoup all = joined(cube_soup(0, 2), shifted(cube_soup(0, 2), {0, 0, 2}));
  IndexedSoup indexed = indexed_soup(turned(all));
  RepairReport report;
  ASSERT_TRUE(orient_shells(indexed, report).ok());
  EXPECT_EQ(in_order(soup_of(indexed)), in_order(all));
  EXPECT_NE(report.find(RepairStep::flipped_shells), nullptr);
}

TEST(ShellOrientation, huge_and_tiny_shells_are_turned_too) {
  for (const double size : {1e-300, 1e-100, 1e100, 1e300}) {
    SCOPED_TRACE(size);
    const TriangleSoup large = scaled(cube_soup(0, 3), size), small = scaled(shifted(cube_soup(0, 2), {5, 5, 5}), size);
    IndexedSoup indexed = indexed_soup(joined(large, turned(small)));
    RepairReport report;
    ASSERT_TRUE(orient_shells(indexed, report).ok());
    EXPECT_EQ(in_order(soup_of(indexed)), in_order(joined(large, small)));
  }
}

TEST(ShellOrientation, ends_when_asked_to) {
  IndexedSoup indexed = indexed_soup(cube_soup(0, 1));
  RepairReport report;
  const std::atomic<bool> cancel = true;
  const Status status = orient_shells(indexed, report, &cancel);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::soups
