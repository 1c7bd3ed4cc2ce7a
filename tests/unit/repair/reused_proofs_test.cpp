#include "support/rounds.h"
#include "unit/repair/damage.h"
#include "unit/repair/repaired.h"

// A repair that knows what the first proof found skips a part of later proofs. Its results must be those of a repair
// that proves everything again.

namespace algebra3d::soups {
namespace {

void expect_same_without_reuse(const TriangleSoup& soup) {
  RepairOptions anew;
  anew.reuses_proofs = false;
  const auto reused = solid_from_soup(soup), proved = solid_from_soup(soup, anew);
  ASSERT_TRUE(reused.ok() && proved.ok());
  EXPECT_EQ(reused->status(), proved->status());
  ASSERT_EQ(reused->mesh.has_value(), proved->mesh.has_value());
  EXPECT_EQ(reused->volume.has_value(), proved->volume.has_value());
  if (!reused->mesh) return;
  EXPECT_EQ(soup_of(*reused->mesh).triangles, soup_of(*proved->mesh).triangles);
  EXPECT_EQ(reused->volume->ratio_to(Amount(1)), proved->volume->ratio_to(Amount(1)));
  EXPECT_EQ(reused->mesh->points().exact_count(), proved->mesh->points().exact_count());
}

TEST(ReusedProofs, give_the_same_solid_for_hand_made_defects) {
  TriangleSoup open = cube_soup(0, 4);
  open.triangles.resize(10);
  TriangleSoup flipped = cube_soup(0, 4);
  flipped.triangles[3] = turned(flipped.triangles[3]);
  TriangleSoup repeated = cube_soup(0, 4);
  repeated.triangles.push_back(repeated.triangles[5]);
  const TriangleSoup crossing = joined(cube_soup(0, 4), cube_soup(2, 6));
  const TriangleSoup nested = joined(cube_soup(0, 4), cube_soup(1, 3));
  const TriangleSoup divided = joined(cube_soup(0, 4), wall_at(2, 0, 0, 4, 4));
  const TriangleSoup side_by_side = joined(cube_soup(0, 2), shifted(cube_soup(0, 2), {2, 0, 0}));
  for (const TriangleSoup& soup : {open, flipped, repeated, crossing, nested, divided, side_by_side, wall_of_squares(),
                                   turned(crossing), joined(open, crossing), TriangleSoup()})
    expect_same_without_reuse(soup);
}

TEST(ReusedProofs, give_the_same_solid_for_damaged_bodies) {
  constexpr std::array<Damage, 5> kDamages{turn_some, repeat_some, add_degenerate_ones, divide_some, shuffle_triangles};
  for (int seed = 1; seed <= rounds(10); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = soup_of(body(chance.below(kBodyCount)));
    for (int n = chance.between(0, 3); n > 0; --n) kDamages[index_below(chance, kDamages.size())](soup, chance);
    for (int n = chance.below(4); n > 0; --n)
      soup.triangles.erase(soup.triangles.begin() + chance.below(static_cast<int>(soup.triangles.size())));
    if (chance.one_in(2)) soup = joined(std::move(soup), shifted(cube_soup(0, 3), chance.grid_point(6)));
    if (chance.one_in(3)) soup = joined(std::move(soup), wall_at(1.5, -1, -1, 5, 5));
    if (chance.one_in(4)) open_gaps(soup, chance, 1e-7);
    expect_same_without_reuse(soup);
  }
}

TEST(ReusedProofs, give_the_same_solid_for_random_triangles) {
  for (int seed = 1; seed <= rounds(10); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup;
    for (int n = chance.between(1, 24); n > 0; --n)
      soup.triangles.push_back({chance.grid_point(4), chance.grid_point(4), chance.grid_point(4)});
    expect_same_without_reuse(soup);
  }
}

}  // namespace
}  // namespace algebra3d::soups
