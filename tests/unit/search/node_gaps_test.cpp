// Lower bounds of the distance of triangles and boxes, and of nodes of hierarchies: beside sampled points, which give
// upper bounds, and beside closed forms.
#include "algebra3d/kernel/search/node_gaps.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace algebra3d {
namespace {

using Corners = std::array<Vec3, 3>;

double distance(const Vec3& p, const Box3& box) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({box.min[axis] - p[axis], p[axis] - box.max[axis], 0.0});
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

/// The least distance of points of a triangle from a box: not less than the true one.
double sampled_distance(const Corners& t, const Box3& box) {
  constexpr int kSteps = 40;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j) {
      const double u = double(i) / kSteps, v = double(j) / kSteps;
      least = std::min(least, distance((1 - u - v) * t[0] + u * t[1] + v * t[2], box));
    }
  return least;
}

TEST(NodeGaps, AGapIsNoGreaterThanTheDistance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-10, 10), size(0, 3);
  int apart = 0, told = 0;
  for (int i = 0; i < 3000; ++i) {
    Corners t;
    for (Vec3& corner : t) corner = {coordinate(random), coordinate(random), coordinate(random)};
    const Vec3 at{coordinate(random), coordinate(random), coordinate(random)};
    const Box3 box{at, at + Vec3{size(random), size(random), size(random)}};
    const double gap = gap_between(t, box, 1e9, 1e-12), sampled = sampled_distance(t, box);
    ASSERT_LE(gap, sampled) << i;
    apart += sampled > 0.5 ? 1 : 0;
    told += sampled > 0.5 && gap > 0 ? 1 : 0;
  }
  EXPECT_GT(apart, 1000);
  EXPECT_EQ(told, apart) << "thirteen axes tell every triangle from every box that it does not meet";
}

TEST(NodeGaps, AGapAlongTheNormalIsTheDistance) {
  // The plane x + y + z = 30, and the corner (3, 3, 3) of the box.
  const Corners t{{{30, 0, 0}, {0, 30, 0}, {0, 0, 30}}};
  const Box3 box{{1, 1, 1}, {3, 3, 3}};
  EXPECT_NEAR(gap_between(t, box, 1e9, 1e-14), 21 / std::sqrt(3.0), 1e-12);
}

TEST(NodeGaps, ATriangleThatTouchesHasNoGap) {
  const Corners t{{{9, 0, 0}, {0, 9, 0}, {0, 0, 9}}};
  EXPECT_LE(gap_between(t, {{1, 1, 1}, {3, 3, 3}}, 1e9, 1e-14), 0);
}

TEST(NodeGaps, TinyAndHugeTrianglesHaveNoWrongGaps) {
  for (const double scale : {5e-324, 1e-310, 1e-200, 1e150, 1e300}) {
    const Corners t{{{9 * scale, 0, 0}, {0, 9 * scale, 0}, {0, 0, 9 * scale}}};
    const Box3 box{{scale, scale, scale}, {3 * scale, 3 * scale, 3 * scale}};
    EXPECT_LE(gap_between(t, box, 1e9, 0x1p-46 * 9 * scale + 0x1p-1000), 0) << scale;
  }
}

/// Long triangles along (1, -1, 0), and a patch of small ones beside them, within their boxes.
struct SlantingPair {
  TriangleMesh rods, patch;
};

SlantingPair slanting_pair(double height) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const double x = 0.001 * i;
    points.insert(points.end(), {{x - 100, 100, 0}, {x + 100, -100, 0}, {x + 100, -100, 2}});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  SlantingPair pair{TriangleMesh(PointArray(points), triangles), {}};
  points.clear();
  triangles.clear();
  for (std::uint32_t i = 0; i < 4096; ++i) {
    const Vec3 p{height + i % 64 * 0.001, height, 0.1 + i / 64 * 0.01};
    points.insert(points.end(), {p, p + Vec3{0.001, 0, 0}, p + Vec3{0, 0, 0.01}});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  pair.patch = TriangleMesh(PointArray(points), triangles);
  return pair;
}

/// Number of pairs of faces that a search visits, with and without NodeGaps.
std::array<std::size_t, 2> visited(const SlantingPair& pair) {
  const BoxHierarchy first(pair.rods), second(pair.patch);
  std::array<std::size_t, 2> count{};
  for (const bool is_used : {false, true}) {
    NodeGaps gaps(pair.rods, first, pair.patch, second);
    first.for_each_pair_with(
        second,
        [&](std::uint32_t, std::uint32_t) {
          gaps.note_visit();
          ++count[is_used ? 1 : 0];
          return true;
        },
        [&](BoxHierarchy::Node m, BoxHierarchy::Node n) { return is_used && gaps.exceed(m, n, 0); },
        [] { return true; }, {0, 1});
  }
  return count;
}

TEST(NodeGaps, LongTrianglesAslantAreToldFromWhatLiesInTheirBoxes) {
  const auto [all, with_gaps] = visited(slanting_pair(1));
  EXPECT_GT(all, 100'000);
  EXPECT_LT(with_gaps, all / 4);
}

TEST(NodeGaps, ASearchThatBoxesGuideWellDoesNotPay) {
  // The patch and a copy across it: their boxes meet along a line. If faces were compared, fewer pairs were visited.
  SlantingPair pair = slanting_pair(0);
  std::vector<Vec3> points = pair.patch.points().approx();
  for (Vec3& p : points) p = {p.x, p.z - 0.1, p.y + 0.4};
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < points.size(); i += 3) triangles.push_back({i, i + 1, i + 2});
  pair.rods = TriangleMesh(PointArray(points), triangles);
  const auto [all, with_gaps] = visited(pair);
  EXPECT_GT(all, 64);
  EXPECT_EQ(with_gaps, all);
}

TEST(NodeGaps, PairsThatMeetAreVisited) {
  // The patch crosses the plane x + y = 0 of the long triangles.
  const SlantingPair pair = slanting_pair(0);
  const BoxHierarchy first(pair.rods), second(pair.patch);
  const auto crossing_pairs = [&](bool is_used) {
    std::size_t count = 0;
    NodeGaps gaps(pair.rods, first, pair.patch, second);
    first.for_each_pair_with(
        second,
        [&](std::uint32_t f, std::uint32_t g) {
          count +=
              contact_of_triangles(pair.rods.corners(FaceId(f)), pair.patch.corners(FaceId(g))).kind != Contact::none
                  ? 1
                  : 0;
          return true;
        },
        [&](BoxHierarchy::Node m, BoxHierarchy::Node n) { return is_used && gaps.exceed(m, n, 0); },
        [] { return true; }, {0, 1});
    return count;
  };
  EXPECT_GT(crossing_pairs(false), 10);
  EXPECT_EQ(crossing_pairs(true), crossing_pairs(false));
}

}  // namespace
}  // namespace algebra3d
