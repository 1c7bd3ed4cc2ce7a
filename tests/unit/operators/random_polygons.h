#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "algebra3d/planar/polygons.h"

/// Polygons for tests of regions, with coordinates that are small multiples of powers of two.
namespace algebra3d::polygons {

using Cycle = std::vector<std::pair<double, double>>;
using Face = std::vector<Cycle>;

inline Polygons of(const std::vector<Face>& faces) {
  Polygons result;
  for (const Face& face : faces) {
    for (const Cycle& cycle : face) {
      for (const auto& [x, y] : cycle) result.corners.push_back(Vec3{x, y, 0});
      result.cycle_ends.push_back(static_cast<std::uint32_t>(result.corners.size()));
    }
    result.face_ends.push_back(static_cast<std::uint32_t>(result.cycle_ends.size()));
  }
  return result;
}

inline Cycle square(double low, double high) {
  return {{low, low}, {high, low}, {high, high}, {low, high}};
}
inline Cycle turned(Cycle cycle) {
  return {cycle.rbegin(), cycle.rend()};
}
inline Cycle shifted(Cycle cycle, double dx, double dy) {
  for (auto& [x, y] : cycle) x += dx, y += dy;
  return cycle;
}
inline Cycle scaled(Cycle cycle, double factor) {
  for (auto& [x, y] : cycle) x *= factor, y *= factor;
  return cycle;
}

/// A star about the origin with corners in the directions of a regular polygon, between the two distances: each pair
/// of such stars with equally many corners is a valid unit. Coordinates are multiples of 2^-20.
inline Cycle star(std::mt19937_64& random, int corners, double nearest, double farthest) {
  std::uniform_real_distribution<double> distance(nearest, farthest);
  Cycle cycle;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, r = distance(random);
    cycle.emplace_back(std::round(r * std::cos(angle) * 0x1p20) / 0x1p20,
                       std::round(r * std::sin(angle) * 0x1p20) / 0x1p20);
  }
  return cycle;
}

}  // namespace algebra3d::polygons
