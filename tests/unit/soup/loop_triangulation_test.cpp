#include "algebra3d/kernel/soup/loop_triangulation.h"

#include <limits>
#include <map>
#include <numbers>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

using Cover = std::vector<TriangleMesh::Triangle>;

Loop random_loop(Chance& chance, std::size_t count) {
  Loop loop;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const auto place = [&](double radius) {
      return radius * Vec3{std::cos(angle), std::sin(angle), 0.3 * chance.unit()} +
             0.2 * Vec3{chance.unit(), chance.unit(), chance.unit()};
    };
    loop.corners.push_back(place(1));
    loop.beyond.push_back(place(2));
  }
  return loop;
}

double cover_area(const Loop& loop, const Cover& cover) {
  double sum = 0;
  for (const auto& [a, b, c] : cover) sum += area_of(SoupTriangle{loop.corners[a], loop.corners[b], loop.corners[c]});
  return sum;
}

/// All ways to cover the loop from one corner to another.
std::vector<Cover> all_covers(std::uint32_t first, std::uint32_t last) {
  if (last - first < 2) return {{}};
  std::vector<Cover> result;
  for (std::uint32_t apex = first + 1; apex < last; ++apex)
    for (const Cover& left : all_covers(first, apex))
      for (const Cover& right : all_covers(apex, last)) {
        Cover& cover = result.emplace_back(left);
        cover.insert(cover.end(), right.begin(), right.end());
        cover.push_back({first, apex, last});
      }
  return result;
}

/// A disc: n - 2 triangles that run once along each edge of the loop, in its order, and within it once each way.
void expect_disc(const Cover& cover, std::size_t count) {
  EXPECT_EQ(cover.size() + 2, count);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : cover)
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_LT(t[i], count);
      ++edges[{t[i], t[(i + 1) % 3]}];
    }
  EXPECT_EQ(edges.size(), 3 * cover.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto next = static_cast<std::uint32_t>((i + 1) % count);
    EXPECT_TRUE(edges.contains({i, next}));
    if (count > 2) {
      EXPECT_FALSE(edges.contains({next, i}));
    }
    edges.erase({i, next});
  }
  for (const auto& [edge, uses] : edges) EXPECT_TRUE(edges.contains({edge.second, edge.first}));
}

TEST(LoopTriangulation, has_the_least_area_of_all) {
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const std::size_t count = 3 + index_below(chance, 6);
    const Loop loop = random_loop(chance, count);
    double least = std::numeric_limits<double>::infinity();
    for (const Cover& cover : all_covers(0, static_cast<std::uint32_t>(count - 1)))
      least = std::min(least, cover_area(loop, cover));
    const Cover cover = triangulate_loop(loop, LoopMeasure::area);
    expect_disc(cover, count);
    EXPECT_NEAR(cover_area(loop, cover), least, 1e-12);
  }
}

/// One less the cosine of the largest angle by which the surface bends, within the cover and at the edges of the loop.
double bend_of(const Loop& loop, const Cover& cover) {
  const std::size_t n = loop.corners.size();
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> normals;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto next = static_cast<std::uint32_t>((i + 1) % n);
    const Vec3 &from = loop.corners[next], &to = loop.corners[i];
    normals[{next, i}] = cross(to - from, loop.beyond[i] - from);
  }
  for (const auto& t : cover)
    for (std::size_t i = 0; i < 3; ++i)
      normals[{t[i], t[(i + 1) % 3]}] =
          cross(loop.corners[t[1]] - loop.corners[t[0]], loop.corners[t[2]] - loop.corners[t[0]]);
  double largest = 0;
  for (const auto& [edge, normal] : normals) {
    const Vec3& other = normals.at({edge.second, edge.first});
    largest = std::max(largest, 1 - dot(normal, other) / (length(normal) * length(other)));
  }
  return largest;
}

// The parts of a loop are covered each for itself, before it is known what lies beyond the line between them. That is
// the least bend of all for up to four corners, where such a part is a triangle that can be no other.
TEST(LoopTriangulation, bends_least_of_all_where_parts_are_triangles) {
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const std::size_t count = 3 + index_below(chance, 2);
    const Loop loop = random_loop(chance, count);
    double least = std::numeric_limits<double>::infinity();
    for (const Cover& cover : all_covers(0, static_cast<std::uint32_t>(count - 1)))
      least = std::min(least, bend_of(loop, cover));
    const Cover cover = triangulate_loop(loop, LoopMeasure::bend);
    expect_disc(cover, count);
    EXPECT_NEAR(bend_of(loop, cover), least, 2e-6);
  }
}

TEST(LoopTriangulation, bend_beats_area_where_it_counts) {
  // The ridge of a roof, of which one square is missing: along the ridge it does not bend but at the ridge itself.
  const Loop loop{{{0, 0, 0}, {4, 0, 3}, {4, 1, 3}, {0, 1, 0}}, {{4, -1, 3}, {8, 0, 0}, {4, 2, 3}, {-4, 0, -3}}};
  for (const auto& t : triangulate_loop(loop, LoopMeasure::bend)) {
    const Vec3& a = loop.corners[t[0]];
    const Vec3 normal = cross(loop.corners[t[1]] - a, loop.corners[t[2]] - a);
    EXPECT_EQ(cross(normal, Vec3{-3, 0, 4}), Vec3{});
    EXPECT_GT(normal.z, 0);
  }
}

TEST(LoopTriangulation, large_loops_are_discs_too) {
  for (const std::size_t count : {4U, 50U, 160U, 161U, 400U}) {
    SCOPED_TRACE(count);
    Chance chance(count);
    const Loop loop = random_loop(chance, count);
    for (const LoopMeasure measure : {LoopMeasure::bend, LoopMeasure::area}) {
      const Cover cover = triangulate_loop(loop, measure);
      expect_disc(cover, count);
      EXPECT_EQ(triangulate_loop(loop, measure), cover);
    }
  }
}

TEST(LoopTriangulation, of_a_plane_convex_loop_covers_its_area) {
  Loop loop;
  constexpr int kCount = 300;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCount;
    loop.corners.push_back({5 * std::cos(angle), 5 * std::sin(angle), 1});
  }
  loop.beyond = loop.corners;
  const double area = kCount / 2.0 * 25 * std::sin(2 * std::numbers::pi / kCount);
  EXPECT_NEAR(cover_area(loop, triangulate_loop(loop, LoopMeasure::area)), area, 1e-9);
}

// From 1e80 on products of two normals were infinite once, and the search for the best triangle never ended.
TEST(LoopTriangulation, huge_and_tiny_loops_are_covered_like_others) {
  Chance chance(1);
  const Loop plain = random_loop(chance, 12);
  for (const LoopMeasure measure : {LoopMeasure::bend, LoopMeasure::area}) {
    const Cover cover = triangulate_loop(plain, measure);
    for (const int exponent : {-1000, -500, -300, 200, 300, 400, 500, 700, 1020}) {
      SCOPED_TRACE(exponent);
      Loop loop = plain;
      for (auto* points : {&loop.corners, &loop.beyond})
        for (Vec3& p : *points)
          p = {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), std::scalbn(p.z, exponent)};
      EXPECT_EQ(triangulate_loop(loop, measure), cover);
    }
  }
}

TEST(LoopTriangulation, equal_and_collinear_corners_are_no_trouble) {
  Loop same{std::vector<Vec3>(9, Vec3{1, 2, 3}), std::vector<Vec3>(9, Vec3{1, 2, 3})};
  Loop line;
  for (int i = 0; i < 9; ++i) line.corners.push_back({double(i), double(i), double(i)});
  line.beyond = line.corners;
  Loop origin{std::vector<Vec3>(5), std::vector<Vec3>(5)};
  for (const Loop& loop : {same, line, origin})
    for (const LoopMeasure measure : {LoopMeasure::bend, LoopMeasure::area})
      expect_disc(triangulate_loop(loop, measure), loop.corners.size());
}

}  // namespace
}  // namespace algebra3d::soups
