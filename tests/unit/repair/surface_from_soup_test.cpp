#include "algebra3d/kernel/repair/surface_from_soup.h"

#include <atomic>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

SurfaceFromSoup surface_of(const TriangleSoup& soup) {
  Result<SurfaceFromSoup> made = surface_from_soup(soup);
  EXPECT_TRUE(made.ok());
  if (!made.ok()) return {};
  EXPECT_EQ(prove_surface(made->mesh)->text(), "");
  EXPECT_EQ(audit(made->mesh), std::vector<std::string>());
  EXPECT_EQ(made->repair.deviation(), 0);
  return std::move(made).value();
}

double area_of_mesh(const TriangleMesh& mesh) {
  return nearest_area(mesh.points(), solids::triangles_of(mesh)).value();
}

TEST(SurfaceFromSoup, surfaces_come_out_untouched) {
  for (const TriangleMesh& mesh : {samples::torus(9, 7), samples::twisted_band(20, 1), mesh_of(wall_of_squares()),
                                   mesh_of(turned(cube_soup(0, 1))), TriangleMesh()}) {
    const TriangleSoup soup = soup_of(mesh);
    const SurfaceFromSoup made = surface_of(soup);
    EXPECT_EQ(in_order(soup_of(made.mesh)), in_order(soup));
    EXPECT_TRUE(made.repair.is_empty());
  }
}

TEST(SurfaceFromSoup, edges_with_many_pages_are_allowed) {
  TriangleSoup soup;
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.06 * i;
    soup.triangles.push_back({Vec3{0, 0, 0}, Vec3{0, 0, 1}, Vec3{std::cos(angle), std::sin(angle), 0}});
  }
  const SurfaceFromSoup made = surface_of(soup);
  EXPECT_EQ(in_order(soup_of(made.mesh)), in_order(soup));
  EXPECT_TRUE(made.repair.is_empty());
}

TEST(SurfaceFromSoup, triangles_without_area_are_dropped) {
  TriangleSoup soup = wall_of_squares();
  soup.triangles.push_back({Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{1, 1, 1}});
  soup.triangles.push_back({Vec3{0, 0, 0}, Vec3{2, 2, 2}, Vec3{1, 1, 1}});
  const SurfaceFromSoup made = surface_of(soup);
  EXPECT_EQ(in_order(soup_of(made.mesh)), in_order(wall_of_squares()));
  EXPECT_EQ(count_of(made.repair, RepairStep::repeated_corners), 1U);
  EXPECT_EQ(count_of(made.repair, RepairStep::collinear_corners), 1U);
}

/// A rectangle of whole cells at a height.
TriangleSoup rectangle(int x0, int y0, int x1, int y1, int z) {
  const Vec3 a{double(x0), double(y0), double(z)}, b{double(x1), double(y0), double(z)},
      c{double(x1), double(y1), double(z)}, d{double(x0), double(y1), double(z)};
  TriangleSoup soup;
  soup.triangles = {{a, b, c}, {a, c, d}};
  return soup;
}

// Cells are counted one by one.
TEST(SurfaceFromSoup, what_several_triangles_cover_is_there_once) {
  constexpr int kSize = 6;
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    std::vector<GridBox> covers;
    TriangleSoup soup;
    for (int n = chance.between(1, 6); n > 0; --n) {
      GridBox box = random_grid_box(chance, kSize);
      box.low[2] = chance.below(2);
      box.high[2] = box.low[2] + 1;
      covers.push_back(box);
      const TriangleSoup sheet = rectangle(box.low[0], box.low[1], box.high[0], box.high[1], box.low[2]);
      soup = joined(std::move(soup), chance.one_in(2) ? sheet : turned(sheet));
    }
    shuffle(soup, chance);
    EXPECT_EQ(area_of_mesh(surface_of(soup).mesh), static_cast<double>(covered_cells(covers, kSize)));
  }
}

TEST(SurfaceFromSoup, triangles_that_pass_through_each_other_are_divided) {
  for (int seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup;
    for (int n = chance.between(2, 10); n > 0; --n) {
      const auto corner = [&] { return 3 * Vec3{chance.unit(), chance.unit(), chance.unit()}; };
      soup.triangles.push_back({corner(), corner(), corner()});
    }
    const double area = area_of(soup);
    EXPECT_NEAR(area_of_mesh(surface_of(soup).mesh), area, 1e-12 * area);
  }
}

TEST(SurfaceFromSoup, a_vertex_in_the_middle_of_an_edge_divides_it) {
  TriangleSoup soup;
  soup.triangles = {{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}},
                    {Vec3{2, 0, 0}, Vec3{0, 0, 0}, Vec3{0, -3, 4}},
                    {Vec3{4, 0, 0}, Vec3{2, 0, 0}, Vec3{0, -3, 4}}};
  const SurfaceFromSoup made = surface_of(soup);
  EXPECT_EQ(area_of_mesh(made.mesh), 18);
  EXPECT_NE(made.repair.find(RepairStep::intersections), nullptr);
  std::size_t open_count = 0;
  for (std::uint32_t h = 0; h < made.mesh.halfedge_count(); ++h)
    open_count += made.mesh.is_boundary(HalfedgeId(h)) ? 1 : 0;
  // All that is open is the outline, along which nothing is divided but where it was.
  EXPECT_EQ(open_count, 4U);
}

TEST(SurfaceFromSoup, huge_and_tiny_coordinates_are_no_trouble) {
  for (const double size : {1e-300, 1e-100, 1e100, 1e300}) {
    const TriangleSoup soup = scaled(joined(cube_soup(0, 4), cube_soup(2, 6)), size);
    surface_of(soup);
  }
}

TEST(SurfaceFromSoup, the_same_soup_gives_the_same_mesh) {
  const TriangleSoup soup = joined(soup_of(samples::torus(12, 8)), cube_soup(1, 4));
  EXPECT_EQ(soup_of(surface_of(soup).mesh).triangles, soup_of(surface_of(soup).mesh).triangles);
}

TEST(SurfaceFromSoup, limits_and_cancelling_are_errors) {
  const TriangleSoup soup = joined(cube_soup(0, 4), cube_soup(2, 6));
  RepairOptions options;
  options.work_limit = 1e-6;
  const auto limited = surface_from_soup(soup, options);
  ASSERT_FALSE(limited.ok());
  EXPECT_EQ(limited.error().code, ErrorCode::limit_exceeded);
  options.work_limit = 1e300;
  EXPECT_TRUE(surface_from_soup(soup, options).ok());
  const std::atomic<bool> cancel = true;
  const auto cancelled = surface_from_soup(soup, {}, &cancel);
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::soups
