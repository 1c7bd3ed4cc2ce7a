#include "algebra3d/kernel/rounding/detail/divided_outline.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "unit/arrangement/random_solids.h"

namespace algebra3d::solids {
namespace {

using Outline = std::vector<OutlineCorner>;

/// The outline of the triangle (0 0) (8 0) (0 8) with further corners on its sides.
class OutlineOfTriangle {
 public:
  OutlineOfTriangle(const std::vector<double>& bottom, const std::vector<double>& slope,
                    const std::vector<double>& left) {
    add({0, 0}, 0b101);
    for (const double x : bottom) add({x, 0}, 0b001);
    add({8, 0}, 0b011);
    for (const double y : slope) add({8 - y, y}, 0b010);
    add({0, 8}, 0b110);
    for (const double y : left) add({0, y}, 0b100);
  }

  const Outline& corners() const { return corners_; }

 private:
  void add(std::pair<double, double> place, std::uint8_t sides) {
    corners_.push_back({PointId(corners_.size()), WideVec3(place.first, place.second, 0), sides});
  }

  Outline corners_;
};

/// Twice the signed area, of triangles with corners at small integers exact.
long double doubled_area(const Outline& outline, const IndexTriangle& triangle) {
  const WideVec3 a = outline[triangle[0]].place;
  return cross(outline[triangle[1]].place - a, outline[triangle[2]].place - a).z;
}

/// The directed edges of the triangles, without pairs of opposite ones, as pairs of points.
std::multiset<std::pair<PointId, PointId>> boundary(const Outline& outline,
                                                    const std::vector<IndexTriangle>& triangles) {
  std::multiset<std::pair<PointId, PointId>> edges;
  for (const IndexTriangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const PointId from = outline[t[i]].point, to = outline[t[(i + 1) % 3]].point;
      if (const auto opposite = edges.find({to, from}); opposite != edges.end())
        edges.erase(opposite);
      else
        edges.insert({from, to});
    }
  return edges;
}

std::multiset<std::pair<PointId, PointId>> sides_of(const Outline& outline) {
  std::multiset<std::pair<PointId, PointId>> sides;
  for (std::size_t i = 0; i < outline.size(); ++i)
    sides.insert({outline[i].point, outline[(i + 1) % outline.size()].point});
  return sides;
}

bool has_edge(const std::vector<IndexTriangle>& triangles, std::uint32_t a, std::uint32_t b) {
  return std::ranges::any_of(triangles, [&](const IndexTriangle& t) {
    return std::ranges::find(t, a) != t.end() && std::ranges::find(t, b) != t.end();
  });
}

TEST(DividedOutline, is_covered_by_triangles_that_turn_its_way) {
  Chance chance(1);
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(round);
    const auto some = [&] {
      std::vector<double> numbers;
      for (int x = 1; x < 8; ++x)
        if (chance.below(3) == 0) numbers.push_back(x);
      return numbers;
    };
    std::vector<double> left = some();
    std::ranges::reverse(left);
    const OutlineOfTriangle triangle(some(), some(), left);
    const Outline& outline = triangle.corners();
    std::vector<OutlineChord> chords;
    for (std::uint32_t a = 0; a < outline.size(); ++a)
      for (std::uint32_t b = a + 1; b < outline.size(); ++b)
        if ((outline[a].sides & outline[b].sides) == 0 && chance.below(4) == 0) chords.emplace_back(a, b);
    const std::vector<IndexTriangle> triangles = divided_outline(outline, chords);
    EXPECT_EQ(triangles.size(), outline.size() - 2);
    EXPECT_EQ(boundary(outline, triangles), sides_of(outline));
    long double area = 0;
    for (const IndexTriangle& t : triangles) {
      EXPECT_GT(doubled_area(outline, t), 0);
      area += doubled_area(outline, t);
    }
    EXPECT_EQ(area, 64);
    EXPECT_TRUE(chords.empty() || has_edge(triangles, chords[0].first, chords[0].second));
  }
}

TEST(DividedOutline, is_pinched_where_a_point_comes_twice) {
  Outline outline = OutlineOfTriangle({2, 4}, {}, {2}).corners();
  outline.back().point = outline[1].point;  // the left side is led through the first point of the bottom
  const std::vector<IndexTriangle> triangles = divided_outline(outline, {});
  std::multiset<std::pair<PointId, PointId>> sides = sides_of(outline);
  sides.erase({outline[0].point, outline[1].point});  // there and back
  sides.erase({outline[1].point, outline[0].point});
  EXPECT_EQ(boundary(outline, triangles), sides);
  for (const IndexTriangle& t : triangles)
    EXPECT_EQ((std::set{outline[t[0]].point, outline[t[1]].point, outline[t[2]].point}.size()), 3U);
}

TEST(DividedOutline, of_the_same_points_gives_the_same_triangles) {
  const auto triangles_of_outline = [](Outline outline) {
    std::set<std::set<PointId>> found;
    for (const IndexTriangle& t : divided_outline(outline, {}))
      found.insert({outline[t[0]].point, outline[t[1]].point, outline[t[2]].point});
    return found;
  };
  const Outline outline = OutlineOfTriangle({1, 3, 6}, {2, 3}, {7, 4}).corners();
  const auto expected = triangles_of_outline(outline);
  for (std::size_t first = 1; first < outline.size(); ++first) {
    Outline turned = outline;
    std::ranges::rotate(turned, turned.begin() + static_cast<std::ptrdiff_t>(first));
    EXPECT_EQ(triangles_of_outline(turned), expected);
    std::ranges::reverse(turned);  // seen from the other side
    EXPECT_EQ(triangles_of_outline(turned), expected);
  }
}

}  // namespace
}  // namespace algebra3d::solids
