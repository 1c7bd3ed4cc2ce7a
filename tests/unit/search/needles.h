#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The wall of a solid of `n` sides between two regular polygons of these radii, which lies aslant: 2 n triangles, or n
/// if the upper radius is 0.
inline TriangleMesh needle_wall(std::uint32_t n, double lower_radius, double upper_radius, double scale,
                                double offset) {
  const std::array<Vec3, 3> axes{{{0.48, 0.6, 0.64}, {-0.8, 0.6, 0}, {-0.384, -0.512, 0.768}}};
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto add = [&](double radius, double angle, double height) {
    points.push_back(Vec3{offset, offset, offset} + scale * (radius * std::cos(angle) * axes[0] +
                                                             radius * std::sin(angle) * axes[1] + height * axes[2]));
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / n;
    add(lower_radius, angle, 0);
    if (upper_radius > 0) add(upper_radius, angle, 1);
  }
  if (!(upper_radius > 0)) add(0, 0, 1);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    if (upper_radius > 0) {
      triangles.push_back({2 * i, 2 * next, 2 * i + 1});
      triangles.push_back({2 * i + 1, 2 * next, 2 * next + 1});
    } else {
      triangles.push_back({i, next, n});
    }
  }
  return {PointArray(std::move(points)), triangles};
}

inline TriangleMesh needle_prism(std::uint32_t n, double scale = 1, double offset = 0) {
  return needle_wall(n, 1, 1, scale, offset);
}

inline TriangleMesh needle_cone(std::uint32_t n, double scale = 1, double offset = 0) {
  return needle_wall(n, 1, 0, scale, offset);
}

}  // namespace algebra3d
