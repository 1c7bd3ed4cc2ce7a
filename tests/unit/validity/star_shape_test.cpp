// Star shapes are accepted, everything else is refused, and both agree with the general proof.
#include "algebra3d/kernel/validity/star_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "algebra3d/kernel/validity/validity.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using samples::MeshMaker;
using Triangle = TriangleMesh::Triangle;

struct Draft {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  TriangleMesh mesh() const { return {PointArray(points), triangles}; }
  void add(const Draft& other) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (const auto& [a, b, c] : other.triangles) triangles.push_back({first + a, first + b, first + c});
  }
};

/// Rings between two poles that go `turns` times round the z axis; with more than one turn the poles are branch points
/// and the surface is still a sphere, of Euler characteristic 2. Each column has a radius of its own.
Draft wound_sphere(std::uint32_t rings, std::uint32_t columns, std::uint32_t turns) {
  Draft draft;
  for (std::uint32_t i = 1; i <= rings; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double down = std::numbers::pi * i / (rings + 1), round = 2 * std::numbers::pi * turns * j / columns;
      const double radius = 1 + 0.001 * j;
      draft.points.push_back({radius * std::sin(down) * std::cos(round), radius * std::sin(down) * std::sin(round),
                              radius * std::cos(down)});
    }
  const std::uint32_t top = rings * columns, bottom = top + 1;
  draft.points.push_back({0, 0, 1});
  draft.points.push_back({0, 0, -1});
  for (std::uint32_t j = 0; j < columns; ++j) {
    const std::uint32_t next = (j + 1) % columns, last = (rings - 1) * columns;
    draft.triangles.push_back({top, j, next});
    for (std::uint32_t i = 0; i + 1 < rings; ++i) {
      const std::uint32_t a = i * columns + j, b = a + columns, c = (i + 1) * columns + next, d = i * columns + next;
      draft.triangles.push_back({a, b, c});
      draft.triangles.push_back({a, c, d});
    }
    draft.triangles.push_back({bottom, last + next, last + j});
  }
  return draft;
}

Draft scaled(Draft draft, double factor, const Vec3& shift = {}) {
  for (Vec3& p : draft.points) p = factor * p + shift;
  return draft;
}

/// The definition: a valid volume, not empty, with the centre strictly behind all triangles.
bool is_star_shaped_by_proof(const TriangleMesh& mesh, const PointRef& centre) {
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    if (orient3d(t[0], t[1], t[2], centre) >= 0) return false;
  }
  return !mesh.is_empty() && prove_volume(mesh)->is_valid();
}

TEST(StarShape, of_boxes_wherever_they_lie) {
  for (const auto& [factor, shift] : std::vector<std::pair<Rational, Rational>>{
           {1, 0}, {Rational(1, 3), 0}, {1, Rational(1e9)}, {Rational(1e-300), 0}, {Rational(1e300), Rational(1, 7)}}) {
    const auto at = [&, &scale = factor, &move = shift](int x, int y, int z) {
      const auto map = [&](int c) { return Rational(c) * scale + move; };
      return ExactPoint(RationalVec3(map(x), map(y), map(z)));
    };
    const TriangleMesh box = MeshMaker(factor, shift).box({0, 0, 0}, {4, 4, 4}).mesh();
    EXPECT_TRUE(is_star_shaped(box, at(2, 2, 2)));
    EXPECT_TRUE(is_star_shaped(box, at(1, 3, 2)));
    EXPECT_FALSE(is_star_shaped(box, at(2, 2, 4))) << "on a side";
    EXPECT_FALSE(is_star_shaped(box, at(4, 4, 4))) << "in a corner";
    EXPECT_FALSE(is_star_shaped(box, at(2, 2, 5))) << "outside";
    EXPECT_FALSE(is_star_shaped(MeshMaker(factor, shift).box({0, 0, 0}, {4, 4, 4}, true).mesh(), at(2, 2, 2)));
  }
}

TEST(StarShape, of_spheres_and_of_points_from_which_not_all_is_seen) {
  for (const std::uint32_t n : {3U, 4U, 7U, 40U}) {
    const TriangleMesh sphere = wound_sphere(n / 2 + 1, n, 1).mesh();
    EXPECT_TRUE(is_star_shaped(sphere, Vec3{}));
    EXPECT_TRUE(prove_volume(sphere)->is_valid());
    EXPECT_FALSE(is_star_shaped(sphere, Vec3{0, 0, 1}));
    EXPECT_FALSE(is_star_shaped(sphere, Vec3{3, 0, 0}));
  }
  // An L: all is seen from its inner edge's surroundings, but not from the end of an arm, nor from the edge's planes.
  MeshMaker maker;
  const std::vector<std::array<double, 2>> outline{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& [x, y] = outline[i];
    const auto& [u, v] = outline[(i + 1) % outline.size()];
    maker.quad({x, y, 0}, {u, v, 0}, {u, v, 1}, {x, y, 1});
    maker.triangle({1, 1, 0}, {u, v, 0}, {x, y, 0}).triangle({1, 1, 1}, {x, y, 1}, {u, v, 1});
  }
  EXPECT_TRUE(is_star_shaped(maker.mesh(), Vec3{1, 1, 0.5}));
  EXPECT_FALSE(is_star_shaped(maker.mesh(), Vec3{2, 1, 0.5}));
  EXPECT_FALSE(is_star_shaped(maker.mesh(), Vec3{3, 1, 0.5}));
}

TEST(StarShape, refuses_what_covers_directions_twice) {
  const Draft twice = wound_sphere(3, 10, 2);
  for (std::uint32_t f = 0; f < twice.triangles.size(); ++f) {
    const TriangleRef t = twice.mesh().corners(FaceId(f));
    ASSERT_LT(orient3d(t[0], t[1], t[2], Vec3{}), 0) << "only the number of turns is wrong";
  }
  EXPECT_FALSE(is_star_shaped(twice.mesh(), Vec3{}));
  EXPECT_FALSE(prove_volume(twice.mesh())->is_valid());

  const Draft sphere = wound_sphere(3, 6, 1);
  Draft larger = sphere, same = sphere, same_corners = sphere, touching = sphere;
  larger.add(scaled(sphere, 2));
  same.add(sphere);
  same_corners.triangles.insert(same_corners.triangles.end(), sphere.triangles.begin(), sphere.triangles.end());
  // A smaller one within that has the upper pole in common.
  const auto first = static_cast<std::uint32_t>(touching.points.size());
  const Draft inner = scaled(sphere, 0.5, {0, 0, 0.5});
  touching.add(inner);
  for (auto& triangle : touching.triangles)
    for (std::uint32_t& corner : triangle)
      if (corner == first + 18) corner = 18;
  for (const Draft* draft : {&larger, &same, &same_corners}) EXPECT_FALSE(is_star_shaped(draft->mesh(), Vec3{}));
  EXPECT_TRUE(is_star_shaped(inner.mesh(), Vec3{0, 0, 0.25}));
  EXPECT_FALSE(is_star_shaped(touching.mesh(), Vec3{0, 0, 0.25})) << "pinched";
}

TEST(StarShape, refuses_wrong_missing_and_collapsed_facets) {
  Draft sphere = wound_sphere(3, 6, 1);
  for (Vec3& p : sphere.points)  // so that the middle of two points is a double
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = std::round(1024 * p[axis]) / 1024;
  ASSERT_TRUE(is_star_shaped(sphere.mesh(), Vec3{}));
  const auto n = static_cast<std::uint32_t>(sphere.points.size());
  for (std::size_t f = 0; f < sphere.triangles.size(); ++f) {
    Draft missing = sphere, turned = sphere, wrong = sphere, collapsed = sphere, doubled = sphere;
    missing.triangles.erase(missing.triangles.begin() + static_cast<std::ptrdiff_t>(f));
    std::swap(turned.triangles[f][0], turned.triangles[f][1]);
    wrong.triangles[f][0] = (wrong.triangles[f][0] + 7) % n;
    collapsed.triangles[f][0] = collapsed.triangles[f][1];
    doubled.triangles.push_back(sphere.triangles[f]);
    for (const Draft* draft : {&missing, &turned, &wrong, &collapsed, &doubled})
      EXPECT_FALSE(is_star_shaped(draft->mesh(), Vec3{})) << f;
  }
  // Corners on a line, one and the same point twice, and a corner moved to the other side.
  for (std::uint32_t v = 0; v < n; ++v) {
    Draft flat = sphere, equal = sphere, far = sphere;
    const auto at =
        std::ranges::find_if(sphere.triangles, [&](const Triangle& t) { return std::ranges::count(t, v) == 1; });
    ASSERT_NE(at, sphere.triangles.end());
    const auto corner = static_cast<std::size_t>(std::ranges::find(*at, v) - at->begin());
    const Vec3 one = sphere.points[(*at)[(corner + 1) % 3]], other = sphere.points[(*at)[(corner + 2) % 3]];
    flat.points[v] = 0.5 * one + 0.5 * other;
    equal.points[v] = one;
    far.points[v] = -1.5 * sphere.points[v];
    for (const Draft* draft : {&flat, &equal, &far}) EXPECT_FALSE(is_star_shaped(draft->mesh(), Vec3{})) << v;
  }
}

TEST(StarShape, refuses_several_shells_cavities_and_nothing) {
  EXPECT_FALSE(is_star_shaped(TriangleMesh(), Vec3{}));
  EXPECT_FALSE(is_star_shaped(MeshMaker().box({0, 0, 0}, {2, 2, 2}).box({4, 0, 0}, {6, 2, 2}).mesh(), Vec3{1, 1, 1}));
  EXPECT_FALSE(is_star_shaped(MeshMaker().box({0, 0, 0}, {2, 2, 2}).box({2, 2, 2}, {3, 3, 3}).mesh(), Vec3{1, 1, 1}));
  EXPECT_FALSE(is_star_shaped(MeshMaker().box({0, 0, 0}, {2, 2, 2}).box({2, 2, 0}, {4, 4, 2}).mesh(), Vec3{1, 1, 1}));
  const TriangleMesh hollow = MeshMaker().box({0, 0, 0}, {9, 9, 9}).box({4, 4, 4}, {5, 5, 5}, true).mesh();
  EXPECT_FALSE(is_star_shaped(hollow, Vec3{1, 1, 1}));
  EXPECT_FALSE(is_star_shaped(hollow, Vec3{4.5, 4.5, 4.5}));
}

// Corners moved on a coarse grid, so that triangles collapse, turn over and pass through each other, or just not.
TEST(StarShape, agrees_with_the_general_proof) {
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  int star_count = 0, valid_count = 0;
  constexpr int kRounds = 6000;
  for (int round = 0; round < kRounds; ++round) {
    const auto columns = static_cast<std::uint32_t>(between(3, 8));
    const bool is_double = between(0, 7) == 0 && columns > 6;
    Draft draft = wound_sphere(static_cast<std::uint32_t>(between(1, 3)), columns, is_double ? 2 : 1);
    const int noise = between(0, 6);
    for (Vec3& p : draft.points) {
      const double radius = between(0, 3) == 0 ? between(1, 9) : 6;
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = std::round(radius * p[axis]) + between(-noise, noise) / 4;
    }
    if (between(0, 9) == 0) draft.add(scaled(draft, between(0, 1) == 0 ? 2 : 1, {between(0, 1) * 14.0, 0, 0}));
    if (between(0, 9) == 0) std::swap(draft.triangles[0][0], draft.triangles[0][1]);
    MeshMaker maker;
    for (const auto& [a, b, c] : draft.triangles) maker.triangle(draft.points[a], draft.points[b], draft.points[c]);
    const Vec3 centre{between(-1, 1) / 2.0, between(-1, 1) / 2.0, between(-1, 1) / 2.0};
    const bool is_star = is_star_shaped_by_proof(maker.mesh(), centre);
    ASSERT_EQ(is_star_shaped(maker.mesh(), centre), is_star) << "round " << round;
    // Nor may vertices that were not welded deceive it.
    ASSERT_FALSE(!is_star && is_star_shaped(draft.mesh(), centre)) << "round " << round;
    star_count += static_cast<int>(is_star);
    valid_count += static_cast<int>(prove_volume(maker.mesh())->is_valid());
  }
  EXPECT_GT(star_count, kRounds / 5);
  EXPECT_GT(valid_count, star_count + kRounds / 20);
  EXPECT_LT(valid_count, kRounds - kRounds / 5);
}

}  // namespace
}  // namespace algebra3d
