#include "algebra3d/kernel/rounding/detail/narrow_gaps.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"
#include "algebra3d/kernel/validity/validity.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

std::optional<ClosedGaps> closed_gaps(const TriangleMesh& solid, double spacing) {
  return *with_closed_gaps(solid, rounded_vertices(solid, CoordinateGrid::multiples(spacing)), spacing, {});
}

/// A prism between two rings of corners; both caps are fans from the same corner.
TriangleMesh prism(const std::vector<Vec3>& bottom, const std::vector<Vec3>& top, std::uint32_t fan) {
  const auto n = static_cast<std::uint32_t>(bottom.size());
  std::vector<Vec3> points(bottom);
  points.insert(points.end(), top.begin(), top.end());
  std::vector<IndexTriangle> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    triangles.push_back({i, next, n + next});
    triangles.push_back({i, n + next, n + i});
    if (i == fan || next == fan) continue;
    triangles.push_back({fan, next, i});
    triangles.push_back({n + fan, n + i, n + next});
  }
  return {PointArray(std::move(points)), triangles};
}

/// Two bars that were joined at a mitre, turned, their coordinates rounded to decimals, and perhaps drawn apart. Their
/// caps there are divided differently, and bent by noise, so that they overlap in places and gape in others.
struct Mitre {
  TriangleMesh first, second;
  std::size_t corners;

  explicit Mitre(Chance& chance) : corners(static_cast<std::size_t>(chance.between(3, 12))) {
    const double slope = 0.4 + 0.3 * chance.unit();
    const std::array<double, 4> gaps{0, 0, 1e-9, 2e-7};
    const double gap = gaps[static_cast<std::size_t>(chance.below(4))];
    const AffineMap turn = *AffineMap::rotation({}, RationalVec3(chance.direction()), 180 * chance.unit());
    const auto written = [&](const Vec3& p) {
      const Vec3 turned = turn.apply_rounded(ExactPoint(p));
      const auto decimals = [](double x) { return std::round(x * 1e10) / 1e10; };
      return Vec3{decimals(turned.x), decimals(turned.y), decimals(turned.z)};
    };
    std::vector<Vec3> start, mitre, other_mitre, end;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
      const double y = 2 * std::cos(angle), z = 2 * std::sin(angle), x = 10 - slope * y;
      const double length = std::hypot(1, slope);
      const Vec3 normal{1 / length, slope / length, 0};
      const Vec3 far = Vec3{0, y, z} + (20 / length) * normal;  // its mirror image: (10, 0, 0) stays
      start.push_back(written({0, y, z}));
      mitre.push_back(written({x, y, z}));
      other_mitre.push_back(written(Vec3{x, y, z} + gap * normal));
      end.push_back(written(far - (2 * slope * y / length) * normal + gap * normal));
    }
    first = prism(start, mitre, 0);
    second = prism(other_mitre, end, static_cast<std::uint32_t>(corners / 2));
  }
};

/// Whether it is the bar without anything inside.
bool is_one_body(const TriangleMesh& mesh, std::size_t corners) {
  std::size_t at_edges = 0;
  for (const HalfedgeId h : halfedges(mesh)) at_edges += mesh.is_nonmanifold(h) ? 1 : 0;
  return mesh.vertex_count() == 3 * corners && connected_components(mesh).count == 1 && at_edges == 0;
}

// Some keep a gap: where the rims cross each other there are ledges between them that are no walls of it.
TEST(NarrowGaps, of_mitred_bars_are_closed) {
  Chance chance(1);
  SetOperations engine;
  const std::size_t count = rounds(40U);
  std::size_t closed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Mitre mitre(chance);
    ASSERT_EQ(prove_volume(mitre.first)->text(), "");
    const TriangleMesh both = engine.unite(mitre.first, mitre.second);
    for (const double step : {1e-6, 1e-3}) {
      const auto rounded = rounded_solid(both, CoordinateGrid::multiples(step));
      ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
      EXPECT_EQ(prove_volume(*rounded->mesh)->text(), "");
      const double change = exact_volume_of(*rounded->mesh).nearest_double() - exact_volume_of(both).nearest_double();
      EXPECT_LT(std::abs(change), 400 * step);
      if (is_one_body(*rounded->mesh, mitre.corners)) ++closed;
    }
  }
  EXPECT_EQ(engine.complaints(), "");
  EXPECT_GE(closed, 2 * count - count / 25);
}

TEST(NarrowGaps, are_pockets_and_slits) {
  SetOperations engine;
  const TriangleMesh cube = box({0, 0, 0}, {4, 4, 4});
  const TriangleMesh pocket = engine.subtract(cube, box({1, 1, 1}, {3, 3, 1.25}));
  const TriangleMesh slit = engine.unite(cube, box({4.25, 0, 0}, {8, 4, 4}));
  const TriangleMesh saw_cut = engine.subtract(cube, box({-1, -1, 2}, {2, 5, 2.25}));
  for (const TriangleMesh* solid : {&pocket, &slit}) {
    const auto closed = closed_gaps(*solid, 1);
    ASSERT_TRUE(closed);
    EXPECT_EQ(closed->count, 1U);
    EXPECT_FALSE(closed_gaps(*solid, 0.125));
  }
  for (const TriangleMesh* solid : {&pocket, &slit, &saw_cut}) {
    const auto rounded = rounded_solid(*solid, CoordinateGrid::multiples(1));
    ASSERT_TRUE(rounded.ok() && rounded->mesh);
    EXPECT_EQ(exact_volume_of(*rounded->mesh), Rational(solid == &slit ? 128 : 64));
  }
}

TEST(NarrowGaps, are_not_plates_and_not_what_has_a_wall_in_part) {
  SetOperations engine;
  EXPECT_FALSE(closed_gaps(box({0, 0, 0}, {4, 4, 0.25}), 1));
  const TriangleMesh table = engine.unite(box({0, 0, 0}, {8, 8, 4}), box({2, 2, 4.25}, {6, 6, 8}));
  EXPECT_FALSE(closed_gaps(table, 1));
  const TriangleMesh wide = engine.unite(box({0, 0, 0}, {4, 4, 4}), box({6, 0, 0}, {8, 4, 4}));
  EXPECT_FALSE(closed_gaps(wide, 1));
}

}  // namespace
}  // namespace algebra3d::solids
