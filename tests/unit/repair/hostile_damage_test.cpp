// Damage under which whole bodies used to vanish without a word. What is expected follows from the bodies that were
// damaged, whose volumes are known.
#include <cmath>

#include "support/rounds.h"
#include "unit/repair/repaired.h"

namespace algebra3d::soups {
namespace {

double volume(const SolidFromSoup& made) {
  return volume_of(made).nearest_double();
}

/// A box whose faces are n by n squares, all triangles alike.
TriangleSoup squared_box(int n, double size) {
  TriangleSoup soup;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool is_high : {false, true})
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
          const auto corner = [&](int u, int v) {
            Vec3 p;
            p[axis] = is_high ? size : 0;
            p[(axis + 1) % 3] = (i + u) * size / n;
            p[(axis + 2) % 3] = (k + v) * size / n;
            return p;
          };
          SoupTriangle first{corner(0, 0), corner(1, 0), corner(1, 1)};
          SoupTriangle second{corner(0, 0), corner(1, 1), corner(0, 1)};
          soup.triangles.push_back(is_high ? first : turned(first));
          soup.triangles.push_back(is_high ? second : turned(second));
        }
  return soup;
}

TEST(HostileDamage, corners_that_are_off_by_one_float_are_joined) {
  for (const double offset : {0.0, 1.0, 100.0})
    for (const int percent : {1, 5, 20, 60})
      for (int seed = 1; seed <= rounds(1); ++seed) {
        SCOPED_TRACE(std::to_string(offset) + ", percent " + std::to_string(percent) + ", seed " +
                     std::to_string(seed));
        Chance chance(static_cast<std::uint64_t>(seed));
        TriangleSoup soup = shifted(squared_box(8, 10), {offset, offset, offset});
        for (SoupTriangle& t : soup.triangles)
          for (Vec3& corner : t) {
            if (chance.below(100) >= percent) continue;
            double& moved = corner[index_below(chance, 3)];
            moved = std::nextafter(static_cast<float>(moved), chance.one_in(2) ? 1e9F : -1e9F);
          }
        EXPECT_NEAR(volume(repaired(soup)), 1000, 0.01);
      }
}

TEST(HostileDamage, corners_with_other_last_digits_are_joined) {
  for (const double digit : {1e-12, 1e-9, 1e-6})
    for (int seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Chance chance(static_cast<std::uint64_t>(seed));
      TriangleSoup soup = squared_box(6, 3);
      for (SoupTriangle& t : soup.triangles)
        for (Vec3& corner : t)
          if (chance.one_in(10)) corner[index_below(chance, 3)] += chance.one_in(2) ? digit : -digit;
      EXPECT_NEAR(volume(repaired(soup)), 27, 1e-3);
    }
}

TEST(HostileDamage, missing_triangles_are_no_gaps) {
  // Triangles of a flat box with needles: corners lie nearer to opposite edges than the tolerance.
  const TriangleSoup whole = soup_of(solids::mapped(solids::geodesic_sphere(10), [](const Vec3& p) {
    return Vec3{p.x * 1000, p.y * 0.02, p.z * 0.02};
  }));
  const double expected = solids::exact_volume_of(mesh_of(whole)).nearest_double();
  for (int seed = 1; seed <= rounds(5); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = whole;
    for (int i = 0; i < 3; ++i)
      soup.triangles.erase(soup.triangles.begin() +
                           static_cast<std::ptrdiff_t>(index_below(chance, soup.triangles.size())));
    EXPECT_NEAR(volume(repaired(soup)), expected, expected / 10);
  }
}

/// The cubes of a chess board in space that have their middle in one of its planes: they touch in edges.
TriangleSoup touching_cubes(int size, int& count) {
  TriangleSoup soup;
  count = 0;
  for (int x = 0; x < size; ++x)
    for (int y = 0; y < size; ++y)
      for (int z = 0; z < size; ++z)
        if ((x + y + z) % 2 == 0) {
          soup = joined(std::move(soup), shifted(cube_soup(0, 1), {double(x), double(y), double(z)}));
          ++count;
        }
  return soup;
}

TEST(HostileDamage, a_turned_triangle_of_bodies_that_touch_in_edges_is_turned_back) {
  int count = 0;
  const TriangleSoup cubes = touching_cubes(3, count);
  for (std::size_t f = 0; f < cubes.triangles.size(); f += 5) {
    SCOPED_TRACE(f);
    TriangleSoup soup = cubes;
    soup.triangles[f] = turned(soup.triangles[f]);
    const SolidFromSoup made = repaired(soup);
    EXPECT_EQ(volume_of(made), Rational(count));
    EXPECT_EQ(count_of(*made.repair, RepairStep::flipped_triangles), 1U);
  }
}

TEST(HostileDamage, many_turned_triangles_of_bodies_that_touch_in_edges_are_turned_back) {
  int count = 0;
  const TriangleSoup cubes = touching_cubes(3, count);
  for (int seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = cubes;
    for (SoupTriangle& t : soup.triangles)
      if (chance.one_in(seed % 2 == 0 ? 5 : 20)) t = turned(t);
    shuffle(soup, chance);
    EXPECT_EQ(volume_of(repaired(soup)), Rational(count));
  }
}

TEST(HostileDamage, boxes_that_touch_in_a_face_are_both_kept_when_one_is_inside_out) {
  for (int flipped_triangles = 0; flipped_triangles <= 12; ++flipped_triangles) {
    SCOPED_TRACE(flipped_triangles);
    TriangleSoup second = shifted(cube_soup(0, 1), {1, 0, 0});
    for (int f = 0; f < flipped_triangles; ++f)
      second.triangles[static_cast<std::size_t>(f)] = turned(second.triangles[static_cast<std::size_t>(f)]);
    EXPECT_EQ(volume_of(repaired(joined(cube_soup(0, 1), second))), Rational(2));
  }
}

TEST(HostileDamage, mirrored_hollow_bodies_keep_their_cavities) {
  const TriangleSoup hollow = joined(cube_soup(0, 4), turned(cube_soup(1, 3)));
  TriangleSoup mirrored = hollow;
  for (SoupTriangle& t : mirrored.triangles)
    for (Vec3& corner : t) corner.x = -10 - corner.x;
  expect_exactly(joined(hollow, mirrored), Rational(112));
  expect_exactly(joined(mirrored, hollow), Rational(112));
  expect_exactly(joined(shifted(cube_soup(0, 10), {20, 0, 0}), mirrored), Rational(1056));
  expect_exactly(joined(turned(cube_soup(0, 4)), turned(cube_soup(1, 3))), Rational(56));
  EXPECT_EQ(count_of(*repaired(joined(hollow, mirrored)).repair, RepairStep::flipped_shells), 2U);
}

TEST(HostileDamage, opposed_copies_of_triangles_tear_no_holes) {
  for (const TriangleSoup& whole : {squared_box(4, 4), soup_of(on_grid(samples::torus(14, 8)))})
    for (int seed = 1; seed <= 12; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Chance chance(static_cast<std::uint64_t>(seed));
      TriangleSoup soup = whole;
      const std::size_t count = whole.triangles.size();
      for (std::size_t f = 0; f < count; ++f)
        if (chance.one_in(2 + seed)) soup.triangles.push_back(turned(whole.triangles[f]));
      shuffle(soup, chance);
      expect_exactly(soup, solids::exact_volume_of(mesh_of(whole)));
    }
}

TEST(HostileDamage, opposed_copies_and_turned_triangles_together_tear_no_holes) {
  const TriangleSoup whole = squared_box(4, 4);
  for (int seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup;
    for (const SoupTriangle& t : whole.triangles) {
      soup.triangles.push_back(chance.one_in(8) ? turned(t) : t);
      if (chance.one_in(3)) soup.triangles.push_back(chance.one_in(2) ? turned(t) : t);
    }
    shuffle(soup, chance);
    expect_exactly(soup, Rational(64));
  }
}

TEST(HostileDamage, sheets_through_a_body_cut_nothing_off) {
  for (const bool looks_down : {false, true})
    for (const double height : {0.25, 1.5, 3.75})
      for (const double margin : {0.1, 1.0, 100.0}) {
        const TriangleSoup sheet = wall_at(height, -margin, -margin, 4 + margin, 4 + margin);
        const TriangleSoup soup = joined(squared_box(4, 4), looks_down ? turned(sheet) : sheet);
        const SolidFromSoup made = repaired(soup, with(&RepairOptions::most_dropped, 1));
        EXPECT_EQ(volume_of(made), Rational(64)) << made.status();
        EXPECT_EQ(count_of(*made.repair, RepairStep::open_patches), 1U);
        // The frame round the box, and how far its corner is from that.
        const RepairAmounts& amounts = *made.repair->amounts;
        EXPECT_NEAR(value_of(amounts.area_seen), 96 + (4 + 2 * margin) * (4 + 2 * margin),
                    1e-9 * value_of(amounts.area_seen));
        EXPECT_NEAR(value_of(amounts.left_out.area), (4 + 2 * margin) * (4 + 2 * margin) - 16,
                    1e-9 * value_of(amounts.area_seen));
        EXPECT_GE(amounts.left_out.distance, margin * std::sqrt(2) * (1 - 1e-12));
        EXPECT_LE(amounts.left_out.distance, margin * std::sqrt(2) * 1.011);
        EXPECT_EQ(amounts.left_out.triangle_count, 2U);
        EXPECT_EQ(value_of(amounts.added.area), 0);
        EXPECT_EQ(made.repair->find(RepairStep::holes), nullptr) << made.status();
      }
}

TEST(HostileDamage, a_file_that_is_inside_out_is_told_to_be_so) {
  TriangleSoup open = cube_soup(0, 1);
  open.triangles.erase(open.triangles.begin());
  const SolidFromSoup made = repaired(turned(open));
  EXPECT_EQ(volume_of(made), Rational(1));
  EXPECT_EQ(count_of(*made.repair, RepairStep::flipped_shells), 1U);
}

}  // namespace
}  // namespace algebra3d::soups
