// Which common point is given of solids that touch in faces.
#include <gtest/gtest.h>

#include <algorithm>

#include "algebra3d/values/spatial_relations/relation.h"

namespace algebra3d {
namespace {

Volume3d box(const Vec3& min, const Vec3& max) {
  std::vector<Vec3> points;
  for (unsigned i = 0; i < 8; ++i)
    points.push_back({(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y, (i & 4) != 0 ? max.z : min.z});
  const std::vector<TriangleMesh::Triangle> triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                                         {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                                         {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return Volume3d::trusted(TriangleMesh(PointArray(points), triangles));
}

/// A rectangle at z = 0 of strips along x, two triangles each.
Surface3d strips(std::uint32_t count, double length, double width) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i <= count; ++i) {
    points.push_back({0, width * i, 0});
    points.push_back({length, width * i, 0});
    if (i == count) break;
    triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
    triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
  }
  return Surface3d::trusted(TriangleMesh(PointArray(points), triangles));
}

bool is_corner(const ExactPoint& point, const Volume3d& of) {
  return std::ranges::any_of(of.mesh().points().approx(),
                             [&](const Vec3& corner) { return ExactPoint(corner) == point; });
}

// Also where the first pair of triangles that is found has no corner in common: most strips below a pillar have none.
TEST(MeetingWitness, is_a_corner_where_one_lies_in_the_other_set) {
  const Surface3d plate = strips(40, 100, 2.5);
  for (double x = 1; x < 60; x += 7)
    for (double y = 2; y < 60; y += 11) {
      const Volume3d pillar = box({x, y, 0}, {x + 37, y + 30, 30});
      for (const bool is_swapped : {false, true}) {
        const auto witness = is_swapped ? witness_of_meeting(pillar, plate) : witness_of_meeting(plate, pillar);
        ASSERT_TRUE(witness.ok() && witness->has_value());
        const MeetingWitness& found = **witness;
        EXPECT_TRUE(is_corner(found.point, pillar));
        const FaceId of_plate = is_swapped ? found.second_face : found.first_face,
                     of_pillar = is_swapped ? found.first_face : found.second_face;
        EXPECT_TRUE(is_on_triangle(found.point, plate.mesh().corners(of_plate)));
        EXPECT_TRUE(is_on_triangle(found.point, pillar.mesh().corners(of_pillar)));
      }
    }
}

TEST(MeetingWitness, is_a_crossing_of_edges_else) {
  const Volume3d plate = box({0, 0, -10}, {100, 100, 0}), bar = box({-5, 40, 0}, {105, 43, 3});
  const auto witness = witness_of_meeting(plate, bar);
  ASSERT_TRUE(witness.ok() && witness->has_value());
  EXPECT_TRUE(is_on_triangle((*witness)->point, plate.mesh().corners((*witness)->first_face)));
  EXPECT_TRUE(is_on_triangle((*witness)->point, bar.mesh().corners((*witness)->second_face)));
  EXPECT_FALSE(is_corner((*witness)->point, plate) || is_corner((*witness)->point, bar));
}

}  // namespace
}  // namespace algebra3d
