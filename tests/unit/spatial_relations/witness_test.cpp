// Which common point is given of solids that touch in faces.
#include <gtest/gtest.h>

#include <algorithm>

#include "algebra3d/spatial_relations/relation.h"

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

bool is_corner(const ExactPoint& point, const Volume3d& of) {
  return std::ranges::any_of(of.mesh().points().approx(),
                             [&](const Vec3& corner) { return ExactPoint(corner) == point; });
}

void expect_on_faces(const MeetingWitness& witness, const Volume3d& first, const Volume3d& second) {
  EXPECT_TRUE(is_on_triangle(witness.point, first.mesh().corners(witness.first_face)));
  EXPECT_TRUE(is_on_triangle(witness.point, second.mesh().corners(witness.second_face)));
}

// Also where the first pair of triangles that is found has no corner in common: the plate's faces have two each.
TEST(MeetingWitness, is_a_corner_where_one_lies_in_the_other_solid) {
  const Volume3d plate = box({0, 0, -10}, {100, 100, 0});
  for (double x = 1; x < 60; x += 7)
    for (double y = 2; y < 60; y += 11) {
      const Volume3d pillar = box({x, y, 0}, {x + 37, y + 5, 30});
      for (const bool is_swapped : {false, true}) {
        const Volume3d &first = is_swapped ? pillar : plate, &second = is_swapped ? plate : pillar;
        const auto witness = witness_of_meeting(first, second);
        ASSERT_TRUE(witness.ok() && witness->has_value());
        EXPECT_TRUE(is_corner((*witness)->point, pillar));
        expect_on_faces(**witness, first, second);
      }
    }
}

TEST(MeetingWitness, is_a_crossing_of_edges_else) {
  const Volume3d plate = box({0, 0, -10}, {100, 100, 0}), bar = box({-5, 40, 0}, {105, 43, 3});
  const auto witness = witness_of_meeting(plate, bar);
  ASSERT_TRUE(witness.ok() && witness->has_value());
  expect_on_faces(**witness, plate, bar);
  EXPECT_FALSE(is_corner((*witness)->point, plate) || is_corner((*witness)->point, bar));
}

}  // namespace
}  // namespace algebra3d
