// Upper bounds of how far nodes reach, and nodes told apart by them: beside brute force over the corners.
#include "algebra3d/kernel/search/node_slabs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/search/slab_gaps.h"
#include "unit/search/slab_samples.h"

namespace algebra3d {
namespace {

constexpr std::array<std::pair<double, double>, 6> kScalesAndOffsets{
    {{1, 0}, {1, 1e9}, {1e-300, 0}, {5e-324, 0}, {1e300, 0}, {1e-3, 1}}};

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> coordinate;
  const Vec3 v{coordinate(random), coordinate(random), coordinate(random)};
  return (1 / std::sqrt(dot(v, v))) * v;
}

template <typename Visit>
void for_each_node(const BoxHierarchy& hierarchy, const Visit& visit) {
  for (std::uint32_t level = 0; level < hierarchy.level_count(); ++level)
    for (std::uint32_t index = 0; index < hierarchy.node_count(level); ++index) visit(BoxHierarchy::Node{level, index});
}

double largest_coordinate_of(const TriangleMesh& mesh) {
  double largest = 0;
  for (const Vec3& p : mesh.points().approx())
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

TEST(NodeSlabs, NoCornerReachesFartherThanTheBound) {
  std::mt19937 random(3);  // NOLINT(cert-msc51-cpp): the same in every run
  for (const auto& [scale, offset] : kScalesAndOffsets)
    for (const TriangleMesh& mesh : slab_samples(scale, offset)) {
      const BoxHierarchy hierarchy(mesh);
      const BoxHierarchy::Frame& frame = hierarchy.frame();
      const double rounding = 0x1p-48 * largest_coordinate_of(mesh) / 2 * frame.scale;
      for_each_node(hierarchy, [&](BoxHierarchy::Node node) {
        const BoxHierarchy::Place place = hierarchy.place(node);
        for (int i = 0; i < 8; ++i) {
          const Vec3 direction =
              i < 2 ? (i == 0 ? 1.0 : -1.0) * hierarchy.slabs(mesh).normal(node) : random_direction(random);
          const double bound = hierarchy.slabs(mesh).reach(node, place, direction);
          for (const std::uint32_t face : hierarchy.faces_of(node))
            for (const std::uint32_t corner : mesh.triangle(FaceId(face))) {
              const Vec3 from_middle = frame.place_of(mesh.points().approx()[corner]) - place.middle;
              ASSERT_LE(dot(direction, from_middle), bound + rounding) << scale << " " << offset;
            }
        }
      });
    }
}

TEST(NodeSlabs, ASlabOfASmoothSurfaceIsThin) {
  const TriangleMesh mesh = round_mesh(128, 1, {3, 4, 5});
  const BoxHierarchy hierarchy(mesh);
  std::size_t nodes = 0, thin = 0;
  for_each_node(hierarchy, [&](BoxHierarchy::Node node) {
    if (node.level != 2) return;
    const BoxHierarchy::Place place = hierarchy.place(node);
    const Vec3 normal = hierarchy.slabs(mesh).normal(node);
    const double thickness =
        hierarchy.slabs(mesh).reach(node, place, normal) + hierarchy.slabs(mesh).reach(node, place, -1 * normal);
    ++nodes;
    thin += thickness < place.reach(normal) ? 1 : 0;  // half the box
  });
  EXPECT_GT(nodes, 1000);
  EXPECT_GT(thin, nodes * 9 / 10);
}

/// Squared distance of the nearest corners of two nodes: not less than that of their faces.
double corner_distance(const TriangleMesh& a, std::span<const std::uint32_t> faces_of_a, const TriangleMesh& b,
                       std::span<const std::uint32_t> faces_of_b) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t f : faces_of_a)
    for (const std::uint32_t g : faces_of_b)
      for (const std::uint32_t p : a.triangle(FaceId(f)))
        for (const std::uint32_t q : b.triangle(FaceId(g)))
          least = std::min(least, length(a.points().approx()[p] - b.points().approx()[q]));
  return least;
}

TEST(SlabGaps, NodesWhoseCornersAreNearAreNotToldApart) {
  std::size_t compared = 0, told = 0;
  for (const auto& [scale, offset] : kScalesAndOffsets) {
    const std::vector<TriangleMesh> meshes = slab_samples(scale, offset);
    for (const TriangleMesh& a : meshes)
      for (const TriangleMesh& b : slab_samples(scale, offset + 1.5 * scale)) {
        const BoxHierarchy of_a(a), of_b(b);
        of_a.slabs(a);
        of_b.slabs(b);
        SlabGaps gaps(a, of_a, b, of_b);
        for (int i = 0; i < 256; ++i) gaps.exceed({0, 0}, {0, 0}, 0);  // it looks for the slabs now and then
        for (std::uint32_t m = 0; m < of_a.leaf_count(); m += 3)
          for (std::uint32_t n = 0; n < of_b.leaf_count(); n += 5) {
            const double distance = corner_distance(a, of_a.leaf_faces(m), b, of_b.leaf_faces(n));
            ASSERT_FALSE(gaps.exceed({0, m}, {0, n}, distance)) << scale << " " << offset;
            ++compared;
            told += gaps.exceed({0, m}, {0, n}, distance / 4) ? 1 : 0;
          }
      }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(told, compared / 4);
}

/// Pairs of nodes that a search for pairs that meet asks about, and pairs of faces that it visits.
struct Steps {
  std::size_t nodes = 0, faces = 0;
};

Steps steps_of_search(const TriangleMesh& first, const TriangleMesh& second, bool uses_slabs) {
  const BoxHierarchy of_first(first), of_second(second);
  of_first.slabs(first);
  of_second.slabs(second);
  SlabGaps gaps(first, of_first, second, of_second);
  Steps steps;
  of_first.for_each_pair_with(
      of_second,
      [&](std::uint32_t, std::uint32_t) {
        ++steps.faces;
        return true;
      },
      [&](BoxHierarchy::Node m, BoxHierarchy::Node n) {
        ++steps.nodes;
        return uses_slabs && gaps.exceed(m, n, 0);
      },
      [] { return true; }, {0, 1});
  return steps;
}

TEST(SlabGaps, SmoothSurfacesThatAreNearAreToldApart) {
  // Spheres whose distance is a hundredth of their radius, one beside the other aslant.
  const TriangleMesh first = round_mesh(160, 1, {0, 0, 0}), second = round_mesh(160, 1, {1.21, 1.206, 1.06});
  const Steps of_boxes = steps_of_search(first, second, false), of_slabs = steps_of_search(first, second, true);
  EXPECT_GT(of_boxes.faces, 200);
  EXPECT_LT(of_slabs.faces, of_boxes.faces / 10);
  EXPECT_LT(of_slabs.nodes, of_boxes.nodes * 2 / 3);
}

TEST(SlabGaps, ThatTheyMeetIsNotMissed) {
  const TriangleMesh first = round_mesh(60, 1, {0, 0, 0}), second = round_mesh(60, 1, {1.1, 1.2, 1.0});
  const BoxHierarchy of_first(first), of_second(second);
  of_first.slabs(first);
  of_second.slabs(second);
  const auto meeting = [&](bool uses_slabs) {
    SlabGaps gaps(first, of_first, second, of_second);
    std::size_t count = 0;
    of_first.for_each_pair_with(
        of_second,
        [&](std::uint32_t f, std::uint32_t g) {
          const Contact kind = contact_of_triangles(first.corners(FaceId(f)), second.corners(FaceId(g))).kind;
          count += kind != Contact::none ? 1 : 0;
          return true;
        },
        [&](BoxHierarchy::Node m, BoxHierarchy::Node n) { return uses_slabs && gaps.exceed(m, n, 0); },
        [] { return true; }, {0, 1});
    return count;
  };
  EXPECT_GT(meeting(false), 50);
  EXPECT_EQ(meeting(true), meeting(false));
}

}  // namespace
}  // namespace algebra3d
