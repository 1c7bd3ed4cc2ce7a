#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d::samples {

/// Collects triangles and welds equal corners, as the makers of values do.
class MeshMaker {
 public:
  /// Every coordinate is stored as `factor` times the given one plus `shift`, exactly.
  explicit MeshMaker(Rational factor = 1, Rational shift = 0) : factor_(std::move(factor)), shift_(std::move(shift)) {}

  MeshMaker& triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    triangles_.push_back({point(a), point(b), point(c)});
    return *this;
  }
  MeshMaker& quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return triangle(a, b, c).triangle(a, c, d);
  }
  /// Axis-parallel box of 12 triangles, oriented outward, or inward if `is_cavity`.
  MeshMaker& box(const Vec3& low, const Vec3& high, bool is_cavity = false) {
    const auto corner = [&](int i) {
      return Vec3{(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
    };
    constexpr std::array<std::array<int, 4>, 6> kSides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& s : kSides) {
      if (is_cavity) quad(corner(s[3]), corner(s[2]), corner(s[1]), corner(s[0]));
      if (!is_cavity) quad(corner(s[0]), corner(s[1]), corner(s[2]), corner(s[3]));
    }
    return *this;
  }
  /// Oriented outward, whatever the order of the corners.
  MeshMaker& tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    if (dot(cross(b - a, c - a), d - a) < 0) return tetrahedron(a, c, b, d);
    return triangle(a, c, b).triangle(a, b, d).triangle(b, c, d).triangle(c, a, d);
  }
  /// Removes the last triangle.
  MeshMaker& drop() {
    triangles_.pop_back();
    return *this;
  }
  std::vector<TriangleMesh::Triangle>& triangles() { return triangles_; }
  TriangleMesh mesh() const {
    PointArray points;
    for (const ExactPoint& p : points_) points.push_back(p);
    return {std::move(points), triangles_};
  }

 private:
  std::uint32_t point(const Vec3& v) {
    const auto map = [this](double x) { return Rational(x) * factor_ + shift_; };
    const ExactPoint p(RationalVec3(map(v.x), map(v.y), map(v.z)));
    const auto [place, is_new] = numbers_.try_emplace(p, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return place->second;
  }

  Rational factor_, shift_;
  std::map<ExactPoint, std::uint32_t> numbers_;
  std::vector<ExactPoint> points_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

/// Closed surface over a grid of rows and columns, 2 * rows * columns triangles.
inline TriangleMesh torus(std::uint32_t rows, std::uint32_t columns, const Vec3& centre = {}) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double u = 2 * std::numbers::pi * i / rows, v = 2 * std::numbers::pi * j / columns;
      const double radius = 3 + std::cos(v);
      points.push_back(centre + Vec3{radius * std::cos(u), radius * std::sin(u), std::sin(v)});
      const std::uint32_t i1 = (i + 1) % rows, j1 = (j + 1) % columns;
      const std::uint32_t a = i * columns + j, b = i1 * columns + j, c = i1 * columns + j1, d = i * columns + j1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return {PointArray(std::move(points)), triangles};
}

/// Cone of `sides` triangles at the apex and as many round the middle of its base.
inline TriangleMesh cone(std::uint32_t sides) {
  std::vector<Vec3> points{{0, 0, 1}, {0, 0, 0}};
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    points.push_back({std::cos(angle), std::sin(angle), 0});
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % sides;
    triangles.push_back({0, a, b});
    triangles.push_back({1, b, a});
  }
  return {PointArray(std::move(points)), triangles};
}

/// Band of `steps` quads, turned over `half_turns` times on its way round.
inline TriangleMesh twisted_band(std::uint32_t steps, int half_turns) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < steps; ++i) {
    const double u = 2 * std::numbers::pi * i / steps, tilt = half_turns * u / 2;
    for (const double side : {-1.0, 1.0}) {
      const double radius = 4 + side * std::cos(tilt);
      points.push_back({radius * std::cos(u), radius * std::sin(u), side * std::sin(tilt)});
    }
    const bool closes_twisted = i + 1 == steps && half_turns % 2 != 0;
    const std::uint32_t next = 2 * ((i + 1) % steps);
    const std::uint32_t a = 2 * i, b = 2 * i + 1, c = next + (closes_twisted ? 0U : 1U),
                        d = next + (closes_twisted ? 1U : 0U);
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
  return {PointArray(std::move(points)), triangles};
}

}  // namespace algebra3d::samples
