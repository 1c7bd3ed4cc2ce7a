// surface3d and volume3d: texts, proof, boxes, and the laws of equality, order and hash.
#include "algebra3d/types/geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/types/spatial.h"
#include "algebra3d/types/value.h"

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

constexpr std::string_view kTetrahedron =
    "(((0.0 0.0 0.0) (0.0 1.0 0.0) (1.0 0.0 0.0)) ((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 0.0 1.0)) "
    "((0.0 0.0 0.0) (0.0 0.0 1.0) (0.0 1.0 0.0)) ((1.0 0.0 0.0) (0.0 1.0 0.0) (0.0 0.0 1.0)))";
// The same with one corner at a third.
constexpr std::string_view kExactTetrahedron =
    "(((0.0 0.0 0.0) (0.0 1.0 0.0) (1/3 0.0 0.0)) ((0.0 0.0 0.0) (1/3 0.0 0.0) (0.0 0.0 1.0)) "
    "((0.0 0.0 0.0) (0.0 0.0 1.0) (0.0 1.0 0.0)) ((1/3 0.0 0.0) (0.0 1.0 0.0) (0.0 0.0 1.0)))";

struct Reading {
  Result<Value> value;
  std::vector<Diagnostics::Entry> diagnostics;
};

Reading read(const Type& type, std::string_view text) {
  Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};
  const auto list = NestedList::parse(text);
  EXPECT_TRUE(list.ok()) << text;
  auto value = value_from_nested(type, *list, context);
  return {std::move(value), diagnostics.entries()};
}

const Type& surface() {
  return TypeOf<Surface3d>::type();
}
const Type& volume() {
  return TypeOf<Volume3d>::type();
}

Value volume_of(std::string_view text) {
  Reading reading = read(volume(), text);
  EXPECT_TRUE(reading.value.ok() && reading.value->is_defined()) << text;
  return *reading.value;
}

TEST(geometry_text, what_is_printed_is_what_was_read) {
  EXPECT_EQ(volume_of(kTetrahedron).to_nested().print(), kTetrahedron);
  EXPECT_EQ(volume_of(kExactTetrahedron).to_nested().print(), kExactTetrahedron);
  EXPECT_EQ(read(surface(), "(((0 0 0) (1 0 0) (0 1 0)))").value->to_nested().print(),
            "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)))");
}

TEST(geometry_text, the_empty_list_is_the_defined_empty_value) {
  for (const Type* type : {&surface(), &volume()}) {
    const Reading reading = read(*type, "()");
    ASSERT_TRUE(reading.value.ok());
    EXPECT_TRUE(reading.value->is_defined());
    EXPECT_EQ(reading.value->header().size, 0U);
    EXPECT_TRUE(reading.value->header().box.is_empty());
    EXPECT_EQ(reading.value->to_nested().print(), "()");
  }
  EXPECT_TRUE(Volume3d().mesh().is_empty());
  EXPECT_TRUE(Surface3d().mesh().is_empty());
}

TEST(geometry_text, malformed_lists_are_errors_that_name_the_triangle) {
  const std::vector<std::pair<std::string_view, std::string_view>> cases{
      {"7", "volume3d: expected a list of triangles, got 7"},
      {"(7)", "volume3d: triangle 1: expected (p1 p2 p3), got 7"},
      {"(((0 0 0) (1 0 0)))", "volume3d: triangle 1: expected (p1 p2 p3), got ((0 0 0) (1 0 0))"},
      {"(((0 0 0) (1 0 0) (0 1 0)) ((0 0 0) (1 0 0) (0 1 0) (2 2 2)))",
       "volume3d: triangle 2: expected (p1 p2 p3), got ((0 0 0) (1 0 0) (0 1 0) (2 2 2))"},
      {"(((0 0 0) (1 0 0) (0 1 0)) ((0 0 0) (1 0) (0 1 0)))", "volume3d: triangle 2: "},
      {"(((0 0 0) (1 0 TRUE) (0 1 0)))", "volume3d: triangle 1: "},
  };
  for (const auto& [text, message] : cases) {
    const Reading reading = read(volume(), text);
    ASSERT_FALSE(reading.value.ok()) << text;
    EXPECT_EQ(reading.value.error().code, ErrorCode::invalid_value);
    EXPECT_TRUE(reading.value.error().message.starts_with(message)) << reading.value.error().message;
    EXPECT_TRUE(reading.diagnostics.empty());
  }
}

TEST(geometry_text, well_formed_lists_that_are_not_valid_are_undefined_with_a_reason) {
  const Reading open = read(volume(), "(((0 0 0) (1 0 0) (0 1 0)))");
  ASSERT_TRUE(open.value.ok());
  EXPECT_FALSE(open.value->is_defined());
  ASSERT_EQ(open.diagnostics.size(), 1U);
  EXPECT_TRUE(open.diagnostics[0].text.starts_with("volume3d: no valid solid: 3 boundary edges"))
      << open.diagnostics[0].text;

  const Reading degenerate = read(surface(), "(((0 0 0) (1 0 0) (2 0 0)))");
  ASSERT_TRUE(degenerate.value.ok());
  EXPECT_FALSE(degenerate.value->is_defined());
  ASSERT_EQ(degenerate.diagnostics.size(), 1U);
  EXPECT_TRUE(degenerate.diagnostics[0].text.starts_with("surface3d: no valid surface: 1 degenerate triangle"))
      << degenerate.diagnostics[0].text;
}

TEST(geometry_text, corners_are_joined_by_exact_coordinates_not_by_their_doubles) {
  const Value exact = volume_of(kExactTetrahedron);
  EXPECT_EQ(exact.get<Volume3d>().mesh().vertex_count(), 4U);
  EXPECT_EQ(exact.get<Volume3d>().mesh().points().exact_count(), 1U);
  std::string mixed(kExactTetrahedron);
  mixed.replace(mixed.find("1/3"), 3, "0.3333333333333333");  // the double nearest to a third, in one triangle only
  const Reading reading = read(volume(), mixed);
  ASSERT_TRUE(reading.value.ok());
  EXPECT_FALSE(reading.value->is_defined());
}

TEST(geometry, the_box_encloses_exact_corners_outward_rounded) {
  const Box3 box = volume_of(kExactTetrahedron).header().box;
  EXPECT_EQ(box.min, (Vec3{0, 0, 0}));
  EXPECT_LT(Rational(1, 3), Rational(box.max.x));
  EXPECT_GT(Rational(1, 3), Rational(std::nextafter(box.max.x, 0.0)));
  EXPECT_EQ(box.max.y, 1.0);
}

TEST(geometry, the_box_leaves_out_points_that_no_triangle_uses) {
  const Surface3d surface = Surface3d::trusted(TriangleMesh(
      PointArray(std::vector<Vec3>{{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}}), std::vector<Triangle>{{0, 2, 3}}));
  EXPECT_EQ(surface.box(), (Box3{{0, 0, 0}, {1, 1, 0}}));
}

/// Triangles over points as a list of corners: what a surface value is a set of.
using Corners = std::vector<std::array<ExactPoint, 3>>;

Value surface_of(const Corners& corners, std::mt19937& random) {
  // Numbers of points are shuffled as well: they must not matter.
  std::vector<ExactPoint> points;
  for (const auto& t : corners) points.insert(points.end(), t.begin(), t.end());
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::ranges::shuffle(points, random);
  PointArray array;
  for (const ExactPoint& p : points) array.push_back(p);
  std::vector<Triangle> triangles;
  for (const auto& t : corners) {
    Triangle& triangle = triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      triangle[i] = static_cast<std::uint32_t>(std::ranges::find(points, t[i]) - points.begin());
  }
  return Value::of(Surface3d::trusted(TriangleMesh(std::move(array), triangles)));
}

Corners random_corners(std::mt19937& random, std::size_t count) {
  std::uniform_int_distribution<int> coordinate(-1, 1);
  std::uniform_int_distribution<int> denominator(2, 3);
  const auto number = [&] { return Rational(coordinate(random), denominator(random)); };
  Corners corners(count);
  for (auto& t : corners)
    for (ExactPoint& p : t) p = ExactPoint(RationalVec3(number(), number(), number()));
  return corners;
}

/// The same set of triangles, written differently.
Corners permuted(Corners corners, std::mt19937& random) {
  std::ranges::shuffle(corners, random);
  for (auto& t : corners) std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random() % 3), t.end());
  return corners;
}

TEST(geometry_order, equal_sets_of_triangles_are_equal_and_hash_alike) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const Corners corners = random_corners(random, 1 + random() % 12);
    const Value a = surface_of(corners, random);
    const Value b = surface_of(permuted(corners, random), random);
    EXPECT_EQ(compare(a, b), std::strong_ordering::equal);
    EXPECT_EQ(hash(a), hash(b));
  }
}

TEST(geometry_order, orientation_and_every_corner_count) {
  const Value tetrahedron = volume_of(kTetrahedron);
  const Value other = volume_of(kExactTetrahedron);
  EXPECT_NE(compare(tetrahedron, other), std::strong_ordering::equal);
  const Value front = *read(surface(), "(((0 0 0) (1 0 0) (0 1 0)))").value;
  const Value turned = *read(surface(), "(((0 1 0) (0 0 0) (1 0 0)))").value;
  const Value back = *read(surface(), "(((0 0 0) (0 1 0) (1 0 0)))").value;
  EXPECT_EQ(compare(front, turned), std::strong_ordering::equal);
  EXPECT_NE(compare(front, back), std::strong_ordering::equal);
  EXPECT_NE(hash(front), hash(back));
}

TEST(geometry_order, it_is_a_total_order_by_the_definition) {
  // The definition, as sorted lists of rationals.
  const auto key = [](const Corners& corners) {
    std::vector<std::vector<RationalVec3>> result;
    for (const auto& t : corners) {
      const std::vector<RationalVec3> r{t[0].rational(), t[1].rational(), t[2].rational()};
      result.push_back(std::min({r, {r[1], r[2], r[0]}, {r[2], r[0], r[1]}}));
    }
    std::ranges::sort(result);
    return result;
  };
  std::mt19937 random(2);
  std::vector<Corners> all;
  std::vector<Value> values;
  for (int i = 0; i < 60; ++i) {
    all.push_back(random_corners(random, 1 + random() % 3));
    values.push_back(surface_of(all.back(), random));
  }
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b) {
      const auto order = compare(values[a], values[b]);
      EXPECT_EQ(order == 0, key(all[a]) == key(all[b]));
      EXPECT_EQ(order<0, compare(values[b], values[a])> 0);
      if (all[a].size() != all[b].size()) {
        EXPECT_EQ(order < 0, all[a].size() < all[b].size());
      } else if (values[a].header().box == values[b].header().box) {
        EXPECT_EQ(order < 0, key(all[a]) < key(all[b]));
      }
      for (const Value& c : values) {
        if (order < 0 && compare(values[b], c) < 0) {
          ASSERT_TRUE(compare(values[a], c) < 0);
        }
      }
    }
}

TEST(geometry, equal_points_are_found) {
  const auto mesh_of = [](std::vector<Vec3> points) {
    return TriangleMesh(PointArray(std::move(points)), std::vector<Triangle>{{0, 1, 2}});
  };
  EXPECT_FALSE(has_equal_points(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})));
  EXPECT_TRUE(has_equal_points(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -0.0, 0}})));
}

}  // namespace
}  // namespace algebra3d
