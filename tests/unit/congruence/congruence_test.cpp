// Copies of solids that were turned, mirrored, moved, rounded and divided into other triangles; what the motion must be
// is known from how they were made. And solids that differ by more than the tolerance.
#include "algebra3d/kernel/congruence/congruence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "algebra3d/kernel/congruence/detail/point_grid.h"
#include "algebra3d/kernel/exact/affine_map.h"

namespace algebra3d {
namespace {

struct Solid {
  std::vector<Vec3> points;
  std::vector<IndexTriangle> triangles;
};

Solid box(const Vec3& size) {
  Solid solid;
  for (unsigned i = 0; i < 8; ++i)
    solid.points.push_back({(i & 1U) * size.x, (i >> 1U & 1U) * size.y, (i >> 2U & 1U) * size.z});
  solid.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return solid;
}

/// A prism over a star-shaped polygon around the origin.
Solid prism(const std::vector<Vec3>& polygon, double height) {
  Solid solid;
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {0.0, height}) {
    for (const Vec3& p : polygon) solid.points.push_back({p.x, p.y, z});
    solid.points.push_back({0, 0, z});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n, up = n + 1;
    solid.triangles.insert(solid.triangles.end(),
                           {{n, j, i}, {n + up, i + up, j + up}, {i, j, j + up}, {i, j + up, i + up}});
  }
  return solid;
}

Solid regular_prism(int n, double height) {
  std::vector<Vec3> polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    polygon.push_back({std::cos(angle), std::sin(angle), 0});
  }
  return prism(polygon, height);
}

/// No motion but a mirrored one carries it onto its mirror image.
Solid chiral() {
  Solid solid{{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  return solid;
}

/// Each triangle in four, and on the sphere if the radius is positive.
Solid refined(const Solid& solid, double radius = 0) {
  Solid result{solid.points, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] = middles.emplace(std::minmax(a, b), result.points.size());
    if (!is_new) return place->second;
    const Vec3 m = 0.5 * (solid.points[a] + solid.points[b]);
    result.points.push_back(radius > 0 ? radius / length(m) * m : m);
    return place->second;
  };
  for (const auto& [a, b, c] : solid.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    result.triangles.insert(result.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return result;
}

Solid octasphere(int steps) {
  Solid solid{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
              {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int i = 0; i < steps; ++i) solid = refined(solid, 1);
  return solid;
}

Solid mirrored(Solid solid) {
  for (Vec3& p : solid.points) p.x = -p.x;
  for (IndexTriangle& t : solid.triangles) std::swap(t[1], t[2]);
  return solid;
}

Solid moved(Solid solid, const AffineMap& map) {
  for (Vec3& p : solid.points) p = map.apply_rounded(p);
  return solid;
}

AffineMap random_motion(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> real(-1, 1);
  const auto vector = [&] { return RationalVec3(Vec3{real(random), real(random), real(random)}); };
  return AffineMap::rotation(RationalVec3(), vector(), 180 * real(random))
      ->then(AffineMap::translation(Rational(reach) * vector()));
}

struct Operand {
  TriangleMesh mesh;
  BoxHierarchy hierarchy;

  explicit Operand(const Solid& solid) : mesh(PointArray(solid.points), solid.triangles), hierarchy(mesh) {}
  CongruenceOperand operand() const { return {&mesh, &hierarchy}; }
};

std::optional<RigidMotion> find(const Solid& a, const Solid& b, double tolerance) {
  const Operand first(a), second(b);
  return find_congruence(first.operand(), second.operand(), tolerance).value();
}

/// The rotation and reflection by Rodrigues' formula.
Vec3 carried(const RigidMotion& motion, const Vec3& p) {
  const double angle = motion.angle_degrees * std::numbers::pi / 180;
  const Vec3 v = (motion.is_mirrored ? -1.0 : 1.0) * (p - motion.centre);
  const Vec3 turned = std::cos(angle) * v + std::sin(angle) * cross(motion.axis, v) +
                      (1 - std::cos(angle)) * dot(motion.axis, v) * motion.axis;
  return motion.centre + turned + motion.translation;
}

void expect_carried(const Solid& a, const Solid& b, double tolerance) {
  const auto motion = find(a, b, tolerance);
  ASSERT_TRUE(motion.has_value());
  for (const Vec3& p : a.points) {
    double nearest = INFINITY;
    for (const Vec3& q : b.points) nearest = std::min(nearest, length(carried(*motion, p) - q));
    EXPECT_LE(nearest, 3 * tolerance);
  }
}

std::map<std::string, Solid> solids() {
  return {{"cube", box({1, 1, 1})},
          {"square box", box({1, 1, 4})},
          {"box", box({2, 3, 6})},
          {"prism", regular_prism(7, 2)},
          {"chiral", chiral()},
          {"sphere", octasphere(3)},
          {"star", prism({{2, 0, 0}, {1, 1, 0}, {-1, 2, 0}, {-1, -1, 0}, {0.5, -1.5, 0}}, 1)}};
}

TEST(congruence, finds_moved_copies) {
  std::mt19937 random(3);
  for (const auto& [name, solid] : solids()) {
    for (int i = 0; i < 10; ++i) {
      SCOPED_TRACE(name + " " + std::to_string(i));
      const AffineMap motion = random_motion(random, i < 5 ? 10 : 1e6);
      expect_carried(solid, moved(solid, motion), i < 5 ? 1e-9 : 1e-8);
      expect_carried(solid, moved(mirrored(solid), motion), i < 5 ? 1e-9 : 1e-8);
    }
  }
}

TEST(congruence, does_not_depend_on_triangles) {
  std::mt19937 random(4);
  for (const auto& [name, solid] : solids()) {
    SCOPED_TRACE(name);
    const Solid other = moved(refined(refined(solid)), random_motion(random, 10));
    EXPECT_TRUE(find(solid, other, 1e-9).has_value());
    EXPECT_TRUE(find(other, solid, 1e-9).has_value());
  }
}

TEST(congruence, tells_mirrored_solids) {
  EXPECT_FALSE(find(chiral(), chiral(), 0)->is_mirrored);
  EXPECT_TRUE(find(chiral(), mirrored(chiral()), 0)->is_mirrored);
  EXPECT_FALSE(find(box({1, 2, 3}), mirrored(box({1, 2, 3})), 0)->is_mirrored);
}

TEST(congruence, of_a_solid_with_itself_is_no_motion) {
  for (const auto& [name, solid] : solids()) {
    const auto motion = find(solid, solid, 0);
    ASSERT_TRUE(motion.has_value()) << name;
    EXPECT_EQ(motion->translation, (Vec3{0, 0, 0})) << name;
    EXPECT_NEAR(motion->angle_degrees, 0, 1e-6) << name;
  }
}

TEST(congruence, gives_axis_and_angle) {
  const Solid solid = chiral();
  const AffineMap quarter = *AffineMap::rotation(RationalVec3(), RationalVec3(Vec3{0, 0, 1}), 90);
  const auto motion = find(solid, moved(solid, quarter), 0);
  ASSERT_TRUE(motion.has_value());
  EXPECT_NEAR(motion->angle_degrees, 90, 1e-9);
  EXPECT_NEAR(motion->axis.z, 1, 1e-12);
  EXPECT_FALSE(motion->is_mirrored);
  // The centre (3/4, 1/2, 1/4) goes to (-1/2, 3/4, 1/4).
  EXPECT_NEAR(motion->translation.x, -1.25, 1e-15);
  EXPECT_NEAR(motion->translation.y, 0.25, 1e-15);
  EXPECT_NEAR(motion->translation.z, 0, 1e-15);
}

TEST(congruence, respects_the_tolerance) {
  const Solid cube = box({1, 1, 1});
  EXPECT_FALSE(find(cube, box({1, 1, 1.001}), 1e-4));
  // Centre to centre, the ends are off by half of the difference.
  EXPECT_TRUE(find(box({1, 2, 4}), box({1, 2, 4.001}), 6e-4));
  EXPECT_FALSE(find(box({1, 2, 4}), box({1, 2, 4.001}), 4e-4));
  EXPECT_FALSE(find(cube, box({1, 1, 1.001}), -1));
  Solid dented = refined(cube);
  dented.points[8] = dented.points[8] + Vec3{0, 0, 0.01};
  EXPECT_FALSE(find(cube, dented, 1e-4));
  EXPECT_FALSE(find(box({1, 2, 4}), box({1, 1, 8}), 0.1));
  EXPECT_FALSE(find(octasphere(2), octasphere(3), 1e-3));
}

TEST(congruence, at_other_scales) {
  std::mt19937 random(8);
  for (const double scale : {0x1p-1000, 0x1p-600, 0x1p-200, 0x1p200, 0x1p600, 0x1p1000}) {
    SCOPED_TRACE(scale);
    for (Solid solid : {chiral(), box({1, 1, 1})}) {
      Solid other = moved(solid, random_motion(random, 10));
      for (Vec3& p : solid.points) p = scale * p;
      for (Vec3& p : other.points) p = scale * p;
      EXPECT_TRUE(find(solid, other, 1e-9 * scale).has_value());
    }
  }
}

// All vertices are equally far from the centre, and all moments are equal. The 4,098 vertices make 16 million pairs.
TEST(congruence, of_many_vertices_on_a_sphere) {
  std::mt19937 random(9);
  const Solid sphere = octasphere(5);
  for (const bool is_mirrored : {false, true}) {
    Solid bumpy = sphere;
    bumpy.points[100] = 1.01 * bumpy.points[100];
    const Solid other = moved(is_mirrored ? mirrored(bumpy) : bumpy, random_motion(random, 10));
    EXPECT_TRUE(find(bumpy, other, 1e-9).has_value());
    EXPECT_FALSE(find(sphere, other, 1e-3).has_value());
  }
  const Solid copy = moved(sphere, random_motion(random, 10));
  const auto motion = find(sphere, copy, 1e-9);
  ASSERT_TRUE(motion.has_value());
  EXPECT_FALSE(motion->is_mirrored);
}

TEST(congruence, closest_pairs_are_those_of_all_pairs) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> real(-1, 1);
  for (const std::size_t count : {2U, 3U, 10U, 300U}) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back({real(random), real(random), real(random)});
    double least = 10;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < i; ++j) least = std::min(least, length(points[i] - points[j]));
    const detail::ClosestPair found = detail::closest_pair(points);
    EXPECT_EQ(found.distance, least);
    EXPECT_EQ(length(points[found.first] - points[found.second]), least);
    points.push_back(points[count / 2]);
    EXPECT_EQ(detail::closest_pair(points).distance, 0);
  }
}

TEST(congruence, is_interruptible) {
  const Operand cube(box({1, 1, 1}));
  const std::atomic<bool> cancel = true;
  const auto found = find_congruence(cube.operand(), cube.operand(), 0, &cancel);
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d
