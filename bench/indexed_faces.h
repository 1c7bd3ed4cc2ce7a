#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "shapes.h"

/// Meshes as points and corners, for benchmarks beside libraries whose meshes have faces of any degree.
namespace bench {

/// Faces of one degree over shared points.
struct IndexedFaces {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> corners;  // one face after the other
  std::uint32_t degree = 3;

  std::size_t face_count() const { return corners.size() / degree; }
};

/// A torus of n * n quadrilaterals, row by row.
inline IndexedFaces torus_of_quadrilaterals(std::uint32_t n) {
  IndexedFaces faces;
  faces.degree = 4;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / n;
      faces.points.push_back({(3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v)});
      const std::uint32_t next = (i + 1) % n, beside = (j + 1) % n;
      for (const std::uint32_t corner : {i * n + j, next * n + j, next * n + beside, i * n + beside})
        faces.corners.push_back(corner);
    }
  }
  return faces;
}

/// A torus of triangles: its quadrilaterals halved.
inline IndexedFaces torus_of_triangles(std::uint32_t n) {
  IndexedFaces faces = torus_of_quadrilaterals(n);
  std::vector<std::uint32_t> corners;
  for (std::size_t h = 0; h < faces.corners.size(); h += 4)
    for (const std::size_t i : {0, 1, 2, 0, 2, 3}) corners.push_back(faces.corners[h + i]);
  faces.corners = std::move(corners);
  faces.degree = 3;
  return faces;
}

/// The faces with points and faces in random order.
inline IndexedFaces shuffled(const IndexedFaces& faces) {
  std::mt19937_64 random(1);
  IndexedFaces result{std::vector<Vec3>(faces.points.size()), {}, faces.degree};
  std::vector<std::uint32_t> numbers(faces.points.size());
  for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  std::ranges::shuffle(numbers, random);
  for (std::size_t i = 0; i < numbers.size(); ++i) result.points[numbers[i]] = faces.points[i];
  std::vector<std::uint32_t> order(faces.face_count());
  for (std::uint32_t f = 0; f < order.size(); ++f) order[f] = f;
  std::ranges::shuffle(order, random);
  result.corners.reserve(faces.corners.size());
  for (const std::uint32_t f : order)
    for (std::uint32_t i = 0; i < faces.degree; ++i)
      result.corners.push_back(numbers[faces.corners[f * faces.degree + i]]);
  return result;
}

}  // namespace bench
