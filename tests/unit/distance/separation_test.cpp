// How far nodes reach along a direction, beside brute force over their corners; and how much is looked at for that.
#include "algebra3d/kernel/distance/detail/separation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/search/slab_samples.h"

namespace algebra3d::distances {
namespace {

constexpr double kNoFloor = -std::numeric_limits<double>::infinity();
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
          const double expected = reach_by_brute_force(mesh, hierarchy.faces_of(node));
          ASSERT_GE(reach.at_most(node), expected - 1e-12 * scale);
          ASSERT_EQ(reach.of_node(node, kNoFloor), expected);
        }
    }
}

// Whatever was asked before.
TEST(Reach, BelowTheFloorItIsTheFloor) {
  const TriangleMesh mesh = round_mesh(40, 1, {0, 0, 0});
  const BoxHierarchy hierarchy(mesh);
  Reach reach({&mesh, &hierarchy});
  reach.turn(kDirection);
  std::size_t above = 0;
  for (const double floor : {0.99, -2.0, 0.5, 0.99, 2.0}) {
    for (std::uint32_t level = 0; level < hierarchy.level_count(); ++level)
      for (std::uint32_t index = 0; index < hierarchy.node_count(level); ++index) {
        const BoxHierarchy::Node node{level, index};
        const double expected = reach_by_brute_force(mesh, hierarchy.faces_of(node));
        ASSERT_EQ(reach.of_node(node, floor), std::max(floor, expected));
        above += level == 0 && floor == 0.99 && expected > floor ? 1 : 0;
      }
  }
  EXPECT_GT(above, 4);
  EXPECT_LT(above, hierarchy.leaf_count() / 10);
}

/// The smallest distance of corners: not less than that of the faces.
double distance_of_corners(const TriangleMesh& a, std::span<const std::uint32_t> of_a, const TriangleMesh& b,
                           std::span<const std::uint32_t> of_b) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t first : of_a)
    for (const std::uint32_t second : of_b)
      for (const std::uint32_t p : a.triangle(FaceId(first)))
        for (const std::uint32_t q : b.triangle(FaceId(second))) {
          const Vec3 way = b.points().approx()[q] - a.points().approx()[p];
          least = std::min(least, std::sqrt(dot(way, way)));
        }
  return least;
}

// Nothing that is nearer is kept apart, and much that is beside each other is.
TEST(Separation, KeepsPartsApartThatAreBesideEachOther) {
  const TriangleMesh first = round_mesh(16, 1, {0, 0, 0}), second = round_mesh(20, 1, {0.7, 0.9, 1.8});
  const BoxHierarchy of_first(first), of_second(second);
  Separation separation({&first, &of_first}, {&second, &of_second});
  separation.turn(kDirection);
  for (const double distance : {0.2, 0.5, 1.0}) {
    std::size_t kept = 0, far = 0;
    for (std::uint32_t i = 0; i < of_first.leaf_count(); i += 3)
      for (std::uint32_t j = 0; j < of_second.leaf_count(); j += 2) {
        const double corners = distance_of_corners(first, of_first.leaf_faces(i), second, of_second.leaf_faces(j));
        const bool is_apart = separation.keeps_apart(BoxHierarchy::Node{0, i}, BoxHierarchy::Node{0, j}, distance);
        ASSERT_TRUE(!is_apart || corners > distance);
        const FaceId face(of_first.leaf_faces(i)[0]), other(of_second.leaf_faces(j)[0]);
        const std::uint32_t faces[2] = {static_cast<std::uint32_t>(face.index()),
                                        static_cast<std::uint32_t>(other.index())};
        const double of_faces = distance_of_corners(first, {faces, 1}, second, {faces + 1, 1});
        ASSERT_TRUE(!separation.keeps_apart(face, other, distance) || of_faces > distance);
        kept += is_apart ? 1 : 0;
        far += corners > distance ? 1 : 0;
      }
    EXPECT_GT(kept, far * 9 / 10) << distance;
  }
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
