#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A sphere of 4 n (n - 1) triangles around a point.
inline TriangleMesh round_mesh(std::uint32_t n, double radius, const Vec3& middle) {
  const double step = std::acos(-1.0) / n;
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto point = [&](std::uint32_t i, std::uint32_t j) { return i * 2 * n + j % (2 * n); };
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const double down = i * step, around = j * step;
      points.push_back(
          middle + radius * Vec3{std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down)});
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      if (i > 0) triangles.push_back({point(i, j), point(i + 1, j), point(i, j + 1)});
      if (i + 1 < n) triangles.push_back({point(i, j + 1), point(i + 1, j), point(i + 1, j + 1)});
    }
  return {PointArray(std::move(points)), triangles};
}

/// Meshes of all kinds, each scaled by `scale` and moved by `offset`: smooth, separate triangles at random places, flat
/// and aslant, along a line, and of one point.
inline std::vector<TriangleMesh> slab_samples(double scale, double offset) {
  std::mt19937 random(11);  // NOLINT(cert-msc51-cpp): the same in every run
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 middle{offset, offset, offset};
  std::vector<TriangleMesh> meshes{round_mesh(12, scale, middle)};
  const auto add = [&](std::uint32_t count, const auto& corner) {
    std::vector<Vec3> points;
    std::vector<TriangleMesh::Triangle> triangles;
    for (std::uint32_t i = 0; i < count; ++i) {
      for (int k = 0; k < 3; ++k) points.push_back(middle + scale * corner(i));
      triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    meshes.emplace_back(PointArray(std::move(points)), triangles);
  };
  add(300, [&](std::uint32_t i) {
    const double at = 0.003 * i;
    return Vec3{at + 0.1 * unit(random), unit(random), 1 - at + 0.1 * unit(random)};
  });
  add(200, [&](std::uint32_t) {
    const double u = unit(random), v = unit(random);
    return Vec3{u, v, 0.3 * u - 0.7 * v};
  });
  add(50, [&](std::uint32_t) { return unit(random) * Vec3{1, 2, 3}; });
  add(20, [](std::uint32_t) { return Vec3{1, 1, 1}; });
  return meshes;
}

}  // namespace algebra3d
