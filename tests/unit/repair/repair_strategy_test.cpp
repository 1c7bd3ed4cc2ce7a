#include "algebra3d/kernel/repair/detail/repair_strategy.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/kernel/repair/detail/repair_attempt.h"
#include "unit/repair/repaired.h"

namespace algebra3d::soups {
namespace {

std::vector<std::string> names_of(std::span<const RepairStrategy> strategies) {
  std::vector<std::string> names;
  for (const RepairStrategy& strategy : strategies) names.emplace_back(strategy.name);
  return names;
}

KnownTriangles triangles_of_soup(const TriangleSoup& soup) {
  auto mesh = std::make_shared<const TriangleMesh>(mesh_of(soup));
  Rational volume = solids::exact_volume_of(*mesh);
  return {std::move(mesh), FaceSet(), std::move(volume)};
}

/// The name of the strategy that made a solid of the soup.
std::string strategy_for(const TriangleSoup& soup) {
  const KnownTriangles known = triangles_of_soup(soup);
  const auto made = repaired_solid(known, *prove_volume(*known.mesh()), {});
  EXPECT_TRUE(made.ok() && made->mesh) << made->reason;
  return std::string(made->strategy);
}

TEST(RepairStrategies, are_searched_in_this_order) {
  EXPECT_EQ(names_of(search_strategies()),
            (std::vector<std::string>{"usual", "keep negative", "no stitching", "keep open patches",
                                      "balance all edges", "winding numbers alone", "bands"}));
}

TEST(RepairStrategies, that_are_cheaper_are_tried_in_this_order_if_it_is_worth_it) {
  const auto groups = cheaper_strategies();
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].condition, TryIf::costly);
  EXPECT_EQ(names_of(groups[0].strategies), std::vector<std::string>{"bands"});
  EXPECT_EQ(groups[1].condition, TryIf::leaves_out);
  EXPECT_EQ(names_of(groups[1].strategies),
            (std::vector<std::string>{"keep open patches", "shortcuts", "balance all edges"}));
}

TEST(RepairStrategies, of_one_name_are_the_same) {
  std::vector<RepairStrategy> all(search_strategies().begin(), search_strategies().end());
  for (const CheaperStrategies& group : cheaper_strategies())
    all.insert(all.end(), group.strategies.begin(), group.strategies.end());
  const auto flags = [](const RepairStrategy& s) {
    return std::vector<bool>{s.stitches_gaps,     s.drops_open_patches, s.closes_holes,  s.closes_bands,
                             s.covers_interfaces, s.takes_shortcuts,    s.keeps_negative};
  };
  for (const RepairStrategy& a : all)
    for (const RepairStrategy& b : all) EXPECT_EQ(a.name == b.name, flags(a) == flags(b)) << a.name << " " << b.name;
}

TEST(RepairStrategies, the_usual_one_is_taken_for_what_it_mends_completely) {
  TriangleSoup flipped = cube_soup(0, 2);
  flipped.triangles[4] = turned(flipped.triangles[4]);
  EXPECT_EQ(strategy_for(flipped), "usual");
  EXPECT_EQ(strategy_for(joined(cube_soup(0, 4), cube_soup(2, 6))), "usual");
}

// A lid that stands at a hundredth above an open box: both could be closed by themselves, but a band takes less.
TEST(RepairStrategies, bands_are_taken_where_they_add_less) {
  TriangleSoup soup;
  for (const SoupTriangle& t : box_soup({0, 0, 0}, {4, 4, 4}).triangles) {
    const bool is_top = t[0].z == 4 && t[1].z == 4 && t[2].z == 4;
    soup.triangles.push_back(t);
    if (is_top)
      for (Vec3& corner : soup.triangles.back()) corner.z = 4.04;
  }
  EXPECT_EQ(strategy_for(soup), "bands");
}

TEST(RepairStrategies, others_are_worth_trying_if_an_attempt_leaves_out_much) {
  const KnownTriangles clean = triangles_of_soup(joined(cube_soup(0, 4), cube_soup(2, 6)));
  RepairAttempt attempt(clean, search_strategies()[0], {}, {});
  ASSERT_TRUE(attempt.make(*prove_volume(*clean.mesh())).ok());
  ASSERT_TRUE(attempt.has_solid());
  ASSERT_TRUE(attempt.measure().ok());
  EXPECT_EQ(attempt.cost(), 0);
  EXPECT_FALSE(attempt.is_worth_trying(TryIf::costly));
  EXPECT_FALSE(attempt.is_worth_trying(TryIf::leaves_out));
  // The wall outside the cube is a hundredth of all area.
  const KnownTriangles walled = triangles_of_soup(joined(cube_soup(0, 4), wall_at(2, 4, 0, 5, 1)));
  RepairAttempt other(walled, search_strategies()[0], {}, {});
  ASSERT_TRUE(other.make(*prove_volume(*walled.mesh())).ok());
  ASSERT_TRUE(other.measure().ok());
  EXPECT_NEAR(other.cost(), 1.0 / 97, 1e-9);
  EXPECT_TRUE(other.is_worth_trying(TryIf::costly));
  EXPECT_TRUE(other.is_worth_trying(TryIf::leaves_out));
}

/// How often triangles were divided at one another for a repair.
std::size_t divisions_for(const TriangleSoup& soup) {
  const KnownTriangles known = triangles_of_soup(soup);
  const auto made = repaired_solid(known, *prove_volume(*known.mesh()), {});
  EXPECT_TRUE(made.ok());
  return made->division_count;
}

// Scattered triangles are the same for all strategies but the one that makes bands.
TEST(RepairStrategies, with_the_same_triangles_divide_them_once) {
  Chance chance(1);
  TriangleSoup scattered;
  for (int i = 0; i < 30; ++i)
    scattered.triangles.push_back({Vec3{chance.unit(), chance.unit(), chance.unit()},
                                   Vec3{chance.unit(), chance.unit(), chance.unit()},
                                   Vec3{chance.unit(), chance.unit(), chance.unit()}});
  EXPECT_LE(divisions_for(scattered), 2U);
  // The wall hangs on a cube that is closed without it. Three strategies that keep it are tried afterwards.
  EXPECT_EQ(divisions_for(joined(cube_soup(0, 4), wall_at(2, 4, 0, 5, 1))), 1U);
}

TEST(RepairStrategies, that_take_a_solid_over_report_the_same) {
  const KnownTriangles known = triangles_of_soup(joined(cube_soup(0, 4), wall_at(2, 3, 0, 5, 1)));
  const ValidityReport found = *prove_volume(*known.mesh());
  const auto attempt = [&](std::span<const RepairAttempt* const> earlier) {
    RepairAttempt made(known, search_strategies()[3], {}, {});
    EXPECT_TRUE(made.make(found, earlier).ok());
    return made;
  };
  const RepairAttempt first = attempt({});
  const std::array<const RepairAttempt*, 1> earlier{&first};
  RepairAttempt second = attempt(earlier);
  EXPECT_TRUE(first.has_divided());
  EXPECT_FALSE(second.has_divided());
  EXPECT_TRUE(second.costs_as_much_as(first));
  const auto one = RepairAttempt(first).finish(), other = std::move(second).finish();
  ASSERT_TRUE(one.ok() && other.ok());
  EXPECT_EQ(one->report.text(), other->report.text());
  EXPECT_EQ(soup_of(*one->mesh).triangles, soup_of(*other->mesh).triangles);
}

}  // namespace
}  // namespace algebra3d::soups
