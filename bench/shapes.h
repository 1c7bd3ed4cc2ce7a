#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

/// Shapes that several benchmarks use.
namespace bench {

using algebra3d::PointArray;
using algebra3d::TriangleMesh;
using algebra3d::Vec3;

struct Shape {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
};

/// Welds points by the corners and weights that they are made of.
class SphereMaker {
 public:
  explicit SphereMaker(std::uint32_t frequency) : n_(frequency) {}

  Shape make() {
    const double g = std::numbers::phi;
    corners_ = {{{-1, g, 0},
                 {1, g, 0},
                 {-1, -g, 0},
                 {1, -g, 0},
                 {0, -1, g},
                 {0, 1, g},
                 {0, -1, -g},
                 {0, 1, -g},
                 {g, 0, -1},
                 {g, 0, 1},
                 {-g, 0, -1},
                 {-g, 0, 1}}};
    constexpr std::array<TriangleMesh::Triangle, 20> kFaces{
        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    for (const auto& face : kFaces) {
      for (std::uint32_t i = 0; i < n_; ++i) {
        for (std::uint32_t j = 0; i + j < n_; ++j) {
          shape_.triangles.push_back({point(face, i, j), point(face, i + 1, j), point(face, i, j + 1)});
          if (i + j + 1 < n_)
            shape_.triangles.push_back({point(face, i + 1, j), point(face, i + 1, j + 1), point(face, i, j + 1)});
        }
      }
    }
    return std::move(shape_);
  }

 private:
  using Key = std::array<std::pair<std::uint32_t, std::uint32_t>, 3>;

  std::uint32_t point(const TriangleMesh::Triangle& face, std::uint32_t i, std::uint32_t j) {
    Key key{{{face[0], n_ - i - j}, {face[1], i}, {face[2], j}}};
    for (auto& [corner, weight] : key)
      if (weight == 0) corner = 0;
    std::ranges::sort(key);
    const auto [place, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(shape_.points.size()));
    if (is_new) {
      Vec3 sum;
      for (const auto& [corner, weight] : key) sum = sum + static_cast<double>(weight) * corners_[corner];
      shape_.points.push_back((1 / std::sqrt(dot(sum, sum))) * sum);
    }
    return place->second;
  }

  std::uint32_t n_;
  std::array<Vec3, 12> corners_;
  std::map<Key, std::uint32_t> numbers_;
  Shape shape_;
};

/// A geodesic sphere: the faces of an icosahedron, split with the given frequency.
inline Shape sphere(std::uint32_t frequency) {
  return SphereMaker(frequency).make();
}

/// The box from `min` to `max`, 12 triangles.
inline Shape box(const Vec3& min, const Vec3& max) {
  Shape shape;
  for (unsigned i = 0; i < 8; ++i)
    shape.points.push_back({(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y, (i & 4) != 0 ? max.z : min.z});
  shape.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return shape;
}

/// Turned by `radians` about an axis through the origin, then moved; corners rounded to doubles.
inline Shape moved(Shape shape, const Vec3& axis, double radians, const Vec3& by) {
  const Vec3 k = (1 / std::sqrt(dot(axis, axis))) * axis;
  const double c = std::cos(radians), s = std::sin(radians);
  for (Vec3& p : shape.points) p = c * p + s * cross(k, p) + ((1 - c) * dot(k, p)) * k + by;
  return shape;
}

inline const double kRoot2 = std::sqrt(2.0);
/// About which copies are turned.
inline const Vec3 kAxis{1, kRoot2, std::sqrt(3.0)};

/// The sphere, turned and moved so that it crosses the first one.
inline Shape other_sphere(std::uint32_t frequency) {
  return moved(sphere(frequency), kAxis, kRoot2 / 7, {0.3, 0, 0});
}

/// The square rods that leave a Menger sponge of a cube of side 3^level, and the cube; both turned by `radians`.
inline std::vector<Shape> rods(int level, double radians) {
  std::vector<Shape> result;
  const double side = std::pow(3, level);
  for (int k = 1; k <= level; ++k) {
    const auto count = static_cast<int>(std::pow(3, k - 1));
    const double step = side / count, width = step / 3;
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) {
        bool is_hole = false;
        for (int a = i, b = j; a > 0 || b > 0; a /= 3, b /= 3) is_hole = is_hole || (a % 3 == 1 && b % 3 == 1);
        if (is_hole) continue;
        const double p = i * step + width, q = j * step + width;
        result.push_back(box({-1, p, q}, {side + 1, p + width, q + width}));
        result.push_back(box({p, -1, q}, {p + width, side + 1, q + width}));
        result.push_back(box({p, q, -1}, {p + width, q + width, side + 1}));
      }
  }
  for (Shape& rod : result)
    if (radians != 0) rod = moved(rod, kAxis, radians, {});
  return result;
}

inline Shape sponge_cube(int level, double radians) {
  const double side = std::pow(3, level);
  const Shape cube = box({}, {side, side, side});
  return radians != 0 ? moved(cube, kAxis, radians, {}) : cube;
}

inline TriangleMesh mesh_of(const Shape& shape) {
  return {PointArray(shape.points), shape.triangles};
}

}  // namespace bench
