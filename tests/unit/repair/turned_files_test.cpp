// The same file in another position: turned, moved and scaled at random, it has as many bodies, or none.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "support/placement.h"
#include "unit/repair/repaired.h"

namespace algebra3d::soups {
namespace {

/// A flat polygon with corners on a circle, every other one nearer to its middle by `inner`, as a fan.
TriangleSoup star(int corners, double inner) {
  TriangleSoup soup;
  const auto at = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / corners, radius = i % 2 == 0 ? 3 : inner;
    return Vec3{radius * std::cos(angle), radius * std::sin(angle), 0};
  };
  for (int i = 0; i < corners; ++i) soup.triangles.push_back({Vec3{0, 0, 0}, at(i), at(i + 1 == corners ? 0 : i + 1)});
  return soup;
}

/// A flat ring of `n` pieces: two boundary loops.
TriangleSoup flat_ring(int n) {
  TriangleSoup soup;
  const auto at = [&](int i, double radius) {
    const double angle = 2 * std::numbers::pi * (i % n) / n;
    return Vec3{radius * std::cos(angle), radius * std::sin(angle), 0};
  };
  for (int i = 0; i < n; ++i) {
    soup.triangles.push_back({at(i, 1), at(i, 2), at(i + 1, 2)});
    soup.triangles.push_back({at(i, 1), at(i + 1, 2), at(i + 1, 1)});
  }
  return soup;
}

TriangleSoup box_without_lid() {
  TriangleSoup soup = box_soup({0, 0, 0}, {2, 3, 5});
  std::erase_if(soup.triangles, [](const SoupTriangle& t) { return t[0].z == 5 && t[1].z == 5 && t[2].z == 5; });
  return soup;
}

/// Panels of 3 x 3 in a row beside a box.
TriangleSoup panels(int count) {
  TriangleSoup soup;
  for (int i = 0; i < count; ++i)
    for (const SoupTriangle& t : scaled(wall_of_squares(), 0.75).triangles)
      soup.triangles.push_back(
          {t[0] + Vec3{20.0 + 10 * i, 20, 20}, t[1] + Vec3{20.0 + 10 * i, 20, 20}, t[2] + Vec3{20.0 + 10 * i, 20, 20}});
  return soup;
}

/// One of twenty kinds of files.
TriangleSoup kind_of_file(int kind) {
  const TriangleSoup box = box_soup({0, 0, 0}, {2, 3, 5});
  if (kind < 5) return joined(box, panels(kind + 1));
  switch (kind) {
    case 5:
      return wall_of_squares();
    case 6:
      return star(10, 1);
    case 7:
      return joined(box, shifted(star(12, 1), {12, 0, 1}));
    case 8:
      return flat_ring(24);
    case 9:
      return joined(box, shifted(flat_ring(16), {0, 12, 2}));
    case 10:
      return box_without_lid();
    case 11:
      return joined(box_without_lid(), panels(2));
    case 12:
      return soup_of(samples::twisted_band(40, 1));
    case 13:
      return joined(box, shifted(soup_of(samples::twisted_band(40, 1)), {15, 0, 0}));
    case 14:
      return joined(box, box_soup({1, 1, 1}, {4, 4, 4}));
    case 15:
      return joined(box, shifted(box, {2, 0, 0}));
    case 16:
      return soup_of(solids::geodesic_sphere(3));
    case 17:
      return joined(soup_of(solids::geodesic_sphere(3)), panels(3));
    case 18:
      return joined(turned(box), shifted(turned(box_without_lid()), {9, 9, 9}));
    default:
      return joined(panels(3), shifted(star(6, 3), {0, 0, 9}));
  }
}

/// The number of bodies; -1 if there is no solid.
int bodies_of(const TriangleSoup& soup) {
  const auto made = solid_from_soup(soup);
  return made->mesh ? static_cast<int>(connected_components(*made->mesh).count) : -1;
}

TEST(TurnedFiles, have_as_many_bodies) {
  constexpr int kKinds = 20, kPlacements = 20;
  int differing = 0;
  std::string which;
  for (int kind = 0; kind < kKinds; ++kind) {
    const TriangleSoup soup = kind_of_file(kind);
    const int bodies = bodies_of(soup);
    for (int seed = 1; seed <= kPlacements; ++seed) {
      const int here = bodies_of(Placement(static_cast<std::uint64_t>(1000 * kind + seed)).of(soup));
      if (here == bodies) continue;
      ++differing;
      which += "\nkind " + std::to_string(kind) + ", seed " + std::to_string(seed) + ": " + std::to_string(here) +
               " instead of " + std::to_string(bodies);
    }
  }
  EXPECT_LE(differing, kKinds * kPlacements / 100) << which;
}

// The solids of these kinds are known: the box, or nothing.
TEST(TurnedFiles, give_boxes_and_nothing_for_sheets) {
  for (int kind = 0; kind < 5; ++kind) {
    const Placement placement(static_cast<std::uint64_t>(kind));
    for (const TriangleSoup& soup : {kind_of_file(kind), placement.of(kind_of_file(kind))}) {
      const auto made = solid_from_soup(soup);
      ASSERT_TRUE(made->mesh) << made->status();
      EXPECT_EQ(made->mesh->face_count(), 12U);
      EXPECT_EQ(count_of(*made->repair, RepairStep::open_patches), static_cast<std::uint64_t>(kind + 1));
      EXPECT_EQ(made->repair->amounts->left_out.triangle_count, 32U * static_cast<std::uint64_t>(kind + 1));
      EXPECT_EQ(made->repair->amounts->added.triangle_count, 0U);
    }
  }
  for (const int kind : {5, 6, 8, 12}) {
    const Placement placement(static_cast<std::uint64_t>(kind));
    for (const TriangleSoup& soup : {kind_of_file(kind), placement.of(kind_of_file(kind))}) {
      const auto made = solid_from_soup(soup);
      EXPECT_FALSE(made->mesh) << kind;
      EXPECT_EQ(made->reason.find("the triangles are an open patch"), 0U) << kind << ": " << made->reason;
    }
  }
}

// Whatever the status says was added, left out and lies within, is what the areas before and after differ by.
TEST(TurnedFiles, areas_are_accounted_for) {
  for (int kind = 0; kind < 20; ++kind)
    for (int seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE("kind " + std::to_string(kind) + ", seed " + std::to_string(seed));
      const Placement placement(static_cast<std::uint64_t>(1000 * kind + seed));
      const auto made = solid_from_soup(placement.of(kind_of_file(kind)));
      if (!made->mesh || !made->repair) continue;
      const RepairAmounts& amounts = *made->repair->amounts;
      const double seen = *amounts.area_seen.in_doubles();
      const double expected = seen - *amounts.left_out.area.in_doubles() - *amounts.inside.area.in_doubles() +
                              *amounts.added.area.in_doubles();
      EXPECT_NEAR(soups::area_of(soup_of(*made->mesh)), expected, 1e-4 * seen) << made->status();
      const bool has_changed = std::abs(expected - seen) > 1e-4 * seen;
      EXPECT_FALSE(has_changed && made->status().find("nothing moved") != std::string::npos) << made->status();
    }
}

}  // namespace
}  // namespace algebra3d::soups
