#include "algebra3d/kernel/rounding/detail/vertex_fan.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"

// Against the definition in rational numbers of Boost.

namespace algebra3d::solids {
namespace {

using Exact = boost::multiprecision::cpp_rational;
using ExactVector = std::array<Exact, 3>;

ExactVector difference(const Vec3& a, const Vec3& b) {
  return {Exact(a.x) - Exact(b.x), Exact(a.y) - Exact(b.y), Exact(a.z) - Exact(b.z)};
}
Exact product(const ExactVector& a, const ExactVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
ExactVector turned_product(const ExactVector& a, const ExactVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A vertex (number 0) with a ring around it that lies in a plane but for some tolerances, and a tip below, so that the
/// mesh is closed.
TriangleMesh cone(Chance& chance, std::uint32_t count, double off) {
  std::vector<Vec3> points{{0.3 * chance.unit(), 0.3 * chance.unit(), off * chance.unit()}};
  const Vec3 up{0.5 * chance.unit(), 0.5 * chance.unit(), 1};  // z + up.x * x + up.y * y is nearly the same for all
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.45 * chance.unit()) / count, radius = 1 + 0.6 * chance.unit();
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), off * chance.unit()});
  }
  for (Vec3& p : points) p.z -= up.x * p.x + up.y * p.y;
  points.push_back({0, 0, -9});
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t a = 1 + i, b = 1 + (i + 1) % count;
    triangles.push_back({0, a, b});
    triangles.push_back({count + 1, b, a});
  }
  return {PointArray(points), triangles};
}

/// The right answers of VertexFan for one neighbour, by their definition.
struct Definition {
  bool bends = false;            ///< a plane is farther than the tolerance from the vertex
  Exact squared_least_height{};  ///< 0: the triangles do not represent the surface
};

Definition definition(const TriangleMesh& mesh, const std::vector<std::uint32_t>& ring, std::size_t target,
                      double tolerance) {
  const auto place = [&](std::uint32_t v) { return mesh.points().approx()[v]; };
  const Vec3 v = place(0), w = place(ring[target]);
  const Exact squared_tolerance = Exact(tolerance) * Exact(tolerance);
  Definition result;
  std::optional<Exact> least;
  bool is_upright = true, is_near = false;
  const std::size_t n = ring.size();
  for (std::size_t i = (target + 1) % n; (i + 1) % n != target; i = (i + 1) % n) {
    const Vec3 a = place(ring[i]), b = place(ring[(i + 1) % n]);
    const ExactVector normal = turned_product(difference(a, w), difference(b, w));
    const Exact size = product(normal, normal), off = product(difference(v, w), normal);
    result.bends = result.bends || off * off > squared_tolerance * size;
    is_upright = is_upright && product(normal, turned_product(difference(a, v), difference(b, v))) > 0;
    Exact longest = 0;
    for (const ExactVector& side : {difference(a, w), difference(b, w), difference(b, a)})
      longest = std::max(longest, product(side, side));
    if (!least || size / longest < *least) least = size / longest;
    const auto is_on = [&](const Vec3& end) {
      const ExactVector edge = difference(end, w), to_v = difference(v, w), across = turned_product(to_v, edge);
      return product(to_v, edge) > 0 && product(across, across) <= squared_tolerance * product(edge, edge);
    };
    const bool is_over = product(turned_product(difference(a, w), difference(v, w)), normal) >= 0 &&
                         product(turned_product(difference(v, w), difference(b, w)), normal) >= 0;
    is_near = is_near || is_over || is_on(a) || is_on(b);
  }
  if (!result.bends && is_upright && is_near) result.squared_least_height = *least;
  return result;
}

TEST(VertexFan, tells_what_is_so_and_nothing_where_doubles_cannot) {
  int bent = 0, represented = 0, not_represented = 0, unknown = 0;
  const int fans = rounds(150);
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(fans); ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    const double tolerance = std::ldexp(1.0, -20 - static_cast<int>(seed % 33));
    const auto count = static_cast<std::uint32_t>(3 + seed % 8);
    const TriangleMesh mesh = cone(chance, count, (seed % 5 == 0 ? 100 : 1.2) * tolerance);
    const TriangleStars stars(mesh);
    VertexFan fan;
    ASSERT_TRUE(fan.surround(stars, 0, 60));
    ASSERT_EQ(fan.ring().size(), count);
    fan.measure(stars, tolerance);
    for (std::size_t target = 0; target < count; ++target) {
      const Definition truth = definition(mesh, fan.ring(), target, tolerance);
      if (fan.bends(target)) {
        EXPECT_TRUE(truth.bends);
        ++bent;
      }
      const std::optional<double> height = fan.least_height(target);
      if (!height) {
        ++unknown;
      } else if (*height == 0) {
        EXPECT_EQ(truth.squared_least_height, 0);
        ++not_represented;
      } else {
        EXPECT_NEAR(*height, std::sqrt(truth.squared_least_height.convert_to<double>()), 1e-12);
        ++represented;
      }
    }
  }
  EXPECT_GT(bent, fans / 2);
  EXPECT_GT(represented, fans / 2);
  EXPECT_GT(not_represented, fans / 2);
  EXPECT_LT(unknown, fans * 5 / 3);
}

TEST(VertexFan, needs_one_closed_fan) {
  Chance chance(1);
  const TriangleMesh whole = cone(chance, 6, 0);
  VertexFan fan;
  EXPECT_FALSE(fan.surround(TriangleStars(whole), 0, 5));
  EXPECT_TRUE(fan.surround(TriangleStars(whole), 0, 6));
  const TriangleMesh open(PointArray(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}),
                          std::vector<TriangleMesh::Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  EXPECT_FALSE(fan.surround(TriangleStars(open), 0, 60));
  // Two cones with their tips at one point.
  std::vector<TriangleMesh::Triangle> both;
  for (std::uint32_t i = 0; i < 3; ++i) {
    both.push_back({0, 1 + i, 1 + (i + 1) % 3});
    both.push_back({0, 4 + (i + 1) % 3, 4 + i});
  }
  const TriangleMesh touching(
      PointArray(
          std::vector<Vec3>{{0, 0, 0}, {1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}}),
      both);
  EXPECT_FALSE(fan.surround(TriangleStars(touching), 0, 60));
}

}  // namespace
}  // namespace algebra3d::solids
