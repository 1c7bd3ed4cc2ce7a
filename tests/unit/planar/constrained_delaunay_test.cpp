#include "algebra3d/kernel/planar/constrained_delaunay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "support/rounds.h"
#include "unit/planar/checks.h"

namespace algebra3d {
namespace {

using namespace plane_shapes;
using plane_checks::check;

std::mt19937_64 numbers(std::uint64_t seed) {
  return std::mt19937_64(seed);  // NOLINT(cert-msc51-cpp): the same in every run
}

Polygons mapped(const Polygons& polygons, const std::function<ExactPoint(const Vec3&)>& map) {
  Polygons result = polygons;
  result.corners = {};
  for (const Vec3& corner : polygons.corners.approx()) result.corners.push_back(map(corner));
  return result;
}

struct Named {
  const char* name;
  Polygons polygons;
};

std::vector<Named> families() {
  auto random = numbers(1);
  std::vector<Named> result;
  const auto add = [&](const char* name, const std::vector<Face>& faces) {
    result.push_back({name, polygons_of(faces)});
  };
  add("nothing", {});
  add("triangle", {{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}}});
  add("clockwise square", {{reversed(box(0, 0, 2, 2))}});
  add("collinear corners",
      {{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {3, 3, 0}, {2, 2, 0}, {1, 1, 0}}}});
  add("star", {{star(300, 0.05, 1, random)}});
  add("rings", rings(6, 100, random));
  add("snowflake", {{snowflake(5)}});
  add("maze", {{maze(20, random)}});
  add("shaken maze", {{shaken(maze(20, random), 0.24, random)}});
  add("comb", {{comb(60, 1000)}});
  add("flat comb", {{comb(60, 0.001)}});
  add("needle", {{{{0, 0, 0}, {1000, 1, 0}, {1000, std::nextafter(1, 2), 0}}}});
  add("square with holes",
      {{box(0, 0, 9, 9), box(1, 1, 2, 2), reversed(box(3, 3, 5, 5)), box(6, 1, 8, 8)}, {box(3.5, 3.5, 4.5, 4.5)}});
  add("holes that touch the outer cycle and each other", {{box(0, 0, 8, 8),
                                                           {{0, 4, 0}, {2, 3, 0}, {2, 5, 0}},
                                                           {{2, 3, 0}, {4, 2, 0}, {4, 4, 0}},
                                                           {{4, 4, 0}, {6, 3, 0}, {6, 5, 0}},
                                                           {{8, 8, 0}, {6, 7, 0}, {7, 6, 0}}}});
  add("holes that part the face",
      {{box(0, 0, 8, 8), {{0, 4, 0}, {4, 3, 0}, {4, 5, 0}}, {{4, 4, 0}, {6, 3, 0}, {8, 4, 0}, {6, 5, 0}}}});
  add("faces that share corners and touch",
      {{box(0, 0, 2, 2)}, {box(2, 2, 4, 4)}, {{{4, 3, 0}, {6, 2, 0}, {6, 4, 0}}}, {{{2, 2, 0}, {3, 0, 0}, {4, 1, 0}}}});
  return result;
}

/// Corners of a circle of radius 65 with integer coordinates, beside the maze.
Cycle circle_of_integers() {
  Cycle cycle;
  const std::vector<std::pair<double, double>> first{{65, 0},  {63, 16}, {60, 25}, {56, 33}, {52, 39},
                                                     {39, 52}, {33, 56}, {25, 60}, {16, 63}};
  for (int turn = 0; turn < 4; ++turn)
    for (const auto& [x, y] : first)
      cycle.push_back(turn == 0   ? Vec3{x, y, 0}
                      : turn == 1 ? Vec3{-y, x, 0}
                      : turn == 2 ? Vec3{-x, -y, 0}
                                  : Vec3{y, -x, 0});
  for (Vec3& p : cycle) p.x += 100;
  return cycle;
}

TEST(ConstrainedDelaunay, each_family_is_right_in_every_respect) {
  for (const Named& family : families()) {
    SCOPED_TRACE(family.name);
    check(family.polygons);
  }
}

TEST(ConstrainedDelaunay, scaled_by_any_power_of_two) {
  for (const Named& family : families()) {
    if (family.polygons.corners.size() > 300) continue;
    SCOPED_TRACE(family.name);
    for (const double scale : {0x1p-30, 0x1p-300, 0x1p-1000, 0x1p1000})
      check(mapped(family.polygons, [scale](const Vec3& p) { return ExactPoint(scale * p); }));
  }
}

/// Far from the origin, where corners are left with few bits: half, so that some lie one unit in the last place apart.
TEST(ConstrainedDelaunay, moved_far_away) {
  auto random = numbers(5);
  const Polygons polygons = polygons_of({{maze(15, random)}, {circle_of_integers()}});
  for (const double shift : {1e9, 0x1p51 - 100}) {
    check(mapped(polygons, [shift](const Vec3& p) { return ExactPoint(p + Vec3{shift, -shift, 0}); }));
    check(mapped(polygons, [shift](const Vec3& p) { return ExactPoint(0.5 * p + Vec3{shift, shift, 0}); }));
  }
}

TEST(ConstrainedDelaunay, of_rationals) {
  for (const Named& family : families()) {
    if (family.polygons.corners.size() > 500) continue;
    SCOPED_TRACE(family.name);
    check(mapped(family.polygons, [](const Vec3& p) {
      const RationalVec3 exact(p);
      return ExactPoint(RationalVec3(exact.x / Rational(3), (exact.y + exact.x) / Rational(7), Rational()));
    }));
  }
}

TEST(ConstrainedDelaunay, refuses_what_bounds_no_region) {
  const PointArray points({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  const auto message = [&](const std::vector<DirectedEdge>& edges) {
    const auto result = constrained_delaunay(points, edges);
    return result.ok() ? "" : result.error().message;
  };
  EXPECT_EQ(message({{0, 1}, {1, 2}, {2, 3}, {3, 0}}), "");
  EXPECT_EQ(message({{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {2, 0}}), "");
  EXPECT_EQ(message({{0, 2}, {1, 3}}), "segment (2 0)-(0 2) crosses segment (0 0)-(2 2)");
  EXPECT_EQ(message({{0, 1}, {1, 2}, {2, 0}, {0, 1}}), "segment (0 0)-(2 0) overlaps segment (0 0)-(2 0)");
  EXPECT_EQ(message({{1, 0}, {0, 3}, {3, 2}, {2, 1}}),
            "the segments bound no region: the inside meets the outside at (2 0)-(0 0)");
  EXPECT_NE(message({{0, 1}, {1, 2}, {2, 3}}), "");
}

TEST(ConstrainedDelaunay, can_be_interrupted) {
  auto random = numbers(2);
  const std::atomic<bool> cancel{true};
  const auto result = triangulate(polygons_of({{star(5000, 0.1, 1, random)}}), Monitor(&cancel));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::interrupted);
}

TEST(ConstrainedDelaunay, depends_on_points_and_edges_alone) {
  auto random = numbers(3);
  const Polygons polygons = polygons_of({{maze(12, random)}});
  std::vector<DirectedEdge> edges = plane_checks::edges_of(polygons);
  const auto expected = constrained_delaunay(polygons.corners, edges);
  ASSERT_TRUE(expected.ok());
  for (int i = 0; i < 5; ++i) {
    std::shuffle(edges.begin(), edges.end(), random);
    const auto result = constrained_delaunay(polygons.corners, edges);
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(*result, *expected);
  }
}

/// Every long edge is crossed by the edges between the teeth on both its sides.
TEST(ConstrainedDelaunay, long_edges_between_teeth) {
  auto random = numbers(6);
  const auto saw = [&](double side) {
    Cycle cycle{{0, side * 1e-6, 0}, {300, side * 1e-6, 0}};
    for (int x = 299; x > 0; --x)
      cycle.push_back({x + 0.0, side * std::uniform_real_distribution<double>(1e-3, 2e-3)(random), 0});
    return cycle;
  };
  check(polygons_of({{saw(1)}, {saw(-1)}}));
}

/// Constraints among few points: what a line opens often has edges that jut out into it, or vertices on the line.
TEST(ConstrainedDelaunay, random_segments_among_points) {
  auto random = numbers(7);
  for (int round = 0; round < rounds(50); ++round) {
    std::vector<Vec3> places;
    std::vector<DirectedEdge> edges;
    const bool is_grid = round % 2 == 0;
    const auto coordinate = [&] {
      return is_grid ? static_cast<double>(random() % 10) : std::uniform_real_distribution<double>(0, 10)(random);
    };
    for (int i = 0; i < 40; ++i) places.push_back({coordinate(), coordinate(), 0});
    for (const Vec3& corner : box(-1, -1, 11, 11)) places.push_back(corner);
    const PointArray points(places);
    for (std::uint32_t i = 0; i < 4; ++i) edges.emplace_back(40 + i, 40 + (i + 1) % 4);
    // Each of the others is given in both directions, as a slit; those that cross or overlap one before are left out.
    for (std::uint32_t i = 0; i < 60; ++i) {
      const auto from = static_cast<std::uint32_t>(random() % 40), to = static_cast<std::uint32_t>(random() % 40);
      std::vector<DirectedEdge> more = edges;
      more.insert(more.end(), {{from, to}, {to, from}});
      if (constrained_delaunay(points, more).ok()) edges = more;
    }
    const auto result = constrained_delaunay(points, edges);
    ASSERT_TRUE(result.ok());
    ASSERT_EQ(plane_checks::slit_findings(points, edges, *result), "") << "round " << round;
  }
}

TEST(ConstrainedDelaunay, large_fractals) {
  auto random = numbers(4);
  check(polygons_of({{snowflake(6)}}));
  check(polygons_of({{shaken(maze(60, random), 0.24, random)}}));
}

// A snowflake with a hole of the same shape, and an island in that.
// A hundred thousand, or a quarter of them.
TEST(ConstrainedDelaunay, many_corners) {
  const Vec3 middle{0.5, std::sqrt(3.0) / 6, 0};
  const auto shrunk = [&](int depth, double factor) {
    return shifted(scaled(snowflake(depth), factor), (1 - factor) * middle.x, (1 - factor) * middle.y);
  };
  const int depth = is_thorough() ? 7 : 6;
  const Polygons polygons = polygons_of({{snowflake(depth), shrunk(depth, 0.5)}, {shrunk(depth - 2, 0.25)}});
  EXPECT_GT(polygons.corners.size(), is_thorough() ? 100'000U : 25'000U);
  check(polygons);
}

}  // namespace
}  // namespace algebra3d
