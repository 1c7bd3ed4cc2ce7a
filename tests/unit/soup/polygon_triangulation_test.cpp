#include "algebra3d/kernel/soup/polygon_triangulation.h"

#include <numbers>
#include <numeric>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

using Outline = std::vector<Vec3>;

PolygonSoup polygon_soup_of(const std::vector<Outline>& polygons) {
  PolygonSoup soup;
  for (const Outline& polygon : polygons) {
    std::vector<std::uint32_t> corners(polygon.size());
    std::iota(corners.begin(), corners.end(), static_cast<std::uint32_t>(soup.points.size()));
    soup.points.insert(soup.points.end(), polygon.begin(), polygon.end());
    soup.add_face(corners);
  }
  return soup;
}
TriangleSoup triangles_of_polygon(const Outline& polygon) {
  return triangles_of(polygon_soup_of({polygon}));
}

/// Twice the vector area, by the rule for shoelaces.
Vec3 vector_area(const Outline& polygon) {
  Vec3 sum;
  for (std::size_t i = 0; i < polygon.size(); ++i) sum = sum + cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return sum;
}

/// n - 2 triangles that look as the polygon does and have its area: so they do not overlap.
void expect_partition(const Outline& polygon) {
  const TriangleSoup soup = triangles_of_polygon(polygon);
  EXPECT_EQ(soup.triangles.size() + 2, polygon.size());
  const Vec3 whole = vector_area(polygon);
  double area = 0;
  for (const auto& [a, b, c] : soup.triangles) {
    EXPECT_GT(dot(cross(b - a, c - a), whole), 0);
    area += area_of(SoupTriangle{a, b, c});
  }
  EXPECT_NEAR(area, length(whole) / 2, 1e-9 * (1 + area));
}

/// The same shape along any axis, from any corner on, and looking either way.
void expect_partitions(const Outline& polygon) {
  for (int turns = 0; turns < 3; ++turns)
    for (std::size_t first = 0; first < polygon.size(); ++first)
      for (const bool is_reversed : {false, true}) {
        Outline placed = polygon;
        std::rotate(placed.begin(), placed.begin() + static_cast<std::ptrdiff_t>(first), placed.end());
        if (is_reversed) std::ranges::reverse(placed);
        for (Vec3& p : placed)
          for (int i = 0; i < turns; ++i) p = {p.z, p.x, p.y};
        expect_partition(placed);
      }
}

TEST(PolygonTriangles, of_convex_polygons_all_have_the_first_corner) {
  for (int seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const int count = chance.between(3, 12);
    const Vec3 u = chance.direction(), w = cross(u, Vec3{1, 2, -3});
    Outline polygon;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      polygon.push_back(std::cos(angle) * u + std::sin(angle) * w + Vec3{5, 6, 7});
    }
    const TriangleSoup soup = triangles_of_polygon(polygon);
    ASSERT_EQ(soup.triangles.size(), polygon.size() - 2);
    for (std::size_t i = 0; i < soup.triangles.size(); ++i)
      EXPECT_EQ(soup.triangles[i], (SoupTriangle{polygon[0], polygon[i + 1], polygon[i + 2]}));
  }
}

TEST(PolygonTriangles, of_polygons_with_notches_do_not_overlap) {
  expect_partitions({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}});
  expect_partitions({{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  // A thin arrow, and one with its notch next to an edge.
  expect_partitions({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}});
  expect_partitions({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {4, 0.125, 0}, {0, 8, 0}});
}

TEST(PolygonTriangles, of_corners_in_the_middle_of_edges_none_is_degenerate) {
  expect_partitions({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
  expect_partitions({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 3, 0}});
}

TEST(PolygonTriangles, of_stars_of_random_radius_do_not_overlap) {
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const int count = chance.between(4, 30);
    Outline polygon;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count, radius = chance.between(1, 8);
      const double x = radius * std::cos(angle), y = radius * std::sin(angle);
      // In a slanted plane.
      polygon.push_back({x, y, 0.5 * x - 0.25 * y});
    }
    expect_partition(polygon);
  }
}

TEST(PolygonTriangles, of_polygons_that_cross_themselves_are_as_many) {
  for (const Outline& polygon : {Outline{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}},
                                 Outline{{0, 3, 0}, {2, -2, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -2, 0}},
                                 // With a bridge to a hole, whose ends are there twice.
                                 Outline{{0, 0, 0},
                                         {6, 0, 0},
                                         {6, 6, 0},
                                         {0, 6, 0},
                                         {0, 0, 0},
                                         {2, 2, 0},
                                         {2, 4, 0},
                                         {4, 4, 0},
                                         {4, 2, 0},
                                         {2, 2, 0}}}) {
    const TriangleSoup soup = triangles_of_polygon(polygon);
    EXPECT_EQ(soup.triangles.size() + 2, polygon.size());
    for (const SoupTriangle& t : soup.triangles)
      for (const Vec3& corner : t) EXPECT_NE(std::ranges::find(polygon, corner), polygon.end());
  }
}

TEST(PolygonTriangles, of_a_polygon_with_a_bridge_to_its_hole_have_the_area_without_it) {
  const Outline ring{{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 0},
                     {2, 2, 0}, {2, 4, 0}, {4, 4, 0}, {4, 2, 0}, {2, 2, 0}};
  EXPECT_NEAR(area_of(triangles_of_polygon(ring)), 32, 1e-9);
}

TEST(PolygonTriangles, repeated_corners_count_once) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};
  const TriangleSoup square = triangles_of_polygon({a, b, c, d});
  EXPECT_EQ(triangles_of_polygon({a, a, b, c, c, c, d, a, a}).triangles, square.triangles);
  EXPECT_EQ(triangles_of_polygon({a, b, b, c}).triangles, (std::vector<SoupTriangle>{{a, b, c}}));
  EXPECT_TRUE(triangles_of_polygon({a, b, b, a}).triangles.empty());
  EXPECT_TRUE(triangles_of_polygon({a, a, a, a, a}).triangles.empty());
  // Triangles are what they are.
  EXPECT_EQ(triangles_of_polygon({a, a, b}).triangles, (std::vector<SoupTriangle>{{a, a, b}}));
}

TEST(PolygonTriangles, of_several_faces_come_in_their_order) {
  const Outline first{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, second{{5, 0, 0}, {6, 0, 0}, {6, 1, 0}};
  PolygonSoup polygons = polygon_soup_of({first, second, first});
  polygons.name = "house";
  const TriangleSoup soup = triangles_of(polygons);
  EXPECT_EQ(soup.name, "house");
  ASSERT_EQ(soup.triangles.size(), 5U);
  EXPECT_EQ(soup.triangles[2], (SoupTriangle{second[0], second[1], second[2]}));
  EXPECT_EQ(soup.triangles[3], soup.triangles[0]);
  EXPECT_TRUE(triangles_of(PolygonSoup()).triangles.empty());
}

TEST(PolygonTriangles, huge_and_tiny_polygons_are_no_trouble) {
  const Outline notched{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}};
  const TriangleSoup expected = triangles_of_polygon(notched);
  for (const int exponent : {-1050, -600, 300, 600, 1020}) {
    SCOPED_TRACE(exponent);
    Outline polygon = notched;
    for (Vec3& p : polygon) p = {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), 0};
    TriangleSoup soup = triangles_of_polygon(polygon);
    for (SoupTriangle& t : soup.triangles)
      for (Vec3& p : t) p = {std::scalbn(p.x, -exponent), std::scalbn(p.y, -exponent), 0};
    EXPECT_EQ(in_order(soup), in_order(expected));
    std::ranges::reverse(polygon);
    EXPECT_EQ(triangles_of_polygon(polygon).triangles.size(), 4U);
  }
}

TEST(BentPolygons, are_found_with_the_largest_distance_from_their_plane) {
  const Outline flat{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, bent{{0, 0, 0}, {4, 0, 1}, {4, 4, 0}, {0, 4, 1}},
      less{{0, 0, 0}, {4, 0, 0.01}, {4, 4, 0}, {0, 4, 0.01}}, triangle{{0, 0, 0}, {4, 0, 1}, {4, 4, 9}};
  EXPECT_EQ(bent_polygons(polygon_soup_of({flat, triangle})).count, 0U);
  EXPECT_EQ(bent_polygons(polygon_soup_of({flat, triangle})).text(), "");
  const BentPolygons found = bent_polygons(polygon_soup_of({flat, less, triangle, bent, less}));
  EXPECT_EQ(found.count, 3U);
  EXPECT_EQ(found.face, 3U);
  EXPECT_NEAR(found.largest, 0.5, 1e-12);
  EXPECT_EQ(found.text(), "3 polygons are not planar, up to 0.5 (face 4, near (0 0 0))");
}

// Corners that were rounded do not make a polygon bent: to doubles or floats, and however far away it is.
TEST(BentPolygons, do_not_count_what_rounding_does) {
  for (int seed = 1; seed <= 200; ++seed) {
    Chance chance(static_cast<std::uint64_t>(seed));
    const Vec3 x = chance.direction(), y = cross(x, chance.direction());
    const Vec3 origin = std::pow(10.0, chance.below(8)) * chance.direction();
    Outline polygon;
    for (const auto& [u, v] : {std::pair(0, 0), std::pair(5, 1), std::pair(6, 4), std::pair(3, 6), std::pair(-1, 3)})
      polygon.push_back(origin + double(u) * x + double(v) * y);
    EXPECT_EQ(bent_polygons(polygon_soup_of({polygon})).count, 0U) << seed;
    for (Vec3& p : polygon) p = {double(float(p.x)), double(float(p.y)), double(float(p.z))};
    EXPECT_EQ(bent_polygons(polygon_soup_of({polygon})).count, 0U) << seed;
  }
}

}  // namespace
}  // namespace algebra3d::soups
