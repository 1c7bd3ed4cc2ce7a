#include "algebra3d/kernel/validity/detail/simple_boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace algebra3d {
namespace {

using Cycle = std::vector<Vec3>;
using Corners = std::array<Vec3, 3>;

std::vector<PlanarEdge> edges_of(const std::vector<Cycle>& cycles) {
  std::vector<PlanarEdge> edges;
  for (const Cycle& cycle : cycles)
    for (std::size_t i = 0; i < cycle.size(); ++i) edges.push_back({cycle[i], cycle[(i + 1) % cycle.size()]});
  return edges;
}

Cycle square(double x, double y, double size) {
  return {{x, y, 0}, {x + size, y, 0}, {x + size, y + size, 0}, {x, y + size, 0}};
}

Cycle reversed(Cycle cycle) {
  std::ranges::reverse(cycle);
  return cycle;
}

bool is_simple(const std::vector<Cycle>& cycles) {
  return bounds_simple_region(edges_of(cycles));
}

TEST(simple_boundary, has_the_region_to_its_left) {
  EXPECT_TRUE(is_simple({square(0, 0, 2)}));
  EXPECT_FALSE(is_simple({reversed(square(0, 0, 2))}));
  EXPECT_TRUE(bounds_simple_region({}));
}

TEST(simple_boundary, may_have_holes_and_parts_but_covers_nothing_twice) {
  EXPECT_TRUE(is_simple({square(0, 0, 9), reversed(square(1, 1, 7))}));
  EXPECT_TRUE(is_simple({square(0, 0, 9), reversed(square(1, 1, 7)), square(2, 2, 5), square(20, 1, 1)}));
  EXPECT_FALSE(is_simple({square(0, 0, 9), square(1, 1, 7)}));
  EXPECT_FALSE(is_simple({square(0, 0, 9), square(0, 0, 9)}));
}

TEST(simple_boundary, does_not_cross_or_overlap_itself) {
  EXPECT_FALSE(is_simple({{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}}));
  EXPECT_FALSE(is_simple({square(0, 0, 4), square(3, 1, 4)}));
  EXPECT_FALSE(is_simple({square(0, 0, 4), square(4, 0, 4)}));  // a common edge, run along in both directions
  EXPECT_FALSE(is_simple({square(0, 0, 4), square(4, 1, 2)}));  // a part of an edge
}

TEST(simple_boundary, touches_itself_in_common_end_points_only) {
  EXPECT_TRUE(is_simple({square(0, 0, 2), square(2, 2, 1), square(-1, 2, 1)}));
  EXPECT_TRUE(is_simple({square(0, 0, 4), {{0, 0, 0}, {1, 2, 0}, {2, 1, 0}}}));
  EXPECT_FALSE(is_simple({square(0, 0, 4), {{4, 2, 0}, {5, 1, 0}, {5, 3, 0}}}));
  EXPECT_FALSE(is_simple({square(0, 0, 4), {{2, 4, 0}, {1, 5, 0}, {3, 5, 0}}}));
}

TEST(simple_boundary, is_decided_exactly) {
  // The middle corner lies on the line between its neighbours, or off it by one unit in the last place.
  const Vec3 low{0.1, 0.1, 0}, high{0.3, 0.3, 0};
  const auto with_corner_near_diagonal = [&](double y) {
    return std::vector<Cycle>{{low, {0.3, 0.1, 0}, high}, {low, {0.2, y, 0}, {0, 0.3, 0}}};
  };
  EXPECT_FALSE(is_simple(with_corner_near_diagonal(0.2)));
  EXPECT_TRUE(is_simple(with_corner_near_diagonal(std::nextafter(0.2, 1.0))));
  EXPECT_FALSE(is_simple(with_corner_near_diagonal(std::nextafter(0.2, 0.0))));
}

// ---- all pairs of small integers ------------------------------------------------------------------------------------

double turn(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_on(const PlanarEdge& edge, const Vec3& p) {
  const auto [low_x, high_x] = std::minmax(edge.from.x, edge.to.x);
  const auto [low_y, high_y] = std::minmax(edge.from.y, edge.to.y);
  return turn(edge.from, edge.to, p) == 0 && low_x <= p.x && p.x <= high_x && low_y <= p.y && p.y <= high_y;
}

bool is_end(const PlanarEdge& edge, const Vec3& p) {
  return p == edge.from || p == edge.to;
}

/// True if two edges have at most end points of both in common.
bool get_along(const PlanarEdge& a, const PlanarEdge& b) {
  for (const Vec3& p : {a.from, a.to})
    if (is_on(b, p) && !is_end(b, p)) return false;
  for (const Vec3& p : {b.from, b.to})
    if (is_on(a, p) && !is_end(a, p)) return false;
  if (is_end(a, b.from) && is_end(a, b.to)) return false;
  return !(turn(a.from, a.to, b.from) * turn(a.from, a.to, b.to) < 0 &&
           turn(b.from, b.to, a.from) * turn(b.from, b.to, a.to) < 0);
}

/// True if the middle of one triangle, times three, lies within the other.
bool is_within(const Corners& inner, const Corners& outer) {
  const Vec3 middle = inner[0] + inner[1] + inner[2];
  for (std::size_t i = 0; i < 3; ++i)
    if (turn(3 * outer[i], 3 * outer[(i + 1) % 3], middle) <= 0) return false;
  return true;
}

TEST(simple_boundary, is_what_all_pairs_say_of_random_triangles) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same cases in every run
  int simple_count = 0;
  for (int round = 0; round < 20000; ++round) {
    const auto coordinate = [&] { return static_cast<double>(random() % 7); };
    std::vector<Corners> triangles;
    const std::size_t count = 2 + random() % 3;
    while (triangles.size() < count) {
      const Corners t{Vec3{coordinate(), coordinate(), 0}, Vec3{coordinate(), coordinate(), 0},
                      Vec3{coordinate(), coordinate(), 0}};
      if (turn(t[0], t[1], t[2]) > 0) triangles.push_back(t);
    }
    std::vector<Cycle> cycles;
    for (const Corners& t : triangles) cycles.emplace_back(t.begin(), t.end());
    const std::vector<PlanarEdge> edges = edges_of(cycles);
    bool expected = true;
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) expected = expected && get_along(edges[i], edges[j]);
    for (const Corners& a : triangles)
      for (const Corners& b : triangles) expected = expected && (&a == &b || !is_within(a, b));
    EXPECT_EQ(bounds_simple_region(edges), expected) << "round " << round;
    simple_count += expected ? 1 : 0;
  }
  EXPECT_GT(simple_count, 100);
}

}  // namespace
}  // namespace algebra3d
