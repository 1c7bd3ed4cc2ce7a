// Regions of a plane, triangulated: the triangles have to tile the regions without gap or overlap (they turn left,
// their areas add up, each edge has its two sides), and there may be no more than the formula n + 2h - 2 allows.
#include "algebra3d/kernel/planar/sweep_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <string>

namespace algebra3d {
namespace {

using Triangle = IndexTriangle;
using Grid = std::array<std::int64_t, 2>;

/// Turns left if positive: twice the area.
std::int64_t doubled_area(const Grid& a, const Grid& b, const Grid& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Points of a sloping plane that a projection shows at integer places, divided by `divisor`.
class Plane {
 public:
  Plane(Projection projection, std::int64_t divisor) : projection_(projection), divisor_(divisor) {}

  std::uint32_t add(const Grid& place) {
    places_.push_back(place);
    std::array<Rational, 3> p;
    const std::size_t first = first_axis(projection_), second = second_axis(projection_);
    p[first] = Rational(place[0], divisor_);
    p[second] = Rational(place[1], divisor_);
    p[3 - first - second] = Rational(3 * place[0] - 2 * place[1] + 7, divisor_);
    return pool_.intern(ExactPoint(RationalVec3(p[0], p[1], p[2])));
  }

  std::vector<Triangle> triangulated(const std::vector<DirectedEdge>& edges) const {
    std::vector<Triangle> triangles;
    EXPECT_TRUE(triangulate_by_sweep(pool_, projection_, edges, triangles));
    return triangles;
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(places_.size()); }
  const Grid& place(std::uint32_t vertex) const { return places_[vertex]; }
  bool are_on_a_line(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return doubled_area(places_[a], places_[b], places_[c]) == 0;
  }

  /// What is wrong with the triangles; empty if nothing is.
  std::string findings(const std::vector<DirectedEdge>& edges, const std::vector<Triangle>& triangles,
                       std::int64_t expected_doubled_area) const {
    std::string findings;
    std::set<std::uint32_t> ends;
    for (const auto& [from, to] : edges) ends.insert({from, to});
    std::set<DirectedEdge> sides;
    std::int64_t area = 0;
    for (const Triangle& t : triangles) {
      const std::int64_t part = doubled_area(places_[t[0]], places_[t[1]], places_[t[2]]);
      if (part <= 0) findings += "a triangle does not turn left\n";
      area += part;
      for (std::size_t i = 0; i < 3; ++i) {
        if (!ends.contains(t[i])) findings += "a corner is not an end of an edge\n";
        if (!sides.emplace(t[i], t[(i + 1) % 3]).second) findings += "a side has two triangles\n";
      }
    }
    if (area != expected_doubled_area) findings += "the areas do not add up\n";
    for (const DirectedEdge& edge : edges)
      if (!sides.contains(edge)) findings += "an edge is not among the sides\n";
    const std::set<DirectedEdge> given(edges.begin(), edges.end());
    for (const auto& [from, to] : sides)
      if (!given.contains({from, to}) && !sides.contains({to, from})) findings += "an inner side has no other\n";
    return findings;
  }

 private:
  Projection projection_;
  std::int64_t divisor_;
  PointTable pool_;
  std::vector<Grid> places_;
};

/// Regions made of triangles of a grid, chosen at random; so they have holes, touch themselves and each other in
/// vertices, and have corners on straight edges. Some edges between chosen triangles are slits.
class RandomRegions {
 public:
  using Random = std::mt19937;

  RandomRegions(Plane& plane, Random& random, int columns, int rows, double cell_share, double slit_share)
      : plane_(plane), random_(random) {
    make_vertices(columns, rows);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        add_cell(static_cast<std::uint32_t>(i + j * (columns + 1)), static_cast<std::uint32_t>(columns + 1),
                 cell_share);
    choose_edges(slit_share);
    count_inner_vertices();
  }

  /// Leads straight edges past corners, each with the probability, where the region on their left is half a disc; other
  /// edges that end there then touch them from outside.
  void straighten(double share) {
    std::map<std::uint32_t, std::set<std::uint32_t>> outgoing, incoming;
    for (const auto& [from, to] : edges_) {
      outgoing[from].insert(to);
      incoming[to].insert(from);
    }
    for (std::uint32_t vertex = 0; vertex < plane_.size(); ++vertex) {
      const std::set<std::uint32_t> sources = incoming[vertex], targets = outgoing[vertex];
      std::set<std::uint32_t> ends = targets;
      ends.insert(sources.begin(), sources.end());
      const auto pass = [&](std::uint32_t source, std::uint32_t target) {
        --triangle_count_;  // half a turn
        outgoing[source].erase(vertex);
        outgoing[source].insert(target);
        incoming[target].erase(vertex);
        incoming[target].insert(source);
        incoming[vertex].erase(source);
        outgoing[vertex].erase(target);
      };
      for (const std::uint32_t source : sources)
        for (const std::uint32_t target : targets) {
          if (!incoming[vertex].contains(source) || !is_straight(source, vertex, target)) continue;
          const bool is_slit = targets.contains(source) || sources.contains(target);
          if (is_slit && !(targets.contains(source) && sources.contains(target))) continue;
          if (has_end_on_left(source, vertex, ends) || (is_slit && has_end_on_left(target, vertex, ends))) continue;
          if (!is_chosen(share)) continue;
          pass(source, target);
          if (is_slit) pass(target, source);
        }
    }
    edges_.clear();
    for (const auto& [from, targets] : outgoing)
      for (const std::uint32_t to : targets) edges_.emplace_back(from, to);
  }

  std::vector<DirectedEdge>& edges() { return edges_; }
  /// By the sum of angles: each triangle has half a turn; a vertex that is left out had a whole turn or half a one.
  std::size_t triangle_count() const { return triangle_count_; }
  std::int64_t area() const { return area_; }

 private:
  bool is_straight(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Grid &p = plane_.place(a), &q = plane_.place(b), &r = plane_.place(c);
    return a != c && plane_.are_on_a_line(a, b, c) && (p < q) == (q < r);
  }
  bool has_end_on_left(std::uint32_t from, std::uint32_t vertex, const std::set<std::uint32_t>& ends) const {
    return std::ranges::any_of(ends, [&](std::uint32_t end) {
      return doubled_area(plane_.place(from), plane_.place(vertex), plane_.place(end)) > 0;
    });
  }
  bool is_chosen(double share) { return static_cast<double>(random_() % 1000) < 1000 * share; }

  void make_vertices(int columns, int rows) {
    const auto kind = random_() % 3;
    for (std::int64_t j = 0; j <= rows; ++j) {
      for (std::int64_t i = 0; i <= columns; ++i) {
        const auto jitter = [&] { return static_cast<std::int64_t>(random_() % 5) - 2; };
        if (kind == 0) plane_.add({i, j});
        if (kind == 1) plane_.add({2 * i - j, i + 3 * j});
        if (kind == 2) {
          const std::int64_t x = 12 * i + jitter();
          plane_.add({x, 12 * j + jitter()});
        }
      }
    }
  }

  /// A square with its lower left corner at the vertex, in two triangles.
  void add_cell(std::uint32_t corner, std::uint32_t row, double share) {
    const std::uint32_t a = corner, b = corner + 1, c = corner + 1 + row, d = corner + row;
    const bool is_rising = random_() % 2 == 0;
    for (const Triangle& t :
         {is_rising ? Triangle{a, b, c} : Triangle{a, b, d}, is_rising ? Triangle{a, c, d} : Triangle{b, c, d}}) {
      if (is_chosen(share)) cells_.push_back(t);
    }
  }

  void choose_edges(double slit_share) {
    std::set<DirectedEdge> sides;
    for (const Triangle& t : cells_) {
      area_ += doubled_area(plane_.place(t[0]), plane_.place(t[1]), plane_.place(t[2]));
      for (std::size_t i = 0; i < 3; ++i) sides.emplace(t[i], t[(i + 1) % 3]);
    }
    for (const auto& [from, to] : sides) {
      if (!sides.contains({to, from})) {
        edges_.emplace_back(from, to);
      } else if (from < to && is_chosen(slit_share)) {
        edges_.emplace_back(from, to);
        edges_.emplace_back(to, from);
      }
    }
  }

  void count_inner_vertices() {
    std::set<std::uint32_t> inner;
    for (const Triangle& t : cells_) inner.insert(t.begin(), t.end());
    for (const auto& [from, to] : edges_) {
      inner.erase(from);
      inner.erase(to);
    }
    triangle_count_ = cells_.size() - 2 * inner.size();
  }

  Plane& plane_;
  Random& random_;
  std::vector<Triangle> cells_;
  std::vector<DirectedEdge> edges_;
  std::size_t triangle_count_ = 0;
  std::int64_t area_ = 0;
};

constexpr std::array kProjections{Projection::yz, Projection::zx, Projection::xy};

void check(Plane& plane, RandomRegions& regions, std::mt19937& random) {
  const auto triangles = plane.triangulated(regions.edges());
  ASSERT_EQ(plane.findings(regions.edges(), triangles, regions.area()), "");
  ASSERT_EQ(triangles.size(), regions.triangle_count());
  std::shuffle(regions.edges().begin(), regions.edges().end(), random);
  ASSERT_EQ(plane.triangulated(regions.edges()), triangles) << "in another order of the edges";
}

TEST(Triangulation, tiles_random_regions_with_as_few_triangles_as_possible) {
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
  constexpr std::array kCellShares{0.3, 0.5, 0.7, 0.9, 1.0};
  constexpr std::array kSlitShares{0.0, 0.1, 0.4, 1.0};
  for (int round = 0; round < 3000; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    Plane plane(kProjections[random() % 3], random() % 4 == 0 ? 7 : 1);
    const int columns = 1 + static_cast<int>(random() % 7), rows = 1 + static_cast<int>(random() % 7);
    const double cells = kCellShares[random() % kCellShares.size()], slits = kSlitShares[random() % kSlitShares.size()];
    RandomRegions regions(plane, random, columns, rows, cells, slits);
    regions.straighten(static_cast<double>(random() % 3) / 2);
    check(plane, regions, random);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Triangulation, tiles_large_regions) {
  std::mt19937 random(2);  // NOLINT(cert-msc51-cpp): the same in every run
  for (const double cells : {0.5, 0.8, 0.99}) {
    Plane plane(Projection::zx, 1);
    RandomRegions regions(plane, random, 120, 120, cells, 0.05);
    regions.straighten(1);
    check(plane, regions, random);
  }
}

/// Boundaries, each with what it bounds to the left.
std::vector<DirectedEdge> loops(Plane& plane, const std::vector<std::vector<Grid>>& boundaries) {
  std::map<Grid, std::uint32_t> numbers;
  const auto number = [&](const Grid& place) {
    const auto [at, is_new] = numbers.try_emplace(place, 0);
    if (is_new) at->second = plane.add(place);
    return at->second;
  };
  std::vector<DirectedEdge> edges;
  for (const auto& boundary : boundaries)
    for (std::size_t i = 0; i < boundary.size(); ++i)
      edges.emplace_back(number(boundary[i]), number(boundary[(i + 1) % boundary.size()]));
  return edges;
}

struct Shape {
  const char* name;
  std::vector<std::vector<Grid>> boundaries;
  std::size_t triangle_count;
  std::int64_t doubled_area;
};

TEST(Triangulation, gives_n_plus_2h_minus_2_triangles) {
  const std::vector<Grid> square{{0, 0}, {8, 0}, {8, 8}, {0, 8}};
  const std::vector<Shape> shapes{
      {"triangle", {{{0, 0}, {2, 1}, {1, 2}}}, 1, 3},
      {"square", {square}, 2, 128},
      {"square with corners on its edges", {{{0, 0}, {4, 0}, {8, 0}, {8, 4}, {8, 8}, {4, 8}, {0, 8}, {0, 4}}}, 6, 128},
      {"square with a hole", {square, {{2, 2}, {2, 6}, {6, 6}, {6, 2}}}, 8, 128 - 32},
      {"hole that touches the boundary", {square, {{0, 0}, {2, 6}, {6, 2}}}, 5, 128 - 32},
      {"two holes that touch",
       {square, {{1, 1}, {2, 4}, {4, 4}}, {{4, 4}, {6, 7}, {7, 6}}},
       4 + 3 + 3 + 2 - 2,
       128 - 6 - 5},
      {"ring within a ring",
       {square, {{1, 1}, {1, 7}, {7, 7}, {7, 1}}, {{2, 2}, {6, 2}, {6, 6}, {2, 6}}, {{3, 3}, {3, 5}, {5, 5}, {5, 3}}},
       16,
       128 - 72 + 32 - 8},
      {"slit", {square, {{2, 4}, {6, 4}}}, 6, 128},
      {"slit of two edges, bent", {square, {{2, 4}, {4, 4}, {6, 6}, {4, 4}}}, 8, 128},
      {"slit from a corner", {square, {{0, 0}, {3, 4}}}, 4, 128},
      {"slit from corner to corner", {square, {{0, 0}, {8, 8}}}, 2, 128},
      {"slits crossing in a vertex",
       {square, {{4, 4}, {6, 4}}, {{4, 4}, {2, 4}}, {{4, 4}, {4, 6}}, {{4, 4}, {4, 2}}},
       12,
       128},
      {"a wall round a place within",
       {square, {{2, 2}, {6, 2}, {6, 6}, {2, 6}}, {{2, 2}, {2, 6}, {6, 6}, {6, 2}}},
       10,
       128},
      {"two squares that touch in a corner", {square, {{8, 8}, {9, 8}, {9, 9}, {8, 9}}}, 4, 130},
      {"two squares with a common edge", {square, {{8, 0}, {16, 0}, {16, 8}, {8, 8}}}, 4, 256},
      {"comb",
       {{{0, 0}, {6, 0}, {6, 5}, {5, 5}, {5, 1}, {4, 1}, {4, 5}, {3, 5}, {3, 1}, {2, 1}, {2, 5}, {0, 5}}},
       10,
       60 - 16},
      {"star", {{{0, 3}, {-1, 1}, {-3, 0}, {-1, -1}, {0, -3}, {1, -1}, {3, 0}, {1, 1}}}, 6, 24},
      {"a corner on the edge of another", {square, {{8, 4}, {10, 3}, {10, 5}}}, 3, 128 + 4},
      {"two corners on one edge", {square, {{4, 8}, {3, 10}, {2, 10}}, {{4, 8}, {6, 10}, {5, 10}}}, 4, 128 + 2 + 2},
      {"corners on two edges",
       {{{0, 0}, {8, 0}, {4, 4}}, {{3, 3}, {1, 7}, {1, 5}}, {{4, 0}, {3, -2}, {5, -2}}},
       3,
       32 + 4 + 4},
      {"a tooth that touches the region's own edge",
       {{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 6}, {6, 6}, {6, 2}, {5, 2}, {6, 4}, {4, 2}, {0, 2}}},
       9,
       82},
      {"nothing", {}, 0, 0},
  };
  for (const Shape& shape : shapes) {
    for (const Projection projection : kProjections) {
      SCOPED_TRACE(shape.name);
      Plane plane(projection, 1);
      const auto edges = loops(plane, shape.boundaries);
      const auto triangles = plane.triangulated(edges);
      EXPECT_EQ(plane.findings(edges, triangles, shape.doubled_area), "");
      EXPECT_EQ(triangles.size(), shape.triangle_count);
    }
  }
}

TEST(Triangulation, coordinates_of_any_size_are_exact) {
  // A sliver whose middle vertices lie off the long diagonal by one unit in 2^52.
  constexpr std::int64_t kFar = std::int64_t{1} << 30;
  Plane plane(Projection::xy, 3);
  const auto edges = loops(plane, {{{0, 0}, {kFar / 2 + 1, kFar / 2}, {kFar, kFar}, {kFar / 2, kFar / 2 + 1}}});
  const auto triangles = plane.triangulated(edges);
  EXPECT_EQ(plane.findings(edges, triangles, 2 * kFar), "");
  EXPECT_EQ(triangles.size(), 2U);
}

}  // namespace
}  // namespace algebra3d
