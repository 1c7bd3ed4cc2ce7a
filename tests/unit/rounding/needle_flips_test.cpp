#include "algebra3d/kernel/rounding/detail/needle_flips.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/validity/validity.h"
#include "unit/arrangement/random_solids.h"

namespace algebra3d::solids {
namespace {

constexpr double kOff = 1e-9;
constexpr std::uint32_t kInEdge = 12;

/// A cube with points near an edge. On one side of the edge they are corners of triangles as they should be, on the
/// other of needles between the points and the edge.
TriangleMesh cube_with_needles(Chance& chance) {
  std::vector<Vec3> points{{0, 0, 4}, {4, 0, 4}, {4, 4, 4}, {0, 4, 4}, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const auto p = [](std::uint32_t i) { return 7 + i; };  // from 1
  for (std::uint32_t i = 1; i <= kInEdge; ++i)
    points.push_back({4.0 * i / (kInEdge + 1), kOff * chance.unit(), 4 + kOff * chance.unit()});
  std::vector<TriangleMesh::Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 1}, {5, 6, 2}, {5, 2, 1}, {6, 7, 3},
                                                {6, 3, 2}, {7, 4, 0}, {7, 0, 3}, {4, 7, 6}, {4, 6, 5}};
  for (std::uint32_t i = 1; i < kInEdge; ++i) {
    triangles.push_back({0, p(i), p(i + 1)});
    triangles.push_back({4, p(i + 1), p(i)});
  }
  triangles.push_back({0, p(kInEdge), 1});
  triangles.push_back({4, 1, p(kInEdge)});
  triangles.push_back({4, p(1), 0});
  return {PointArray(points), triangles};
}

TEST(NeedleFlips, lead_an_edge_through_points_beside_it) {
  int crossing = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    const TriangleMesh cube = cube_with_needles(chance);
    crossing += prove_volume(cube)->is_valid() ? 0 : 1;
    const std::vector<bool> all(cube.vertex_count(), true);
    TriangleStars stars(cube);
    EXPECT_TRUE(flip_needles(stars, all, 4 * kOff));
    const TriangleMesh flipped = stars.mesh();
    EXPECT_EQ(prove_volume(flipped)->text(), "");
    EXPECT_EQ(flipped.face_count(), cube.face_count());
    EXPECT_EQ(flipped.vertex_count(), cube.vertex_count());
    EXPECT_FALSE(flip_needles(stars, all, 4 * kOff));
  }
  EXPECT_GT(crossing, 25);
}

TEST(NeedleFlips, are_made_only_where_all_corners_may_change_and_only_of_needles) {
  Chance chance(1);
  const TriangleMesh cube = cube_with_needles(chance);
  std::vector<bool> may_change(cube.vertex_count(), true);
  TriangleStars stars(cube);
  EXPECT_FALSE(flip_needles(stars, may_change, 1e-12));
  may_change[0] = false;
  EXPECT_FALSE(flip_needles(stars, may_change, 4 * kOff));
}

}  // namespace
}  // namespace algebra3d::solids
