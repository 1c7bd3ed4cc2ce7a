// The repair of what is hardly a solid, or none at all.
#include "algebra3d/kernel/repair/detail/repaired_solid.h"

#include <cmath>
#include <numbers>

#include "support/rounds.h"
#include "unit/repair/repaired.h"

namespace algebra3d::soups {
namespace {

TEST(RepairedSolid, of_too_few_triangles_there_is_none) {
  TriangleSoup one;
  one.triangles = {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}};
  expect_no_solid(one);
  expect_no_solid(joined(one, one));
  expect_no_solid(joined(one, turned(one)));
  TriangleSoup many;
  for (int i = 0; i < 1000; ++i) many = joined(std::move(many), i % 3 == 0 ? turned(one) : one);
  expect_no_solid(many);
}

TEST(RepairedSolid, of_triangles_without_area_is_the_empty_solid) {
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
  EXPECT_EQ(made->reason.find("the triangles are an open patch (near "), 0U) << made->reason;
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

// Two cubes with a common face: its triangles lie inside the solid, and are counted once.
TEST(RepairedSolid, triangles_that_went_with_their_duplicates_are_counted_once) {
  TriangleSoup mirrored = turned(cube_soup(0, 2));
  for (SoupTriangle& triangle : mirrored.triangles)
    for (Vec3& corner : triangle) corner.x = 4 - corner.x;
  const SolidFromSoup made = repaired(joined(cube_soup(0, 2), mirrored));
  EXPECT_EQ(volume_of(made), 16);
  EXPECT_EQ(count_of(*made.repair, RepairStep::duplicate_triangles), 2U);
  EXPECT_EQ(count_of(*made.repair, RepairStep::opposite_triangles), 2U);
  EXPECT_EQ(count_of(*made.repair, RepairStep::inner_triangles), 0U);
  EXPECT_EQ(made.repair->amounts->inside.triangle_count, 4U);
}

TEST(RepairedSolid, dangling_sheets_inside_are_counted_once) {
  TriangleSoup soup = cube_soup(0, 2);
  soup.triangles.push_back({Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{1, 1, 1}});
  const SolidFromSoup made = repaired(soup);
  EXPECT_EQ(volume_of(made), 8);
  EXPECT_EQ(count_of(*made.repair, RepairStep::dangling_sheets), 1U);
  EXPECT_EQ(count_of(*made.repair, RepairStep::inner_triangles), 0U);
}

TEST(RepairedSolid, nothing_is_a_distance_away_from_an_empty_one) {
  TriangleSoup open = cube_soup(0, 2);
  open.triangles.pop_back();
  const auto made = solid_from_soup(open, with(&RepairOptions::smallest_shell, 100.0));
  ASSERT_TRUE(made.ok() && made->mesh);
  const std::string text = made->repair->text();
  EXPECT_NE(text.find("left out: 11 triangles, area 22 (100 %)"), std::string::npos) << text;
  EXPECT_EQ(text.find("from the solid"), std::string::npos) << text;
}

TEST(RepairedSolid, places_in_reasons_have_the_digits_to_find_them) {
  const auto made = solid_from_soup(shifted(wall_at(0, 0, 0, 1, 1), {4512345, 5798765, 123}));
  EXPECT_EQ(made->reason, "the triangles are an open patch (near (4512345 5798765 123))");
}

// Shells in one another, as onion skins, each looking in or out.
TEST(RepairedSolid, nested_shells_of_any_orientation_follow_the_rules_for_shells) {
  for (int pattern = 0; pattern < 32; ++pattern) {
    SCOPED_TRACE("pattern " + std::to_string(pattern));
    TriangleSoup soup;
    const auto volume = [](int i) { return Rational((10 - 2 * i) * (10 - 2 * i) * (10 - 2 * i)); };
    const auto looks_in = [&](int i) { return (pattern >> i & 1) != 0; };
    for (int i = 0; i < 5; ++i) {
      const TriangleSoup skin = cube_soup(i, 10 - i);
      soup = joined(soup, looks_in(i) ? turned(skin) : skin);
    }
    // Triangles that mean nothing, so that there is something to repair.
    soup.triangles.push_back({Vec3{}, Vec3{}, Vec3{}});
    // From outside in: what looks the other way than a shell that was turned goes along; of others, cavities stay
    // within bodies alone.
    Rational expected(0);
    int winding = 0;
    bool is_outer_turned = false;
    for (int i = 0; i < 5; ++i) {
      const bool goes_along = i > 0 && is_outer_turned && looks_in(i) != looks_in(i - 1);
      const bool is_turned = goes_along || (looks_in(i) && winding <= 0);
      const int within = winding + (looks_in(i) != is_turned ? -1 : 1);
      if (winding <= 0 && within > 0) expected = expected + volume(i);
      if (winding > 0 && within <= 0) expected = expected - volume(i);
      winding = within;
      is_outer_turned = is_turned;
    }
    expect_exactly(soup, expected);
  }
}

// In each of its corners, whichever triangle comes first.
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
      if (first % 3 == 0) std::rotate(soup.triangles.begin(), soup.triangles.begin() + 1, soup.triangles.end());
      for (SoupTriangle& t : soup.triangles) std::rotate(t.begin(), t.begin() + 1, t.end());
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

TEST(RepairedSolid, of_many_separate_triangles_there_is_none) {
  Chance chance(1);
  TriangleSoup soup;
  for (int i = 0; i < (is_thorough() ? 3000 : 800); ++i) {
    const Vec3 a{4.0 * (i % 15), 4.0 * (i / 15 % 15), 4.0 * (i / 225)};
    const auto corner = [&] { return a + Vec3{chance.unit(), chance.unit(), chance.unit()}; };
    soup.triangles.push_back({corner(), corner(), corner()});
  }
  expect_no_solid(soup);
}

TEST(RepairedSolid, many_triangles_in_each_others_way_are_no_trouble) {
  Chance chance(2);
  TriangleSoup soup;
  const auto corner = [&] { return 3 * Vec3{chance.unit(), chance.unit(), chance.unit()}; };
  for (int i = 0; i < (is_thorough() ? 60 : 30); ++i) soup.triangles.push_back({corner(), corner(), corner()});
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

// The common side is there twice, looking the same way, so one of each pair of triangles is dropped. Each edge round it
// has three triangles then, which are as nearly balanced as they can be, with either cube inside out or none: the
// triangles say no more which is meant, and the cube that was inside out is lost (volume 8 is found).
TEST(RepairedSolid, cubes_that_share_a_whole_side_are_both_kept_when_one_is_inside_out) {
  const TriangleSoup cube = cube_soup(0, 2), beside = shifted(cube, {2, 0, 0});
  expect_exactly(joined(cube, turned(beside)), Rational(16));
  expect_exactly(joined(turned(cube), beside), Rational(16));
}

}  // namespace
}  // namespace algebra3d::soups
