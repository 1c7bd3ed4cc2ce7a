#include "algebra3d/kernel/repair/detail/repaired_solid.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "unit/repair/damage.h"
#include "unit/repair/repaired.h"

namespace algebra3d::soups {
namespace {

void expect_mended(Damage damage, std::initializer_list<RepairStep> steps) {
  for (int seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleMesh whole = body(seed % kBodyCount);
    TriangleSoup soup = soup_of(whole);
    damage(soup, chance);
    const SolidFromSoup made = repaired(soup);
    EXPECT_EQ(volume_of(made), solids::exact_volume_of(whole)) << made.status();
    EXPECT_EQ(deviation_of(made), 0) << made.status();
    if (!made.repair) {
      // Nothing was done to it.
      EXPECT_EQ(in_order(soup), in_order(soup_of(whole)));
      continue;
    }
    EXPECT_TRUE(std::ranges::any_of(steps, [&](RepairStep step) { return made.repair->find(step) != nullptr; }))
        << made.status();
    for (const RepairEntry& entry : made.repair->entries)
      EXPECT_TRUE(std::ranges::find(steps, entry.step) != steps.end()) << made.status();
  }
}

TEST(RepairedSolid, turns_triangles_back) {
  expect_mended(turn_some, {RepairStep::flipped_triangles, RepairStep::flipped_shells});
}

TEST(RepairedSolid, drops_repeated_triangles) {
  expect_mended(repeat_some, {RepairStep::duplicate_triangles});
}

TEST(RepairedSolid, drops_triangles_without_area) {
  expect_mended(add_degenerate_ones, {RepairStep::repeated_corners, RepairStep::collinear_corners});
}

TEST(RepairedSolid, divides_edges_at_vertices_on_them) {
  expect_mended(divide_some, {RepairStep::t_junctions});
}

TEST(RepairedSolid, mends_all_that_leaves_every_place_where_it_was) {
  constexpr std::array<Damage, 5> kDamages{turn_some, repeat_some, add_degenerate_ones, divide_some, shuffle_triangles};
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleMesh whole = body(chance.below(kBodyCount));
    TriangleSoup soup = soup_of(whole);
    turn_some(soup, chance);
    for (int n = chance.between(2, 5); n > 0; --n) kDamages[1 + index_below(chance, 4)](soup, chance);
    // Where a triangle is there both whole and in halves, their rims may be covered, within the surface; the distance
    // that is told does not know that.
    const SolidFromSoup made = repaired(soup);
    EXPECT_EQ(volume_of(made), solids::exact_volume_of(whole)) << made.status();
    const bool has_covers = made.repair && count_of(*made.repair, RepairStep::holes) > 0;
    EXPECT_TRUE(has_covers || deviation_of(made) == 0) << made.status();
  }
}

TEST(RepairedSolid, turns_whole_bodies_right_side_out) {
  for (int seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup;
    Rational volume(0);
    std::uint64_t turned_count = 0;
    for (int i = 0; i < 6; ++i) {
      const TriangleMesh mesh = solids::shifted(body(chance.below(5)), {20.0 * i, 0, 0});
      volume = volume + solids::exact_volume_of(mesh);
      const bool is_turned = chance.one_in(3);
      turned_count += is_turned ? 1 : 0;
      soup = joined(soup, is_turned ? turned(soup_of(mesh)) : soup_of(mesh));
    }
    shuffle(soup, chance);
    const SolidFromSoup made = repaired(soup);
    EXPECT_EQ(volume_of(made), volume);
    EXPECT_EQ(deviation_of(made), 0);
    if (turned_count == 0 || turned_count == 6) continue;
    // Turned, or turned with all and back: shells count one by one either way.
    EXPECT_EQ(made.repair->entries.size(), 1U) << made.status();
    EXPECT_NE(made.repair->find(RepairStep::flipped_shells), nullptr) << made.status();
  }
}

// A prism over a line that crosses itself: the winding numbers of its halves are 1 and -1, so the walls of one of them,
// which end in walls of the other, are turned.
TEST(RepairedSolid, of_a_wall_that_crosses_itself_half_is_turned) {
  const std::array<Vec3, 4> line{Vec3{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}};
  const Vec3 up{0, 0, 1}, crossing{2, 2, 0};
  TriangleSoup soup;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &a = line[i], &b = line[(i + 1) % 4];
    soup.triangles.push_back({a, b, b + up});
    soup.triangles.push_back({a, b + up, a + up});
  }
  for (const auto& [a, b] : {std::pair{line[2], line[1]}, {line[0], line[3]}}) {
    soup.triangles.push_back({a, b, crossing});
    soup.triangles.push_back({b + up, a + up, crossing + up});
  }
  // Of the file and of its reverse together each triangle is turned once: 12, of which four edges are split.
  std::uint64_t flipped = 0;
  for (const TriangleSoup& given : {soup, turned(soup)}) {
    const SolidFromSoup made = repaired(given);
    EXPECT_EQ(volume_of(made), Rational(8)) << made.status();
    EXPECT_GT(count_of(*made.repair, RepairStep::flipped_triangles), 0U) << made.status();
    flipped += count_of(*made.repair, RepairStep::flipped_triangles);
  }
  EXPECT_EQ(flipped, 16U);
}

TEST(RepairedSolid, shells_that_are_there_several_times_count_once) {
  for (int kind = 0; kind < kBodyCount; ++kind) {
    SCOPED_TRACE("body " + std::to_string(kind));
    const TriangleSoup soup = soup_of(body(kind));
    const Rational volume = solids::exact_volume_of(body(kind));
    expect_exactly(joined(soup, soup), volume);
    expect_exactly(joined(joined(soup, soup), soup), volume);
    expect_exactly(joined(joined(soup, soup), turned(soup)), volume);
    expect_exactly(joined(soup, turned(joined(soup, soup))), volume);
    const SolidFromSoup made = repaired(joined(soup, soup));
    EXPECT_EQ(count_of(*made.repair, RepairStep::duplicate_triangles), soup.triangles.size());
  }
}

TEST(RepairedSolid, a_body_and_its_inside_out_double_are_the_body) {
  for (const int kind : {0, 1, 2, 3, 4, 7}) {
    SCOPED_TRACE("body " + std::to_string(kind));
    const TriangleSoup soup = soup_of(body(kind));
    expect_exactly(joined(soup, turned(soup)), solids::exact_volume_of(body(kind)));
  }
}

TEST(RepairedSolid, bodies_within_bodies_bound_nothing) {
  const SolidFromSoup made = repaired(joined(cube_soup(0, 6), cube_soup(2, 4)));
  EXPECT_EQ(volume_of(made), Rational(216));
  EXPECT_EQ(count_of(*made.repair, RepairStep::inner_shells), 1U);
  EXPECT_EQ(deviation_of(made), 0);
  EXPECT_EQ(value_of(*made.repair->volume_before), 224.0);
  EXPECT_EQ(value_of(*made.repair->volume_after), 216.0);
}

// The expected volume is counted cell by cell.
TEST(RepairedSolid, of_overlapping_boxes_is_what_they_cover_together) {
  constexpr int kSize = 6;
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    std::vector<GridBox> boxes;
    TriangleSoup soup;
    for (int n = chance.between(2, 5); n > 0; --n) {
      boxes.push_back(random_grid_box(chance, kSize));
      soup = joined(soup, boxes.back().soup());
    }
    shuffle(soup, chance);
    const SolidFromSoup made = repaired(soup);
    EXPECT_EQ(volume_of(made), Rational(covered_cells(boxes, kSize))) << made.status();
    EXPECT_EQ(deviation_of(made), 0) << made.status();
  }
}

// Of the sides that boxes have in common one was kept, so that all of them were open, and some were lost.
TEST(RepairedSolid, of_boxes_with_common_sides_none_is_lost) {
  const std::vector<std::vector<GridBox>> cases{
      {{{2, 0, 2}, {3, 3, 3}}, {{2, 1, 2}, {3, 3, 3}}, {{2, 2, 2}, {3, 3, 3}}},
      {{{1, 1, 1}, {2, 2, 2}}, {{1, 1, 0}, {2, 2, 1}}, {{1, 1, 1}, {2, 2, 2}}, {{0, 1, 1}, {2, 2, 2}}},
      {{{0, 1, 1}, {1, 2, 2}}, {{1, 1, 1}, {2, 2, 2}}, {{1, 1, 1}, {2, 2, 2}}, {{1, 1, 0}, {2, 2, 2}}}};
  for (const std::vector<GridBox>& boxes : cases) {
    TriangleSoup soup;
    for (const GridBox& box : boxes) soup = joined(std::move(soup), box.soup());
    expect_exactly(soup, Rational(covered_cells(boxes, 3)));
  }
}

/// Boxes that cross each other, none of whose sides lies in the plane of another's.
std::vector<GridBox> boxes_in_general_position(Chance& chance, int count, int size) {
  std::array<std::set<int>, 3> used;
  std::vector<GridBox> boxes;
  while (boxes.size() < static_cast<std::size_t>(count)) {
    const GridBox box = random_grid_box(chance, size);
    bool is_new = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      is_new = is_new && !used[axis].contains(box.low[axis]) && !used[axis].contains(box.high[axis]);
    if (!is_new) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) used[axis].insert({box.low[axis], box.high[axis]});
    boxes.push_back(box);
  }
  return boxes;
}

TEST(RepairedSolid, of_overlapping_boxes_with_some_triangles_turned_is_what_they_cover_together) {
  constexpr int kSize = 12;
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const auto boxes = boxes_in_general_position(chance, chance.between(2, 4), kSize);
    TriangleSoup soup;
    for (const GridBox& box : boxes) soup = joined(soup, box.soup());
    turn_some(soup, chance);
    repeat_some(soup, chance);
    expect_exactly(soup, Rational(covered_cells(boxes, kSize)));
  }
}

/// Two triangles that are the rectangle of a box at a height.

TEST(RepairedSolid, walls_within_bodies_bound_nothing) {
  const TriangleSoup box = box_soup({0, 0, 0}, {4, 2, 3});
  const TriangleSoup spanning = wall_at(1, 0, 0, 4, 2), floating = wall_at(2, 1, 0.5, 3, 1.5);
  const TriangleSoup sticking_out = wall_at(1.5, 1, 0.5, 9, 1.5);
  for (const TriangleSoup& wall : {spanning, floating, sticking_out}) {
    expect_exactly(joined(box, wall), Rational(24));
    expect_exactly(joined(box, turned(wall)), Rational(24));
    expect_exactly(joined(box, joined(wall, wall)), Rational(24));
    expect_exactly(joined(box, joined(wall, turned(wall))), Rational(24));
  }
  expect_exactly(joined(joined(box, spanning), joined(floating, sticking_out)), Rational(24));
}

TEST(RepairedSolid, walls_between_rooms_that_share_edges_bound_nothing) {
  // A box in two storeys: all triangles of the shell have their edges on the ceiling between them.
  const TriangleSoup below = box_soup({0, 0, 0}, {4, 2, 1}), above = box_soup({0, 0, 1}, {4, 2, 3});
  const auto is_between = [](const SoupTriangle& t) { return t[0].z == 1 && t[1].z == 1 && t[2].z == 1; };
  TriangleSoup without = joined(below, above), single;
  std::erase_if(without.triangles, is_between);
  single = below;
  std::erase_if(single.triangles, [&](const SoupTriangle& t) { return !is_between(t); });
  ASSERT_EQ(single.triangles.size(), 2U);
  expect_exactly(joined(without, single), Rational(24));
  expect_exactly(joined(without, turned(single)), Rational(24));
  expect_exactly(joined(without, joined(single, single)), Rational(24));
  expect_exactly(joined(below, above), Rational(24));
  for (int seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = joined(without, single);
    for (SoupTriangle& t : soup.triangles)
      if (chance.one_in(5)) t = turned(t);
    shuffle(soup, chance);
    expect_exactly(soup, Rational(24));
  }
}

TEST(RepairedSolid, single_triangles_that_are_missing_are_put_back) {
  for (int seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleMesh whole = body(seed % kBodyCount);
    TriangleSoup soup = soup_of(whole);
    const std::size_t gone = index_below(chance, soup.triangles.size());
    const auto [a, b, c] = soup.triangles[gone];
    soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(gone));
    const SolidFromSoup made = repaired(soup);
    EXPECT_EQ(in_order(soup_of(*made.mesh)), in_order(soup_of(whole)));
    EXPECT_EQ(count_of(*made.repair, RepairStep::holes), 1U);
    EXPECT_EQ(made.repair->entries.size(), 1U) << made.status();
    // The middle of the circle within the triangle is this far from its sides.
    const double from_loop = 2 * area_of(SoupTriangle{a, b, c}) / (length(b - a) + length(c - b) + length(a - c));
    EXPECT_GE(made.repair->deviation(), from_loop * (1 - 1e-12));
    EXPECT_LE(made.repair->deviation(), std::max({length(b - a), length(c - b), length(a - c)}));
    EXPECT_FALSE(made.repair->volume_before);
    EXPECT_EQ(value_of(*made.repair->volume_after), solids::exact_volume_of(whole).nearest_double());
  }
}

/// Removes a triangle and those round one of its corners; gives a volume that holds all places that may change by it:
/// what covers the hole stays in the hull of the corners of these triangles.
double remove_patch(TriangleSoup& soup, Chance& chance) {
  const Vec3 hub = soup.triangles[index_below(chance, soup.triangles.size())][0];
  Box3 box;
  std::erase_if(soup.triangles, [&](const SoupTriangle& t) {
    if (std::ranges::find(t, hub) == t.end()) return false;
    for (const Vec3& corner : t) box.extend(corner);
    return true;
  });
  const Vec3 extent = box.max - box.min;
  return extent.x * extent.y * extent.z;
}

TEST(RepairedSolid, holes_are_closed_within_their_hull) {
  for (int seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleMesh whole = body(seed % 3 + 1);
    TriangleSoup soup = soup_of(whole);
    double bound = remove_patch(soup, chance);
    if (seed % 2 == 0) bound += remove_patch(soup, chance);
    turn_some(soup, chance);
    const SolidFromSoup made = repaired(soup);
    EXPECT_NE(made.repair->find(RepairStep::holes), nullptr);
    EXPECT_GT(made.repair->deviation(), 0);
    EXPECT_NEAR(volume_of(made).nearest_double(), solids::exact_volume_of(whole).nearest_double(), bound);
  }
}

/// The surface sweeps over no more than this if its points move by no more than `distance`, itself one of triangles
/// whose area hardly grows by it.
double swept(const TriangleSoup& soup, double distance) {
  return 1.2 * area_of(soup) * distance;
}

TEST(RepairedSolid, gaps_below_the_tolerance_are_closed) {
  for (int seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleMesh whole = body(seed % kBodyCount);
    TriangleSoup soup = soup_of(whole);
    const double size = 2e-5 * diagonal_of(soup);
    open_gaps(soup, chance, size);
    if (seed % 3 == 0) turn_some(soup, chance);
    const SolidFromSoup made = repaired(soup);
    EXPECT_NE(made.repair->find(RepairStep::gaps), nullptr);
    EXPECT_EQ(made.repair->find(RepairStep::holes), nullptr) << made.status();
    const double deviation = made.repair->deviation();
    // No two corners that were one are farther apart.
    EXPECT_LE(deviation, 2 * std::sqrt(3) * size);
    EXPECT_GT(deviation, 0);
    EXPECT_EQ(made.mesh->face_count(), soup.triangles.size());
    EXPECT_NEAR(volume_of(made).nearest_double(), solids::exact_volume_of(whole).nearest_double(),
                swept(soup, deviation + std::sqrt(3) * size));
  }
}

TEST(RepairedSolid, mends_everything_at_once) {
  constexpr std::array<Damage, 5> kDamages{turn_some, repeat_some, add_degenerate_ones, divide_some, shuffle_triangles};
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleMesh whole = body(chance.between(1, 3));
    TriangleSoup soup = soup_of(whole);
    double bound = 0;
    for (int n = chance.below(3); n > 0; --n) bound += remove_patch(soup, chance);
    turn_some(soup, chance);
    for (int n = chance.between(1, 4); n > 0; --n) kDamages[1 + index_below(chance, 4)](soup, chance);
    double moved = 0;
    if (chance.one_in(2)) {
      moved = 1e-5 * diagonal_of(soup);
      open_gaps(soup, chance, moved);
    }
    if (chance.one_in(2)) soup = turned(soup);
    const SolidFromSoup made = repaired(soup);
    const double distance = 2 * std::sqrt(3) * moved + 1e-4 * diagonal_of(soup) * (moved > 0 ? 1 : 0);
    EXPECT_NEAR(volume_of(made).nearest_double(), solids::exact_volume_of(whole).nearest_double(),
                bound + swept(soup, distance))
        << made.status();
  }
}

TEST(RepairedSolid, the_same_soup_gives_the_same_mesh) {
  for (int seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = joined(soup_of(body(seed % kBodyCount)), box_soup({0.5, 0.5, 0.5}, {2.5, 2.5, 9}));
    remove_patch(soup, chance);
    turn_some(soup, chance);
    divide_some(soup, chance);
    const auto first = solid_from_soup(soup), second = solid_from_soup(soup);
    ASSERT_EQ(first->mesh.has_value(), second->mesh.has_value());
    EXPECT_EQ(first->status(), second->status());
    if (first->mesh) {
      EXPECT_EQ(soup_of(*first->mesh).triangles, soup_of(*second->mesh).triangles);
    }
  }
}

TEST(RepairedSolid, what_was_repaired_needs_no_repair) {
  for (int seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = soup_of(body(seed % kBodyCount));
    turn_some(soup, chance);
    repeat_some(soup, chance);
    const SolidFromSoup once = repaired(soup);
    const SolidFromSoup twice = repaired(soup_of(*once.mesh));
    EXPECT_EQ(twice.status(), "ok");
    EXPECT_EQ(in_order(soup_of(*twice.mesh)), in_order(soup_of(*once.mesh)));
  }
}

TEST(RepairedSolid, ends_when_asked_to_at_any_time) {
  TriangleSoup soup = joined(soup_of(on_grid(samples::torus(14, 8))), cube_soup(1, 4));
  soup.triangles.pop_back();
  const auto mesh = std::make_shared<const TriangleMesh>(mesh_of(soup));
  const KnownTriangles given(mesh, {}, solids::exact_volume_of(*mesh));
  const ValidityReport found = *prove_volume(*mesh);
  const std::atomic<bool> at_once = true;
  const auto none = repaired_solid(given, found, {}, &at_once);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::interrupted);
  // When the work has told for the n-th time how far it is.
  std::size_t told = 0;
  for (std::size_t n = 1;; n = 2 * n) {
    std::atomic<bool> cancel = false;
    told = 0;
    const Monitor::Report report = [&](const std::string&) { cancel = ++told >= n; };
    const auto made = repaired_solid(given, found, {}, {&cancel, &report});
    if (made.ok()) break;
    EXPECT_EQ(made.error().code, ErrorCode::interrupted);
  }
  EXPECT_GT(told, 0U);
}

TEST(RepairedSolid, beyond_the_work_limit_there_is_a_reason) {
  TriangleSoup soup = joined(soup_of(on_grid(samples::torus(14, 8))), cube_soup(1, 4));
  for (const bool is_open : {false, true}) {
    if (is_open) soup.triangles.push_back({Vec3{2, 2, 2}, Vec3{9, 9, 9}, Vec3{9, 2, 2}});
    for (const double limit : {0.0, 1e-6, 1e-5}) {
      const auto made = solid_from_soup(soup, with(&RepairOptions::work_limit, limit));
      ASSERT_TRUE(made.ok());
      EXPECT_FALSE(made->mesh);
      EXPECT_NE(made->reason, "");
      EXPECT_NE(made->status().find("not repaired: "), std::string::npos) << made->status();
    }
    // Limits beyond any count do not limit.
    for (const double limit : {1e6, 1e13, 1.5e13, 1e20, 1e300, std::numeric_limits<double>::max()})
      EXPECT_TRUE(solid_from_soup(soup, with(&RepairOptions::work_limit, limit))->mesh) << limit;
  }
}

TEST(RepairedSolid, strict_repairs_nothing) {
  const auto made = solid_from_soup(joined(cube_soup(0, 6), cube_soup(2, 4)), RepairOptions::strict());
  EXPECT_FALSE(made->mesh);
  EXPECT_FALSE(made->repair);
}

TEST(RepairedSolid, options_hold) {
  TriangleSoup soup = soup_of(body(6));
  soup.triangles.push_back(soup.triangles.front());
  EXPECT_EQ(volume_of(repaired(soup)), Rational(512 - 216 + 64 - 8));
  RepairOptions fills;
  fills.keeps_cavities = false;
  const SolidFromSoup filled = repaired(soup, fills);
  EXPECT_EQ(volume_of(filled), Rational(512));
  EXPECT_EQ(count_of(*filled.repair, RepairStep::cavities), 2U);
  EXPECT_EQ(volume_of(repaired(soup, with(&RepairOptions::smallest_shell, 10))), Rational(512 - 216 + 64));
  EXPECT_EQ(volume_of(repaired(soup, with(&RepairOptions::smallest_shell, 65))), Rational(512 - 216));
}

// Extremes.

}  // namespace
}  // namespace algebra3d::soups
