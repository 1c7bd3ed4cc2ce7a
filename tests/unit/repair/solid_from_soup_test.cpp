#include "algebra3d/kernel/repair/solid_from_soup.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/soup/spatial_order.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using samples::MeshMaker;

TriangleSoup soup_of(const TriangleMesh& mesh) {
  TriangleSoup soup;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    soup.triangles.push_back({t[0].approx, t[1].approx, t[2].approx});
  }
  return soup;
}

/// The triangles, each from its smallest corner on, sorted.
std::vector<TriangleSoup::Triangle> sorted(std::vector<TriangleSoup::Triangle> triangles) {
  for (auto& t : triangles) std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  std::ranges::sort(triangles);
  return triangles;
}

void turn_over(TriangleSoup& soup) {
  for (auto& [a, b, c] : soup.triangles) std::swap(b, c);
}

TEST(SolidFromSoup, keeps_exactly_the_triangles_and_drops_nothing) {
  const TriangleSoup soup = soup_of(samples::torus(20, 12));
  const auto made = solid_from_soup(soup);
  ASSERT_TRUE(made->mesh);
  EXPECT_EQ(sorted(soup_of(*made->mesh).triangles), sorted(soup.triangles));
  EXPECT_EQ(made->mesh->vertex_count(), 240U);
  EXPECT_EQ(made->report.defects(), "");
  EXPECT_TRUE(made->report.remarks().empty());
}

TEST(SolidFromSoup, order_of_the_triangles_makes_no_difference) {
  TriangleSoup soup = soup_of(samples::torus(20, 12));
  const auto first = solid_from_soup(soup);
  std::mt19937 random(3);
  std::ranges::shuffle(soup.triangles, random);
  const auto second = solid_from_soup(soup);
  EXPECT_EQ(soup_of(*first->mesh).triangles, soup_of(*second->mesh).triangles);
}

TEST(SolidFromSoup, inside_out_is_turned_also_with_a_cavity) {
  TriangleSoup soup = soup_of(MeshMaker().box({0, 0, 0}, {4, 4, 4}).box({1, 1, 1}, {2, 2, 2}, true).mesh());
  turn_over(soup);
  const auto made = solid_from_soup(soup);
  ASSERT_TRUE(made->mesh);
  EXPECT_TRUE(made->report.was_flipped);
  turn_over(soup);
  EXPECT_EQ(sorted(soup_of(*made->mesh).triangles), sorted(soup.triangles));
}

TEST(SolidFromSoup, one_of_two_bodies_inside_out_is_refused) {
  const auto made = solid_from_soup(
      soup_of(MeshMaker().box({0, 0, 0}, {4, 4, 4}).box({5, 5, 5}, {6, 6, 6}, true).mesh()), RepairOptions::strict());
  EXPECT_FALSE(made->mesh);
  EXPECT_FALSE(made->report.was_flipped);
  EXPECT_EQ(made->report.defects().find("no valid solid: 1 shell with a wrong winding number (triangle "), 0U)
      << made->report.defects();
}

TEST(SolidFromSoup, defects_are_located_by_triangles_of_the_soup) {
  TriangleSoup soup = soup_of(samples::torus(20, 12));
  // The same triangle twice: as number 101 and as the last, number 481.
  soup.triangles.push_back(soup.triangles[100]);
  const auto made = solid_from_soup(soup, RepairOptions::strict());
  EXPECT_FALSE(made->mesh);
  EXPECT_NE(made->report.defects().find("1 duplicate triangle (triangles 101 and 481, near ("), std::string::npos)
      << made->report.defects();
}

TEST(SolidFromSoup, of_nothing_is_the_empty_solid) {
  const auto made = solid_from_soup({});
  ASSERT_TRUE(made->mesh);
  EXPECT_TRUE(made->mesh->is_empty());
}

TEST(SolidFromSoup, normals_without_length_contradict_nothing) {
  TriangleSoup soup = soup_of(MeshMaker().box({0, 0, 0}, {1, 1, 1}).mesh());
  soup.normals.assign(12, Vec3{});
  soup.normals[4] = {1, 1, 1};
  soup.normals[5] = {-7, 8, -9};
  const auto made = solid_from_soup(soup);
  ASSERT_TRUE(made->mesh);
  // Triangles 5 and 6 look towards -y.
  EXPECT_EQ(made->report.contradicting_normal_count, 2U);
  EXPECT_EQ(made->report.remarks(),
            std::vector<std::string>{"2 normals contradict the order of the corners (first: triangle 5)"});
}

TEST(SolidFromSoup, huge_and_tiny_coordinates_are_no_trouble) {
  for (const double size : {1e-320, 1e-160, 1e160, 1.7e308}) {
    const auto made = solid_from_soup(soup_of(MeshMaker().box({-size, -size, -size}, {size, size, size}).mesh()));
    EXPECT_TRUE(made->mesh) << size << " " << made->report.defects();
  }
}

TEST(SolidFromSoup, ends_when_asked_to) {
  const std::atomic<bool> cancel = true;
  const auto made = solid_from_soup(soup_of(samples::torus(20, 12)), {}, &cancel);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::interrupted);
}

TEST(SpatialOrder, is_a_permutation_that_brings_neighbours_together) {
  const TriangleMesh mesh = samples::torus(60, 40);
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) triangles.push_back(mesh.triangle(FaceId(f)));
  std::mt19937 random(5);
  std::ranges::shuffle(triangles, random);
  auto order = spatial_order(mesh.points().approx(), triangles);
  // Summed distance from each triangle to the next, before and after.
  const auto way = [&](const std::vector<std::uint32_t>& sequence) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < sequence.size(); ++i) {
      const Vec3 step =
          mesh.points().approx()[triangles[sequence[i + 1]][0]] - mesh.points().approx()[triangles[sequence[i]][0]];
      sum += std::sqrt(dot(step, step));
    }
    return sum;
  };
  std::vector<std::uint32_t> unsorted(triangles.size());
  std::iota(unsorted.begin(), unsorted.end(), 0U);
  EXPECT_LT(way(order), way(unsorted) / 10);
  std::ranges::sort(order);
  EXPECT_EQ(order, unsorted);
}

TEST(SpatialOrder, of_equal_places_is_the_order_given) {
  const std::vector<Vec3> points(3, Vec3{1, 2, 3});
  const std::vector<TriangleMesh::Triangle> triangles(5, {0, 1, 2});
  EXPECT_EQ(spatial_order(points, triangles), (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace algebra3d
