// Creases through simplification, and where the elements of the result come from.
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/simplification/simplification.h"

namespace algebra3d {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Triangles of quadrilaterals by points; equal points become one vertex.
class PatchMaker {
 public:
  /// m by n quadrilaterals over the square of the parameters u and v from 0 to 1. Corners that are equal are left out.
  void patch(std::uint32_t m, std::uint32_t n, const std::function<Vec3(double, double)>& at) {
    const auto node = [&](std::uint32_t i, std::uint32_t j) { return number(at(1.0 * i / m, 1.0 * j / n)); };
    for (std::uint32_t i = 0; i < m; ++i)
      for (std::uint32_t j = 0; j < n; ++j) {
        add(node(i, j), node(i + 1, j), node(i + 1, j + 1));
        add(node(i, j), node(i + 1, j + 1), node(i, j + 1));
      }
  }
  TriangleMesh make() const { return {PointArray(points_), triangles_}; }

 private:
  std::uint32_t number(const Vec3& p) {
    const auto [place, is_new] = numbers_.try_emplace(p, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return place->second;
  }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) triangles_.push_back({a, b, c});
  }

  std::map<Vec3, std::uint32_t> numbers_;
  std::vector<Vec3> points_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

/// A point of a circle; the same doubles after a whole turn.
Vec3 on_circle(double turn, double radius, double height) {
  const double angle = 2 * std::numbers::pi * (turn == 1 ? 0 : turn);
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

/// A cylinder of radius 1 and height 2, with 36 corners to a circle.
TriangleMesh cylinder() {
  PatchMaker maker;
  maker.patch(36, 8, [](double u, double v) { return on_circle(u, 1, 2 * v); });
  maker.patch(36, 4, [](double u, double v) { return on_circle(u, v, 0); });
  maker.patch(36, 4, [](double u, double v) { return on_circle(u, 1 - v, 2); });
  return maker.make();
}

TriangleMesh divided_cube(std::uint32_t n) {
  PatchMaker maker;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, 1.0})
      maker.patch(n, n, [&](double u, double v) {
        if (side == 0) std::swap(u, v);
        Vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return p;
      });
  return maker.make();
}

Vec3 unit_normal(const TriangleMesh& mesh, FaceId f) {
  const auto [a, b, c] = mesh.triangle(f);
  const auto& points = mesh.points().approx();
  const Vec3 normal = cross(points[b] - points[a], points[c] - points[a]);
  return (1 / length(normal)) * normal;
}

struct Segment {
  Vec3 from, to;
};

/// The edges whose faces are at a larger angle than this.
std::vector<Segment> sharp_edges(const TriangleMesh& mesh, double degrees) {
  std::vector<Segment> found;
  for (const HalfedgeId h : edges(mesh)) {
    const HalfedgeId o = mesh.opposite(h);
    if (!o.is_valid()) continue;
    const double cosine = dot(unit_normal(mesh, mesh.face(h)), unit_normal(mesh, mesh.face(o)));
    if (cosine < std::cos(degrees * std::numbers::pi / 180))
      found.push_back({mesh.point(mesh.origin(h)).approx, mesh.point(mesh.target(h)).approx});
  }
  return found;
}

double distance_from(const Segment& s, const Vec3& p) {
  const Vec3 along = s.to - s.from;
  const double share = std::clamp(dot(p - s.from, along) / dot(along, along), 0.0, 1.0);
  return length(p - (s.from + share * along));
}

/// The largest distance of an end or middle of some segments from others.
double farthest(const std::vector<Segment>& from, const std::vector<Segment>& to) {
  double largest = 0;
  for (const Segment& s : from)
    for (const Vec3& p : {s.from, s.to, 0.5 * (s.from + s.to)}) {
      double nearest = kNoLimit;
      for (const Segment& t : to) nearest = std::min(nearest, distance_from(t, p));
      largest = std::max(largest, nearest);
    }
  return largest;
}

TEST(SimplificationFeatures, rims_of_a_cylinder_stay_within_the_deviation) {
  const TriangleMesh mesh = cylinder();
  const std::vector<Segment> rims = sharp_edges(mesh, 30);
  ASSERT_EQ(rims.size(), 72U);
  std::size_t last = mesh.face_count();
  for (const double deviation : {0.003, 0.02, 0.1}) {
    const auto result = simplified_volume(mesh, {0, deviation, 30});
    const std::vector<Segment> left = sharp_edges(result->mesh, 70);
    EXPECT_LE(result->deviation, deviation);
    EXPECT_LE(farthest(rims, left), deviation * (1 + 1e-9));
    EXPECT_LE(farthest(left, rims), deviation * (1 + 1e-9));
    EXPECT_LE(result->mesh.face_count(), last);
    last = result->mesh.face_count();
  }
  EXPECT_LT(last, mesh.face_count() / 4);
}

TEST(SimplificationFeatures, vertices_of_creases_are_original_ones) {
  const TriangleMesh mesh = cylinder();
  for (const std::size_t count : {500U, 200U, 60U}) {
    const auto result = simplified(mesh, {count, kNoLimit, 30});
    EXPECT_LE(result->mesh.face_count(), count);
    EXPECT_EQ(audit(result->mesh), std::vector<std::string>());
    std::size_t on_rims = 0;
    for (const Vec3& p : result->mesh.points().approx()) {
      const bool is_on_rim = (p.z == 0 || p.z == 2) && std::abs(std::hypot(p.x, p.y) - 1) < 1e-15;
      on_rims += is_on_rim ? 1 : 0;
      // Nothing else has become sharp so near to the rims.
      EXPECT_TRUE(is_on_rim || (p.z > 0 && p.z < 2) || std::hypot(p.x, p.y) < 0.99);
    }
    EXPECT_GE(on_rims, 6U);
  }
}

TEST(SimplificationFeatures, ends_and_meeting_points_stay) {
  const auto cube = simplified(divided_cube(6), {0, kNoLimit, 30});
  ASSERT_EQ(cube->mesh.face_count(), 12U);
  for (const Vec3& p : cube->mesh.points().approx())
    for (const double x : {p.x, p.y, p.z}) EXPECT_TRUE(x == 0 || x == 1);
  // A crease in the middle of a bumpy sheet, from the boundary to a point inside.
  PatchMaker maker;
  maker.patch(40, 40, [](double u, double v) {
    const double rest = std::max(0.0, 0.5 - v);
    return Vec3{u, v, 1.6 * rest * rest * (1 - std::abs(2 * u - 1)) + 0.002 * std::sin(11 * u) * std::sin(7 * v)};
  });
  const TriangleMesh sheet = maker.make();
  const std::vector<Segment> ridge = sharp_edges(sheet, 20);
  ASSERT_GT(ridge.size(), 5U);
  const auto result = simplified(sheet, {80, kNoLimit, 20});
  EXPECT_LE(farthest(ridge, sharp_edges(result->mesh, 10)), 0.005);
}

TEST(SimplificationFeatures, a_crease_angle_of_180_makes_none) {
  const TriangleMesh mesh = cylinder();
  const auto with = simplified(mesh, {100, kNoLimit, 180}), without = simplified(mesh, {100});
  EXPECT_EQ(with->mesh.points(), without->mesh.points());
  EXPECT_EQ(with->mesh.origins(), without->mesh.origins());
}

TEST(SimplificationFeatures, sources_of_the_elements) {
  for (const SimplificationTarget& target : {SimplificationTarget{200}, {0, 0.01}, {100'000}, {300, kNoLimit, 30}}) {
    const TriangleMesh mesh = cylinder();
    const auto result = simplified(mesh, target);
    ASSERT_EQ(result->faces.size(), result->mesh.face_count());
    ASSERT_EQ(result->vertices.size(), result->mesh.vertex_count());
    EXPECT_TRUE(std::ranges::is_sorted(result->faces));
    // Vertices that have not moved are found again, and such corners are corners of the same face before.
    std::size_t same = 0;
    for (std::size_t f = 0; f < result->faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = result->mesh.triangle(FaceId(f))[i];
        const std::uint32_t before = mesh.triangle(FaceId(result->faces[f]))[i];
        if (result->vertices[v] != before) continue;
        ++same;
        const bool is_there = result->mesh.points().approx()[v] == mesh.points().approx()[before];
        EXPECT_TRUE(is_there || target.crease_degrees == 180);
      }
    EXPECT_GT(same, 50U);
    for (std::size_t v = 0; v < result->vertices.size(); ++v) {
      const Vec3 p = result->mesh.points().approx()[v], q = mesh.points().approx()[result->vertices[v]];
      EXPECT_LT(length(p - q), 1.0);
    }
  }
}

}  // namespace
}  // namespace algebra3d
