#include "algebra3d/kernel/soup/spatial_order.h"

#include <numeric>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

std::vector<TriangleMesh::Triangle> put_in_order(const WeldedTriangles& welded,
                                                 const std::vector<TriangleMesh::Triangle>& triangles) {
  std::vector<TriangleMesh::Triangle> result;
  for (const std::uint32_t t : spatial_order(welded.points.approx(), triangles)) result.push_back(triangles[t]);
  return result;
}

TEST(SpatialOrder, hardly_depends_on_how_many_are_out_of_order) {
  const WeldedTriangles torus = weld(soup_of(samples::torus(60, 40)).triangles);
  const auto ordered = put_in_order(torus, torus.triangles);
  EXPECT_EQ(put_in_order(torus, ordered), ordered);
  for (int seed = 1; seed <= 40; ++seed) {
    Chance chance(static_cast<std::uint64_t>(seed));
    std::vector<TriangleMesh::Triangle> triangles = ordered;
    // From hardly any to nearly all.
    for (int swaps = 1 << seed % 13; swaps > 0; --swaps)
      std::swap(triangles[index_below(chance, triangles.size())], triangles[index_below(chance, triangles.size())]);
    EXPECT_EQ(put_in_order(torus, triangles), ordered);
  }
}

TEST(SpatialOrder, keeps_the_order_of_triangles_in_one_place) {
  Chance chance(1);
  std::vector<Vec3> points;
  for (int i = 0; i < 6; ++i) points.push_back({double(i), double(i % 2), 0});
  for (const int count : {20, 2000}) {
    // Two places: the same three points in different order, and the others.
    std::vector<TriangleMesh::Triangle> triangles;
    for (int i = 0; i < count; ++i)
      triangles.push_back(chance.one_in(50) || i > 2 * count / 3 ? TriangleMesh::Triangle{3, 4, 5}
                                                                 : TriangleMesh::Triangle{0, 1, 2});
    const std::vector<std::uint32_t> order = spatial_order(points, triangles);
    for (std::size_t i = 1; i < order.size(); ++i)
      EXPECT_TRUE(triangles[order[i]] != triangles[order[i - 1]] || order[i - 1] < order[i]);
    EXPECT_TRUE(std::ranges::is_sorted(order, {}, [&](std::uint32_t t) { return triangles[t][0]; }));
  }
}

TEST(SpatialOrder, of_polygons_keeps_their_corners_and_is_that_of_triangles) {
  Chance chance(7);
  const WeldedTriangles torus = weld(soup_of(samples::torus(30, 20)).triangles);
  PolygonSoup soup;
  soup.points = torus.points.approx();
  soup.points.push_back({9, 9, 9});  // unused
  std::vector<TriangleMesh::Triangle> triangles = torus.triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    std::swap(triangles[i], triangles[index_below(chance, triangles.size())]);
  for (const auto& triangle : triangles) soup.add_face(triangle);
  const PolygonSoup found = in_spatial_order(soup);
  const WeldedTriangles expected =
      reordered({PointArray(soup.points), triangles}, spatial_order(soup.points, triangles));
  EXPECT_EQ(found.points, expected.points.approx());
  ASSERT_EQ(found.face_count(), expected.triangles.size());
  for (std::size_t f = 0; f < found.face_count(); ++f)
    EXPECT_TRUE(std::ranges::equal(found.face(f), expected.triangles[f]));

  PolygonSoup mixed;
  mixed.points = {{8, 8, 8}, {9, 8, 8}, {9, 9, 8}, {8, 9, 8}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mixed.add_face(std::vector<std::uint32_t>{0, 1, 2, 3});
  mixed.add_face(std::vector<std::uint32_t>{4, 5, 6});
  const PolygonSoup ordered = in_spatial_order(mixed);
  EXPECT_EQ(ordered.face_starts, (std::vector<std::uint32_t>{0, 3, 7}));
  EXPECT_EQ(ordered.corners, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(ordered.points[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(ordered.points[3], (Vec3{8, 8, 8}));
}

}  // namespace
}  // namespace algebra3d::soups
