// How far nodes reach along a direction, beside brute force over their corners; and how much is looked at for that.
#include "algebra3d/distance/detail/separation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/halfedge/slab_samples.h"

namespace algebra3d::distances {
namespace {

constexpr Vec3 kDirection{2.0 / 7, 3.0 / 7, 6.0 / 7};

double reach_by_brute_force(const TriangleMesh& mesh, std::span<const std::uint32_t> faces) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t face : faces)
    for (const std::uint32_t corner : mesh.triangle(FaceId(face)))
      reach = std::max(reach, dot(kDirection, mesh.points().approx()[corner]));
  return reach;
}

TEST(Reach, IsThatOfTheFarthestCorner) {
  for (const double scale : {1.0, 1e-300, 1e290})
    for (const std::uint32_t n : {6U, 40U}) {
      const TriangleMesh mesh = round_mesh(n, scale, {3 * scale, 0, scale});
      const BoxHierarchy hierarchy(mesh);
      Reach reach({&mesh, &hierarchy});
      reach.turn(kDirection);
      for (std::uint32_t level = hierarchy.level_count(); level-- > 0;)
        for (std::uint32_t index = 0; index < hierarchy.node_count(level); ++index) {
          const BoxHierarchy::Node node{level, index};
          ASSERT_EQ(reach.of_node(node), reach_by_brute_force(mesh, hierarchy.faces_of(node)));
        }
    }
}

TEST(Reach, BelowTheFloorItIsTheFloor) {
  const TriangleMesh mesh = round_mesh(40, 1, {0, 0, 0});
  const BoxHierarchy hierarchy(mesh);
  Reach reach({&mesh, &hierarchy});
  reach.turn(kDirection);
  reach.ignore_below(0.99);
  std::size_t above = 0;
  for (std::uint32_t leaf = 0; leaf < hierarchy.leaf_count(); ++leaf) {
    const double expected = reach_by_brute_force(mesh, hierarchy.leaf_faces(leaf));
    ASSERT_EQ(reach.of_node({0, leaf}), std::max(0.99, expected));
    above += expected > 0.99 ? 1 : 0;
  }
  EXPECT_GT(above, 2);
  EXPECT_LT(above, hierarchy.leaf_count() / 20);
}

/// The number of nodes that are looked at for the farthest corner of a sphere.
std::int64_t work(std::uint32_t n) {
  const TriangleMesh mesh = round_mesh(n, 1, {0, 0, 0});
  const BoxHierarchy hierarchy(mesh);
  Reach reach({&mesh, &hierarchy});
  reach.turn(kDirection);
  reach.of_all();
  return reach.work();
}

TEST(Reach, TheWorkGrowsLessThanTheRootOfTheNumberOfTriangles) {
  // With the root, as with boxes alone, it would be eight times as much.
  const std::int64_t small = work(32), large = work(256);
  EXPECT_GT(small, 10);
  EXPECT_LT(large, 5 * small);
}

}  // namespace
}  // namespace algebra3d::distances
