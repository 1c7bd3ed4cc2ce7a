#include "algebra3d/repair/repaired_solid.h"

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "algebra3d/repair/solid_from_soup.h"
#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

/// What is left of a soup, which has to be a solid.
SolidFromSoup repaired(const TriangleSoup& soup, const RepairOptions& options = {}) {
  Result<SolidFromSoup> made = solid_from_soup(soup, options);
  EXPECT_TRUE(made.ok());
  if (!made.ok()) return {};
  EXPECT_TRUE(made->mesh) << made->status();
  if (made->mesh) expect_valid_volume(*made->mesh);
  return std::move(made).value();
}

Rational volume_of(const SolidFromSoup& made) {
  return made.mesh ? solids::exact_volume_of(*made.mesh) : Rational(-1);
}
double deviation_of(const SolidFromSoup& made) {
  return made.repair ? made.repair->deviation() : 0;
}

template <typename T>
RepairOptions with(T RepairOptions::*option, double value) {
  RepairOptions options;
  options.*option = value;
  return options;
}

/// No solid can be made of these, and there is a reason.
void expect_no_solid(const TriangleSoup& soup) {
  const auto made = solid_from_soup(soup);
  ASSERT_TRUE(made.ok());
  EXPECT_FALSE(made->mesh) << made->status();
  EXPECT_NE(made->reason, "");
}
/// Whatever comes out, it is a solid, or there is a reason.
void expect_solid_or_reason(const TriangleSoup& soup) {
  const auto made = solid_from_soup(soup);
  ASSERT_TRUE(made.ok());
  if (made->mesh)
    expect_valid_volume(*made->mesh);
  else
    EXPECT_NE(made->reason, "");
}

TriangleMesh l_shaped() {
  // Seen whole from the corner of its notch.
  return solids::prism(std::vector<solids::Corner>{{2, 1}, {2, 2}, {0, 2}, {0, 0}, {4, 0}, {4, 1}}, 0, 3);
}

constexpr int kBodyCount = 8;
TriangleMesh body(int kind) {
  switch (kind) {
    case 0:
      return solids::box({0, 0, 0}, {4, 2, 3});
    case 1:
      return on_grid(samples::torus(14, 8));
    case 2:
      return on_grid(solids::sphere(6, 9, 2));
    case 3:
      return on_grid(solids::geodesic_sphere(4));
    case 4:
      return l_shaped();
    case 5:
      return samples::MeshMaker().box({0, 0, 0}, {8, 8, 8}).box({2, 2, 2}, {6, 6, 6}, true).mesh();
    case 6:
      return samples::MeshMaker()
          .box({0, 0, 0}, {8, 8, 8})
          .box({1, 1, 1}, {7, 7, 7}, true)
          .box({2, 2, 2}, {6, 6, 6})
          .box({3, 3, 3}, {5, 5, 5}, true)
          .mesh();
    default:
      return samples::MeshMaker()
          .box({0, 0, 0}, {3, 3, 3})
          .box({5, 0, 0}, {9, 3, 2})
          .tetrahedron({0, 10, 0}, {4, 10, 0}, {0, 14, 0}, {0, 10, 4})
          .mesh();
  }
}

// Ways to damage a soup that leave the places as they are which it means.

/// Turns facets over; of each connected part of the soup less than two fifths of the area.
void turn_some(TriangleSoup& soup, Chance& chance) {
  const TriangleMesh mesh = mesh_of(soup);
  const FaceComponents parts = connected_components(mesh);
  std::vector<double> area(parts.count), gone(parts.count);
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) area[parts.of_face[f]] += area_of(soup.triangles[f]);
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    double& turned_area = gone[parts.of_face[f]];
    if (!chance.one_in(4) || turned_area + area_of(soup.triangles[f]) > 0.4 * area[parts.of_face[f]]) continue;
    turned_area += area_of(soup.triangles[f]);
    soup.triangles[f] = turned(soup.triangles[f]);
  }
}

void repeat_some(TriangleSoup& soup, Chance& chance) {
  for (int n = chance.between(1, 5); n > 0; --n)
    soup.triangles.push_back(soup.triangles[index_below(chance, soup.triangles.size())]);
}

void add_degenerate_ones(TriangleSoup& soup, Chance& chance) {
  for (int n = chance.between(1, 5); n > 0; --n) {
    const auto [a, b, c] = soup.triangles[index_below(chance, soup.triangles.size())];
    switch (chance.below(3)) {
      case 0:
        soup.triangles.push_back({a, b, a});
        break;
      case 1:
        soup.triangles.push_back({c, c, c});
        break;
      default:
        soup.triangles.push_back({a, b, 0.5 * a + 0.5 * b});
        break;
    }
  }
}

/// Facets in halves, whose neighbours are whole.
void divide_some(TriangleSoup& soup, Chance& chance) {
  for (int n = chance.between(1, 6); n > 0; --n) {
    SoupTriangle& triangle = soup.triangles[index_below(chance, soup.triangles.size())];
    const auto [a, b, c] = triangle;
    const Vec3 middle = 0.5 * a + 0.5 * b;
    triangle = {a, middle, c};
    soup.triangles.push_back({middle, b, c});
  }
}

void shuffle_facets(TriangleSoup& soup, Chance& chance) {
  shuffle(soup, chance);
}

/// Corners of each facet apart from those of its neighbours, by no more than this in each coordinate.
void crack(TriangleSoup& soup, Chance& chance, double size) {
  for (SoupTriangle& t : soup.triangles)
    for (Vec3& corner : t) corner = corner + size * Vec3{chance.unit(), chance.unit(), chance.unit()};
}

using Damage = void (*)(TriangleSoup& soup, Chance& chance);

void expect_exactly(const TriangleSoup& soup, const Rational& volume) {
  const SolidFromSoup made = repaired(soup);
  EXPECT_EQ(volume_of(made), volume) << made.status();
  EXPECT_EQ(deviation_of(made), 0) << made.status();
}

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

TEST(RepairedSolid, turns_facets_back) {
  expect_mended(turn_some, {RepairStep::turned_facets});
}

TEST(RepairedSolid, drops_repeated_facets) {
  expect_mended(repeat_some, {RepairStep::duplicate_facets});
}

TEST(RepairedSolid, drops_facets_without_area) {
  expect_mended(add_degenerate_ones, {RepairStep::repeated_corners, RepairStep::collinear_corners});
}

TEST(RepairedSolid, divides_edges_at_vertices_on_them) {
  expect_mended(divide_some, {RepairStep::divided_edges});
}

TEST(RepairedSolid, mends_all_that_leaves_every_place_where_it_was) {
  constexpr std::array<Damage, 5> kDamages{turn_some, repeat_some, add_degenerate_ones, divide_some, shuffle_facets};
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleMesh whole = body(chance.below(kBodyCount));
    TriangleSoup soup = soup_of(whole);
    turn_some(soup, chance);
    for (int n = chance.between(2, 5); n > 0; --n) kDamages[1 + index_below(chance, 4)](soup, chance);
    expect_exactly(soup, solids::exact_volume_of(whole));
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
    EXPECT_NE(made.repair->find(RepairStep::turned_shells), nullptr) << made.status();
  }
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
    EXPECT_EQ(count_of(*made.repair, RepairStep::duplicate_facets), soup.triangles.size());
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
  EXPECT_EQ(made.repair->volume_before, 224.0);
  EXPECT_EQ(made.repair->volume_after, 216.0);
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

TEST(RepairedSolid, of_overlapping_boxes_with_some_facets_turned_is_what_they_cover_together) {
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
TriangleSoup wall_at(double z, double x0, double y0, double x1, double y1) {
  TriangleSoup soup;
  soup.triangles = {{Vec3{x0, y0, z}, Vec3{x1, y0, z}, Vec3{x1, y1, z}},
                    {Vec3{x0, y0, z}, Vec3{x1, y1, z}, Vec3{x0, y1, z}}};
  return soup;
}

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
  // A box in two storeys: all facets of the shell have their edges on the ceiling between them.
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

TEST(RepairedSolid, single_facets_that_are_missing_are_put_back) {
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
    EXPECT_EQ(made.repair->volume_before, std::nullopt);
    EXPECT_EQ(*made.repair->volume_after, solids::exact_volume_of(whole).nearest_double());
  }
}

/// Removes a facet and those round one of its corners; gives a volume that holds all places that may change by it:
/// what covers the hole stays in the hull of the corners of these facets.
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

/// The surface sweeps over no more than this if its points move by no more than `distance`, itself one of facets whose
/// area hardly grows by it.
double swept(const TriangleSoup& soup, double distance) {
  return 1.2 * area_of(soup) * distance;
}

TEST(RepairedSolid, cracks_below_the_tolerance_are_closed) {
  for (int seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleMesh whole = body(seed % kBodyCount);
    TriangleSoup soup = soup_of(whole);
    const double size = 2e-5 * diagonal_of(soup);
    crack(soup, chance, size);
    if (seed % 3 == 0) turn_some(soup, chance);
    const SolidFromSoup made = repaired(soup);
    EXPECT_NE(made.repair->find(RepairStep::cracks), nullptr);
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
  constexpr std::array<Damage, 5> kDamages{turn_some, repeat_some, add_degenerate_ones, divide_some, shuffle_facets};
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
      crack(soup, chance, moved);
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
  const WeldedTriangles welded = weld(soup.triangles);
  const std::atomic<bool> at_once = true;
  const auto none = repaired_solid(welded, {}, &at_once);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::interrupted);
  // When the work has told for the n-th time how far it is.
  std::size_t told = 0;
  for (std::size_t n = 1;; n = 2 * n) {
    std::atomic<bool> cancel = false;
    told = 0;
    const Monitor::Report report = [&](const std::string&) { cancel = ++told >= n; };
    const auto made = repaired_solid(welded, {}, {&cancel, &report});
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
    // Limits beyond any count are none.
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

TEST(RepairedSolid, of_too_few_facets_there_is_none) {
  TriangleSoup one;
  one.triangles = {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}};
  expect_no_solid(one);
  expect_no_solid(joined(one, one));
  expect_no_solid(joined(one, turned(one)));
  TriangleSoup many;
  for (int i = 0; i < 1000; ++i) many = joined(std::move(many), i % 3 == 0 ? turned(one) : one);
  expect_no_solid(many);
}

TEST(RepairedSolid, of_facets_without_area_is_the_empty_solid) {
  TriangleSoup soup;
  soup.triangles.assign(1000, {Vec3{1, 2, 3}, Vec3{1, 2, 3}, Vec3{1, 2, 3}});
  soup.triangles.push_back({Vec3{0, 0, 0}, Vec3{1, 1, 1}, Vec3{3, 3, 3}});
  const SolidFromSoup made = repaired(soup);
  EXPECT_TRUE(made.mesh->is_empty());
  EXPECT_EQ(count_of(*made.repair, RepairStep::repeated_corners), 1000U);
  EXPECT_EQ(count_of(*made.repair, RepairStep::collinear_corners), 1U);
}

TEST(RepairedSolid, of_flat_sheets_there_is_none) {
  expect_no_solid(wall_at(0, 0, 0, 1, 1));
  TriangleSoup sheet;
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y) sheet = joined(std::move(sheet), wall_at(0, x, y, x + 1, y + 1));
  expect_no_solid(sheet);
  const auto made = solid_from_soup(sheet);
  EXPECT_EQ(made->reason.find("1 hole was left open (near "), 0U) << made->reason;
}

TEST(RepairedSolid, strips_that_cannot_be_oriented_are_no_trouble) {
  for (const int half_turns : {1, 2, 3, 4, 5}) {
    SCOPED_TRACE(std::to_string(half_turns) + " half turns");
    expect_solid_or_reason(soup_of(samples::twisted_band(24, half_turns)));
  }
}

/// A tube of `rows` rings that comes back into itself from inside, with its direction reversed.
TriangleSoup klein_bottle(int rows, int columns) {
  const auto at = [&](int i, int j) {
    const double u = 2 * std::numbers::pi * i / rows, v = 2 * std::numbers::pi * j / columns;
    const double radius = 3 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
    return Vec3{radius * std::cos(u), radius * std::sin(u),
                std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v)};
  };
  TriangleSoup soup;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const auto next = [&](int k) { return i + 1 == rows ? at(0, (columns - k) % columns) : at(i + 1, k % columns); };
      const Vec3 a = at(i, j), b = next(j), c = next(j + 1), d = at(i, (j + 1) % columns);
      soup.triangles.push_back({a, b, c});
      soup.triangles.push_back({a, c, d});
    }
  }
  return soup;
}

TEST(RepairedSolid, a_klein_bottle_is_no_trouble) {
  expect_solid_or_reason(klein_bottle(12, 8));
}

TEST(RepairedSolid, an_open_cylinder_is_closed_at_both_ends) {
  const std::vector<solids::Corner> polygon{{4, 0}, {3, 2}, {1, 4}, {-2, 3}, {-4, 1}, {-3, -2}, {0, -4}, {2, -3}};
  const TriangleMesh whole = solids::prism(polygon, 0, 10);
  TriangleSoup soup = soup_of(whole);
  std::erase_if(soup.triangles, [](const SoupTriangle& t) { return t[0].z == t[1].z && t[1].z == t[2].z; });
  ASSERT_EQ(soup.triangles.size(), 16U);
  for (const TriangleSoup& open : {soup, turned(soup)}) {
    const SolidFromSoup made = repaired(open);
    EXPECT_EQ(volume_of(made), solids::exact_volume_of(whole));
    EXPECT_EQ(count_of(*made.repair, RepairStep::holes), 2U);
  }
  // A hole too large to be closed is named.
  const auto left_open = solid_from_soup(soup, with(&RepairOptions::largest_hole, 1));
  EXPECT_FALSE(left_open->mesh);
  EXPECT_EQ(left_open->reason.find("2 holes were left open (near "), 0U) << left_open->reason;
}

// Shells in one another, as onion skins, each looking in or out.
TEST(RepairedSolid, nested_shells_of_any_orientation_follow_the_rules_for_shells) {
  for (int pattern = 0; pattern < 32; ++pattern) {
    SCOPED_TRACE("pattern " + std::to_string(pattern));
    TriangleSoup soup;
    Rational total(0);
    const auto volume = [](int i) { return Rational((10 - 2 * i) * (10 - 2 * i) * (10 - 2 * i)); };
    const auto looks_in = [&](int i) { return (pattern >> i & 1) != 0; };
    for (int i = 0; i < 5; ++i) {
      const TriangleSoup skin = cube_soup(i, 10 - i);
      soup = joined(soup, looks_in(i) ? turned(skin) : skin);
      total = looks_in(i) ? total - volume(i) : total + volume(i);
    }
    // Facets that mean nothing, so that there is something to repair.
    soup.triangles.push_back({Vec3{}, Vec3{}, Vec3{}});
    // All are turned over if they are negative together; then, from outside in, cavities stay within bodies alone.
    Rational expected(0);
    int winding = 0;
    for (int i = 0; i < 5; ++i) {
      const bool is_cavity = looks_in(i) != (total.sign() < 0) && winding > 0;
      const int within = winding + (is_cavity ? -1 : 1);
      if (winding <= 0 && within > 0) expected = expected + volume(i);
      if (winding > 0 && within <= 0) expected = expected - volume(i);
      winding = within;
    }
    expect_exactly(soup, expected);
  }
}

// In each of its corners, whichever facet comes first.
TEST(RepairedSolid, cavities_that_touch_the_outer_shell_in_a_vertex_stay) {
  const TriangleSoup outer = cube_soup(0, 6);
  for (int where = 0; where < 8; ++where) {
    SCOPED_TRACE("corner " + std::to_string(where));
    const auto placed = [&](const Vec3& p) {
      return Vec3{(where & 1) != 0 ? 6 - p.x : p.x, (where & 2) != 0 ? 6 - p.y : p.y, (where & 4) != 0 ? 6 - p.z : p.z};
    };
    const TriangleMesh cavity =
        solids::tetrahedron(placed({0, 0, 0}), placed({2, 1, 1}), placed({1, 2, 1}), placed({1, 1, 2}));
    TriangleSoup soup = turned(soup_of(cavity));
    const Rational volume = Rational(216) - solids::exact_volume_of(cavity);
    for (int first = 0; first < 12; ++first) {
      if (first % 3 == 0) std::ranges::rotate(soup.triangles, soup.triangles.begin() + 1);
      for (SoupTriangle& t : soup.triangles) std::ranges::rotate(t, t.begin() + 1);
      TriangleSoup both = joined(soup, outer);
      EXPECT_TRUE(solid_from_soup(both, RepairOptions::strict())->mesh);
      both.triangles.push_back({Vec3{}, Vec3{}, Vec3{}});
      expect_exactly(both, volume);
    }
  }
}

TEST(RepairedSolid, huge_and_tiny_coordinates_are_no_trouble) {
  for (const double size : {1e-300, 1e-160, 1e-120, 1e-80, 1e80, 1e120, 1e160, 1e300, 8e307}) {
    SCOPED_TRACE(size);
    const TriangleSoup box = scaled(cube_soup(-1, 1), size);
    const Rational volume = Rational(8) * Rational(size) * Rational(size) * Rational(size);
    TriangleSoup repeated = box;
    repeated.triangles.push_back(box.triangles[3]);
    EXPECT_EQ(volume_of(repaired(repeated)), volume);
    TriangleSoup one_turned = box;
    one_turned.triangles[5] = turned(one_turned.triangles[5]);
    EXPECT_EQ(volume_of(repaired(one_turned)), volume);
    TriangleSoup open = box;
    open.triangles.pop_back();
    EXPECT_EQ(volume_of(repaired(open)), volume);
    EXPECT_EQ(volume_of(repaired(turned(open))), volume);
    TriangleSoup without_a_side = box;
    std::erase_if(without_a_side.triangles,
                  [&](const SoupTriangle& t) { return t[0].z == size && t[1].z == size && t[2].z == size; });
    ASSERT_EQ(without_a_side.triangles.size(), 10U);
    EXPECT_EQ(volume_of(repaired(without_a_side)), volume);
    // Boxes of which one passes through the other.
    const TriangleSoup beam = scaled(box_soup({-0.5, -0.5, -2}, {0.5, 0.5, 2}), size);
    EXPECT_EQ(volume_of(repaired(joined(box, beam))), Rational(10) * volume * Rational(1, 8));
    expect_solid_or_reason(joined(open, beam));
    expect_no_solid(scaled(wall_at(0, 0, 0, 1, 1), size));
  }
}

TEST(RepairedSolid, coordinates_of_all_sizes_at_once_are_no_trouble) {
  TriangleSoup soup = joined(scaled(cube_soup(-1, 1), 1e300), scaled(cube_soup(-1, 1), 1e-300));
  soup = joined(soup, cube_soup(-1, 1));
  EXPECT_EQ(volume_of(repaired(soup)), Rational(8) * Rational(1e300) * Rational(1e300) * Rational(1e300));
  soup.triangles.pop_back();
  expect_solid_or_reason(soup);
}

TEST(RepairedSolid, of_thousands_of_separate_triangles_there_is_none) {
  Chance chance(1);
  TriangleSoup soup;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 a{4.0 * (i % 15), 4.0 * (i / 15 % 15), 4.0 * (i / 225)};
    const auto corner = [&] { return a + Vec3{chance.unit(), chance.unit(), chance.unit()}; };
    soup.triangles.push_back({corner(), corner(), corner()});
  }
  expect_no_solid(soup);
}

TEST(RepairedSolid, thousands_of_triangles_in_each_others_way_are_no_trouble) {
  Chance chance(2);
  TriangleSoup soup;
  const auto corner = [&] { return 3 * Vec3{chance.unit(), chance.unit(), chance.unit()}; };
  for (int i = 0; i < 60; ++i) soup.triangles.push_back({corner(), corner(), corner()});
  expect_solid_or_reason(soup);
}

TEST(RepairedSolid, a_fan_of_pages_is_no_trouble) {
  TriangleSoup soup;
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100;
    const Vec3 tip{std::cos(angle), std::sin(angle), 0.5};
    soup.triangles.push_back({Vec3{0, 0, 0}, Vec3{0, 0, 1}, tip});
  }
  expect_solid_or_reason(soup);
  // Bodies like the segments of an orange, every other one inside out.
  TriangleSoup segments;
  Rational volume(0);
  for (int i = 0; i < 40; ++i) {
    const auto tip = [&](double part) {
      const double angle = 2 * std::numbers::pi * (i + part) / 40;
      return Vec3{std::cos(angle), std::sin(angle), 0.5};
    };
    const TriangleMesh segment = solids::tetrahedron({0, 0, 0}, {0, 0, 1}, tip(0.1), tip(0.9));
    volume = volume + solids::exact_volume_of(segment);
    segments = joined(segments, i % 2 == 0 ? soup_of(segment) : turned(soup_of(segment)));
  }
  expect_exactly(segments, volume);
}

TEST(RepairedSolid, cubes_that_touch_are_both_kept_when_one_is_inside_out) {
  for (const double size : {1.0, 2.0, 3.0}) {
    SCOPED_TRACE(size);
    const Rational volume = Rational(8) + Rational(size) * Rational(size) * Rational(size);
    const TriangleSoup cube = cube_soup(0, 2);
    const TriangleSoup at_vertex = shifted(cube_soup(0, size), {2, 2, 2});
    expect_exactly(joined(cube, turned(at_vertex)), volume);
    expect_exactly(joined(turned(cube), at_vertex), volume);
    // They share an edge, wholly or in part.
    const TriangleSoup at_edge = shifted(box_soup({0, 0, 0}, {size, size, 2}), {2, 2, 0});
    const Rational of_both = Rational(8) + Rational(2 * size * size);
    expect_exactly(joined(cube, turned(at_edge)), of_both);
    expect_exactly(joined(turned(cube), at_edge), of_both);
    const TriangleSoup at_part_of_edge = shifted(cube_soup(0, size), {2, 2, 0});
    expect_exactly(joined(cube, turned(at_part_of_edge)), volume);
    expect_exactly(joined(turned(cube), at_part_of_edge), volume);
    // They share a part of a side.
    if (size == 2) continue;
    const TriangleSoup at_side = shifted(cube_soup(0, size), {2, 0, 0});
    expect_exactly(joined(cube, turned(at_side)), volume);
    expect_exactly(joined(turned(cube), at_side), volume);
  }
}

// The common side is there twice, looking the same way, so one of each pair of facets is dropped. Each edge round it
// has three facets then, which are as nearly balanced as they can be, with either cube inside out or none: the facets
// say no more which is meant, and the cube that was inside out is lost (volume 8 is found).
TEST(RepairedSolid, DISABLED_cubes_that_share_a_whole_side_are_both_kept_when_one_is_inside_out) {
  const TriangleSoup cube = cube_soup(0, 2), beside = shifted(cube, {2, 0, 0});
  expect_exactly(joined(cube, turned(beside)), Rational(16));
  expect_exactly(joined(turned(cube), beside), Rational(16));
}

}  // namespace
}  // namespace algebra3d::soups
