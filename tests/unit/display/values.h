#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/values/display/shape_of_value.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/spatial.h"

/// Values read from their lists, and their shapes.
namespace algebra3d {

template <typename T>
Value value_of(std::string_view text) {
  Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};
  const auto list = NestedList::parse(text);
  EXPECT_TRUE(list.ok()) << text;
  auto value = value_from_nested(TypeOf<T>::type(), *list, context);
  EXPECT_TRUE(value.ok()) << text;
  EXPECT_TRUE(diagnostics.entries().empty()) << text;
  return *value;
}

template <typename T>
DrawnShape shape_from(std::string_view text) {
  Result<DrawnShape> shape = shape_of(value_of<T>(text));
  EXPECT_TRUE(shape.ok()) << text;
  return std::move(shape).value();
}

/// A cube between two corners as quadrilaterals, counter-clockwise seen from outside.
inline std::string cube_mesh(double low, double high) {
  std::string points;
  for (int i = 0; i < 8; ++i)
    points +=
        fmt::format("({} {} {})", (i & 4) != 0 ? high : low, (i & 2) != 0 ? high : low, (i & 1) != 0 ? high : low);
  return "((" + points + ") ((0 1 3 2) (4 6 7 5) (0 4 5 1) (2 3 7 6) (0 2 6 4) (1 5 7 3)))";
}

/// The cube as triangles.
inline TriangleMesh cube_triangles(double low, double high) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i)
    points.push_back({(i & 4) != 0 ? high : low, (i & 2) != 0 ? high : low, (i & 1) != 0 ? high : low});
  const std::vector<TriangleMesh::Triangle> triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5},
                                                         {0, 4, 5}, {0, 5, 1}, {2, 3, 7}, {2, 7, 6},
                                                         {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return {PointArray(std::move(points)), triangles};
}

/// The unit sphere, in triangles between meridians and parallels.
inline TriangleMesh unit_sphere(std::uint32_t rings, std::uint32_t columns) {
  std::vector<Vec3> points;
  for (std::uint32_t i = 1; i < rings; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double latitude = std::numbers::pi * i / rings, longitude = 2 * std::numbers::pi * j / columns;
      points.push_back(
          {std::sin(latitude) * std::cos(longitude), std::sin(latitude) * std::sin(longitude), std::cos(latitude)});
    }
  const auto top = static_cast<std::uint32_t>(points.size()), bottom = top + 1;
  points.push_back({0, 0, 1});
  points.push_back({0, 0, -1});
  std::vector<TriangleMesh::Triangle> triangles;
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return (i - 1) * columns + j % columns; };
  for (std::uint32_t j = 0; j < columns; ++j) {
    triangles.push_back({top, at(1, j), at(1, j + 1)});
    triangles.push_back({bottom, at(rings - 1, j + 1), at(rings - 1, j)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return {PointArray(std::move(points)), triangles};
}

inline DrawnShape shape_of_solid(TriangleMesh mesh) {
  Result<DrawnShape> shape = shape_of(Value::of(Volume3d::trusted(std::move(mesh))));
  EXPECT_TRUE(shape.ok());
  return std::move(shape).value();
}

/// Where a position lies in space.
inline Vec3 place(const DrawnShape& shape, std::uint32_t position) {
  const auto& [x, y, z] = shape.positions[position];
  return shape.origin + Vec3{x, y, z};
}

/// Twice the area of a triangle as a vector along its normal.
inline Vec3 doubled_area(const DrawnShape& shape, const IndexTriangle& triangle) {
  const Vec3 a = place(shape, triangle[0]);
  return cross(place(shape, triangle[1]) - a, place(shape, triangle[2]) - a);
}

/// The volume that the triangles of a shape enclose, relative to its origin.
inline double enclosed_volume(const DrawnShape& shape) {
  double volume = 0;
  for (const IndexTriangle& triangle : shape.triangles)
    volume += dot(place(shape, triangle[0]) - shape.origin, doubled_area(shape, triangle)) / 6;
  return volume;
}

}  // namespace algebra3d
