#include "algebra3d/kernel/repair/detail/winding_segmentation.h"

#include <atomic>
#include <limits>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

constexpr std::size_t kAllPairs = std::numeric_limits<std::size_t>::max();

Result<TriangleMesh> tolerant_solid_of(const TriangleSoup& soup, std::size_t max_pairs = kAllPairs,
                                       double max_angles = 1e12, const Monitor& monitor = {}) {
  const IndexedSoup indexed = indexed_soup(soup);
  const auto parts = ValidParts::make(*indexed.mesh());
  EXPECT_TRUE(parts.ok());
  return solid_by_generalized_winding(indexed, *parts, monitor, {Closure::together, max_pairs}, max_angles);
}

void expect_tolerated(const TriangleSoup& soup, const Rational& volume) {
  const auto solid = tolerant_solid_of(soup);
  ASSERT_TRUE(solid.ok()) << solid.error().message;
  expect_valid_volume(*solid);
  EXPECT_EQ(solids::exact_volume_of(*solid), volume);
}

TEST(WindingSegmentation, of_a_solid_is_the_solid) {
  for (const TriangleMesh& mesh :
       {samples::torus(9, 7), solids::cube(0, 2),
        samples::MeshMaker().box({0, 0, 0}, {6, 6, 6}).box({1, 1, 1}, {5, 5, 5}, true).mesh(),
        samples::MeshMaker().box({0, 0, 0}, {2, 2, 2}).box({2, 2, 0}, {4, 4, 2}).mesh()})
    expect_tolerated(soup_of(mesh), solids::exact_volume_of(mesh));
}

// The expected volume is counted cell by cell.
TEST(WindingSegmentation, of_overlapping_boxes_is_what_they_cover_together) {
  constexpr int kSize = 5;
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    std::vector<GridBox> boxes;
    TriangleSoup soup;
    for (int n = chance.between(1, 4); n > 0; --n) {
      boxes.push_back(random_grid_box(chance, kSize));
      soup = joined(std::move(soup), boxes.back().soup());
    }
    expect_tolerated(soup, Rational(covered_cells(boxes, kSize)));
  }
}

TEST(WindingSegmentation, sheets_and_walls_bound_nothing) {
  for (int seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    // Small triangles, within the box, outside of it and through its sides.
    TriangleSoup soup = cube_soup(0, 8);
    for (int n = chance.between(1, 4); n > 0; --n) {
      const Vec3 place = chance.grid_point(9);
      const auto corner = [&] { return place + Vec3{chance.unit(), chance.unit(), chance.unit()}; };
      soup.triangles.push_back({corner(), corner(), corner()});
    }
    expect_tolerated(soup, Rational(512));
  }
}

TEST(WindingSegmentation, a_few_triangles_that_look_the_wrong_way_decide_nothing) {
  TriangleSoup soup = cube_soup(0, 8);
  for (SoupTriangle& t : soup.triangles) {
    const SoupTriangle given = t;
    t = turned(t);
    expect_tolerated(soup, Rational(512));
    t = given;
  }
}

TEST(WindingSegmentation, what_is_open_holds_nothing) {
  TriangleSoup soup = cube_soup(0, 8);
  soup.triangles.pop_back();
  expect_tolerated(soup, Rational(0));
  expect_tolerated(wall_of_squares(), Rational(0));
  expect_tolerated({}, Rational(0));
  // Turned inside out it is no more than a cavity of nothing.
  expect_tolerated(turned(cube_soup(0, 8)), Rational(0));
}

TEST(WindingSegmentation, rooms_are_kept_each_for_itself) {
  // Two storeys with one ceiling between them; and one storey alone, the other open at a side.
  TriangleSoup soup = joined(cube_soup(0, 2), shifted(cube_soup(0, 2), {0, 0, 2}));
  const auto is_ceiling = [](const SoupTriangle& t) { return t[0].z == 2 && t[1].z == 2 && t[2].z == 2; };
  TriangleSoup ceiling = cube_soup(0, 2);
  std::erase_if(soup.triangles, is_ceiling);
  std::erase_if(ceiling.triangles, [&](const SoupTriangle& t) { return !is_ceiling(t); });
  expect_tolerated(joined(soup, ceiling), Rational(16));
  expect_tolerated(joined(soup, turned(ceiling)), Rational(16));
  std::erase_if(soup.triangles, [](const SoupTriangle& t) { return t[0].z == 4 && t[1].z == 4 && t[2].z == 4; });
  expect_tolerated(joined(soup, ceiling), Rational(8));
}

TEST(WindingSegmentation, limits_are_errors) {
  const TriangleSoup soup = joined(cube_soup(0, 4), cube_soup(2, 6));
  const auto by_pairs = tolerant_solid_of(soup, 1);
  ASSERT_FALSE(by_pairs.ok());
  EXPECT_EQ(by_pairs.error().code, ErrorCode::limit_exceeded);
  const auto by_angles = tolerant_solid_of(soup, kAllPairs, 1);
  ASSERT_FALSE(by_angles.ok());
  EXPECT_EQ(by_angles.error().code, ErrorCode::limit_exceeded);
}

TEST(WindingSegmentation, ends_when_asked_to) {
  const std::atomic<bool> cancel = true;
  const auto made = tolerant_solid_of(joined(cube_soup(0, 4), cube_soup(2, 6)), kAllPairs, 1e12, &cancel);
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::soups
