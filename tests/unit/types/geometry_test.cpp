// surface3d and volume3d: texts, proof, boxes, and the laws of equality, order and hash.
#include "algebra3d/values/types/detail/geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/value.h"
#include "unit/types/reading.h"

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

constexpr std::string_view kTetrahedron =
    "(((0.0 0.0 0.0) (0.0 1.0 0.0) (1.0 0.0 0.0)) ((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 0.0 1.0)) "
    "((0.0 0.0 0.0) (0.0 0.0 1.0) (0.0 1.0 0.0)) ((1.0 0.0 0.0) (0.0 1.0 0.0) (0.0 0.0 1.0)))";
// The tetrahedron with one corner at a third.
constexpr std::string_view kExactTetrahedron =
    "(((0.0 0.0 0.0) (0.0 1.0 0.0) (1/3 0.0 0.0)) ((0.0 0.0 0.0) (1/3 0.0 0.0) (0.0 0.0 1.0)) "
    "((0.0 0.0 0.0) (0.0 0.0 1.0) (0.0 1.0 0.0)) ((1/3 0.0 0.0) (0.0 1.0 0.0) (0.0 0.0 1.0)))";

const Type& surface() {
  return TypeOf<Surface3d>::type();
}
const Type& volume() {
  return TypeOf<Volume3d>::type();
}

Value volume_of(std::string_view text) {
  Reading reading = reading_of(volume(), text);
  EXPECT_TRUE(reading.value.ok() && reading.value->is_defined()) << text;
  return *reading.value;
}

TEST(geometry_text, what_is_printed_is_what_was_read) {
  EXPECT_EQ(volume_of(kTetrahedron).to_nested().print(), kTetrahedron);
  EXPECT_EQ(volume_of(kExactTetrahedron).to_nested().print(), kExactTetrahedron);
  EXPECT_EQ(reading_of(surface(), "(((0 0 0) (1 0 0) (0 1 0)))").value->to_nested().print(),
            "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)))");
}

TEST(geometry_text, the_empty_list_is_the_defined_empty_value) {
  for (const Type* type : {&surface(), &volume()}) {
    const Reading reading = reading_of(*type, "()");
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
    const Reading reading = reading_of(volume(), text);
    ASSERT_FALSE(reading.value.ok()) << text;
    EXPECT_EQ(reading.value.error().code, ErrorCode::invalid_value);
    EXPECT_TRUE(reading.value.error().text().starts_with(message)) << reading.value.error().text();
    EXPECT_TRUE(reading.diagnostics.empty());
  }
}

TEST(geometry_text, well_formed_lists_that_are_not_valid_are_undefined_with_a_reason) {
  const Reading open = reading_of(volume(), "(((0 0 0) (1 0 0) (0 1 0)))");
  ASSERT_TRUE(open.value.ok());
  EXPECT_FALSE(open.value->is_defined());
  ASSERT_EQ(open.diagnostics.size(), 1U);
  EXPECT_TRUE(open.diagnostics[0].text.starts_with("no valid solid: 3 boundary edges")) << open.diagnostics[0].text;

  const Reading degenerate = reading_of(surface(), "(((0 0 0) (1 0 0) (2 0 0)))");
  ASSERT_TRUE(degenerate.value.ok());
  EXPECT_FALSE(degenerate.value->is_defined());
  ASSERT_EQ(degenerate.diagnostics.size(), 1U);
  EXPECT_TRUE(degenerate.diagnostics[0].text.starts_with("no valid surface: 1 degenerate triangle"))
      << degenerate.diagnostics[0].text;
}

TEST(geometry_text, corners_are_joined_by_exact_coordinates_not_by_their_doubles) {
  const Value exact = volume_of(kExactTetrahedron);
  EXPECT_EQ(exact.get<Volume3d>().mesh().vertex_count(), 4U);
  EXPECT_EQ(exact.get<Volume3d>().mesh().points().exact_count(), 1U);
  std::string mixed(kExactTetrahedron);
  mixed.replace(mixed.find("1/3"), 3, "0.3333333333333333");  // the double nearest to a third, in one triangle only
  const Reading reading = reading_of(volume(), mixed);
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

/// A solid of unit cubes: by number, cube x + 3 y + 9 z is there or not. What it is as a point set, nobody disputes.
using Voxels = std::array<bool, 27>;

bool holds(const Voxels& voxels, const std::array<int, 3>& cell) {
  for (const int c : cell)
    if (c < 0 || c > 2) return false;
  return voxels[static_cast<std::size_t>(cell[0] + 3 * cell[1] + 9 * cell[2])];
}

/// Triangles over points of all coordinates, in any order.
using Corners = std::vector<std::array<ExactPoint, 3>>;

/// A unit square, its corners counter-clockwise from outside, cut in one of three ways.
void add_square(Corners& corners, const std::array<RationalVec3, 4>& q, std::size_t cut) {
  const std::array<ExactPoint, 4> p{ExactPoint(q[0]), ExactPoint(q[1]), ExactPoint(q[2]), ExactPoint(q[3])};
  if (cut == 2) {
    const ExactPoint middle(Rational(1, 2) * (q[0] + q[2]));
    for (std::size_t i = 0; i < 4; ++i) corners.push_back({p[i], p[(i + 1) % 4], middle});
    return;
  }
  corners.push_back({p[cut], p[cut + 1], p[cut + 2]});
  corners.push_back({p[cut], p[cut + 2], p[(cut + 3) % 4]});
}

/// The boundary of the cubes, each square cut at random, in coordinates of thirds: most corners are not doubles.
Corners boundary_of(const Voxels& voxels, std::mt19937& random) {
  Corners corners;
  for (int n = 0; n < 27; ++n) {
    const std::array<int, 3> cell{n % 3, n / 3 % 3, n / 9};
    if (!holds(voxels, cell)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int direction : {0, 1}) {
        std::array<int, 3> neighbour = cell;
        neighbour[axis] += 2 * direction - 1;
        if (holds(voxels, neighbour)) continue;
        const auto corner = [&](int u, int v) {
          std::array<int, 3> at = cell;
          at[axis] += direction;
          at[(axis + 1) % 3] += u;
          at[(axis + 2) % 3] += v;
          return RationalVec3(Rational(at[0], 3), Rational(at[1], 3), Rational(at[2], 3));
        };
        if (direction == 1)
          add_square(corners, {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, random() % 3);
        else
          add_square(corners, {corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)}, random() % 3);
      }
  }
  std::ranges::shuffle(corners, random);
  return corners;
}

template <typename T>
Value value_of(const Corners& corners, std::mt19937& random) {
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
    std::rotate(triangle.begin(), triangle.begin() + static_cast<std::ptrdiff_t>(random() % 3), triangle.end());
  }
  const auto proved = T::prove(TriangleMesh(std::move(array), triangles));
  EXPECT_TRUE(proved.ok() && *proved);
  return Value::of(**proved);
}

Voxels random_voxels(std::mt19937& random, std::size_t one_in) {
  Voxels voxels{};
  for (bool& voxel : voxels) voxel = random() % one_in == 0;
  return voxels;
}

TEST(geometry_order, solids_are_equal_if_they_are_the_same_points_however_they_are_triangulated) {
  std::mt19937 random(1);
  for (int round = 0; round < 60; ++round) {
    const Voxels voxels = random_voxels(random, 1 + random() % 4);
    const Value a = value_of<Volume3d>(boundary_of(voxels, random), random);
    const Value b = value_of<Volume3d>(boundary_of(voxels, random), random);
    EXPECT_EQ(compare(a, b), std::strong_ordering::equal);
    EXPECT_EQ(hash(a), hash(b));
  }
}

TEST(geometry_order, a_cube_more_or_less_makes_another_solid) {
  std::mt19937 random(2);
  for (int round = 0; round < 60; ++round) {
    Voxels voxels = random_voxels(random, 2);
    const Value a = value_of<Volume3d>(boundary_of(voxels, random), random);
    bool& voxel = voxels[random() % voxels.size()];
    voxel = !voxel;
    const Value b = value_of<Volume3d>(boundary_of(voxels, random), random);
    EXPECT_NE(compare(a, b), std::strong_ordering::equal);
  }
}

TEST(geometry_order, orientation_of_surfaces_does_not_count_and_corners_do) {
  EXPECT_NE(compare(volume_of(kTetrahedron), volume_of(kExactTetrahedron)), std::strong_ordering::equal);
  const Value front = *reading_of(surface(), "(((0 0 0) (1 0 0) (0 1 0)))").value;
  const Value back = *reading_of(surface(), "(((0 1 0) (1 0 0) (0 0 0)))").value;
  EXPECT_EQ(compare(front, back), std::strong_ordering::equal);
  EXPECT_EQ(hash(front), hash(back));
}

TEST(geometry_order, surfaces_are_equal_if_they_are_the_same_points_whatever_way_triangles_turn) {
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    const Voxels voxels = random_voxels(random, 3);
    Corners turned = boundary_of(voxels, random);
    for (auto& t : turned)
      if (random() % 2 == 0) std::swap(t[0], t[1]);
    const Value a = value_of<Surface3d>(boundary_of(voxels, random), random);
    const Value b = value_of<Surface3d>(turned, random);
    EXPECT_EQ(compare(a, b), std::strong_ordering::equal);
    EXPECT_EQ(hash(a), hash(b));
  }
}

TEST(geometry_order, it_is_a_total_order) {
  std::mt19937 random(4);
  std::vector<Voxels> all;
  std::vector<Value> values;
  for (int i = 0; i < 40; ++i) {
    Voxels voxels{};
    for (std::size_t n = 0; n < 4; ++n) voxels[n] = random() % 2 == 0;  // few different ones, so that many are equal
    all.push_back(voxels);
    values.push_back(value_of<Volume3d>(boundary_of(voxels, random), random));
  }
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b) {
      const auto order = compare(values[a], values[b]);
      EXPECT_EQ(order == 0, all[a] == all[b]);
      EXPECT_EQ(order<0, compare(values[b], values[a])> 0);
      for (const Value& c : values)
        if (order < 0 && compare(values[b], c) < 0) {
          ASSERT_TRUE(compare(values[a], c) < 0);
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

TEST(geometry, points_with_the_same_doubles_may_differ) {
  const Rational tiny = Rational(1, 1'000'000'007) * Rational(1, 1'000'000'007) * Rational(1, 1'000'000'007);
  const auto at = [&](int steps) { return ExactPoint(RationalVec3(Rational(1, 3) + tiny * Rational(steps), 0, 0)); };
  ASSERT_EQ(at(0).ref().approx, at(2).ref().approx);
  PointArray points;
  for (int steps : {2, 0, 1}) points.push_back(at(steps));
  EXPECT_FALSE(has_equal_points(TriangleMesh(points, std::vector<Triangle>{{0, 1, 2}})));
  points.push_back(at(0));
  EXPECT_TRUE(has_equal_points(TriangleMesh(points, std::vector<Triangle>{{0, 1, 2}})));
}

}  // namespace
}  // namespace algebra3d
