#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "algebra3d/kernel/planar/polygons.h"

/// Polygons for tests and benchmarks of the plane, made without the code under test.
namespace algebra3d::plane_shapes {

using Cycle = std::vector<Vec3>;
using Face = std::vector<Cycle>;

inline Polygons polygons_of(const std::vector<Face>& faces) {
  Polygons result;
  for (const Face& face : faces) {
    for (const Cycle& cycle : face) {
      for (const Vec3& corner : cycle) result.corners.push_back(corner);
      result.cycle_ends.push_back(static_cast<std::uint32_t>(result.corners.size()));
    }
    result.face_ends.push_back(static_cast<std::uint32_t>(result.cycle_ends.size()));
  }
  return result;
}

inline Cycle reversed(Cycle cycle) {
  return {cycle.rbegin(), cycle.rend()};
}

/// Counter-clockwise.
inline Cycle box(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
}

inline Cycle shifted(Cycle cycle, double dx, double dy) {
  for (Vec3& corner : cycle) corner = corner + Vec3{dx, dy, 0};
  return cycle;
}
inline Cycle scaled(Cycle cycle, double factor) {
  for (Vec3& corner : cycle) corner = factor * corner;
  return cycle;
}
/// The cycle with coordinates that are multiples of 2^-20, so that halves and sums of them are exact.
inline Cycle on_grid(Cycle cycle) {
  for (Vec3& corner : cycle)
    corner = {std::round(corner.x * 0x1p20) / 0x1p20, std::round(corner.y * 0x1p20) / 0x1p20, 0};
  return cycle;
}

/// Radii between `least` and 1 at random, at equal angles: counter-clockwise, simple, star-shaped and spiky.
inline Cycle star(std::size_t count, double least, double scale, std::mt19937_64& random) {
  Cycle cycle;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const double radius = scale * std::uniform_real_distribution<double>(least, 1)(random);
    cycle.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return cycle;
}

/// Rings within rings: faces with one hole each, islands in the holes.
inline std::vector<Face> rings(std::size_t ring_count, std::size_t corners_per_cycle, std::mt19937_64& random) {
  std::vector<Face> faces;
  double scale = 1;
  for (std::size_t i = 0; i < ring_count; ++i) {
    const Cycle outer = star(corners_per_cycle, 0.9, scale, random);
    const Cycle hole = reversed(star(corners_per_cycle, 0.9, scale * 0.85, random));
    faces.push_back({outer, hole});
    scale *= 0.7;
  }
  return faces;
}

/// Koch's snowflake with 3 * 4^depth corners; counter-clockwise.
inline Cycle snowflake(int depth) {
  const double height = std::sqrt(3.0) / 2;
  Cycle cycle{{0, 0, 0}, {0.5, height, 0}, {1, 0, 0}};
  for (int i = 0; i < depth; ++i) {
    Cycle finer;
    for (std::size_t k = 0; k < cycle.size(); ++k) {
      const Vec3 a = cycle[k], d = cycle[(k + 1) % cycle.size()];
      const Vec3 b = a + (1.0 / 3) * (d - a), c = a + (2.0 / 3) * (d - a);
      const Vec3 side = c - b;
      finer.insert(finer.end(), {a, b, {b.x + side.x / 2 - height * side.y, b.y + side.y / 2 + height * side.x, 0}, c});
    }
    cycle = std::move(finer);
  }
  return reversed(cycle);
}

/// The outline of a random tree of cells in a grid of that many rows and columns: counter-clockwise, about 2 corners
/// per cell after each straight run has lost its inner ones, simple, wound, with right angles alone.
Cycle maze(std::uint32_t size, std::mt19937_64& random);

/// As `maze`, with each corner moved at random by less than a quarter of a corridor.
inline Cycle shaken(Cycle cycle, double by, std::mt19937_64& random) {
  std::uniform_real_distribution<double> offset(-by, by);
  for (Vec3& p : cycle) p = p + Vec3{offset(random), offset(random), 0};
  return cycle;
}

/// `count` teeth; counter-clockwise.
inline Cycle comb(std::size_t count, double height) {
  Cycle cycle{{0, -1, 0}, {static_cast<double>(2 * count - 1), -1, 0}};
  for (std::size_t i = count; i-- > 0;) {
    const auto x = static_cast<double>(2 * i);
    cycle.push_back({x + 1, height, 0});
    cycle.push_back({x, height, 0});
    if (i > 0) {
      cycle.push_back({x, 0, 0});
      cycle.push_back({x - 1, 0, 0});
    }
  }
  return cycle;
}

/// Random tree by random edge order and union of sets; its cells have the even places, walls and doors the odd ones.
class Maze {
 public:
  Maze(std::uint32_t size, std::mt19937_64& random) : size_(2 * size - 1), is_open_(std::size_t{size_} * size_) {
    std::vector<std::uint32_t> sets(std::size_t{size} * size);
    std::iota(sets.begin(), sets.end(), 0U);
    const auto find = [&](std::uint32_t s) {
      while (sets[s] != s) s = sets[s] = sets[sets[s]];
      return s;
    };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> doors;
    for (std::uint32_t y = 0; y < size; ++y) {
      for (std::uint32_t x = 0; x < size; ++x) {
        is_open_[std::size_t{2} * y * size_ + 2 * x] = true;
        if (x + 1 < size) doors.emplace_back(y * size + x, y * size + x + 1);
        if (y + 1 < size) doors.emplace_back(y * size + x, y * size + x + size);
      }
    }
    std::shuffle(doors.begin(), doors.end(), random);
    for (const auto& [from, to] : doors) {
      if (find(from) == find(to)) continue;
      sets[find(from)] = find(to);
      is_open_[std::size_t{from / size + to / size} * size_ + from % size + to % size] = true;
    }
  }

  /// Walks with the inside to the left; corners where it turns.
  Cycle outline() const {
    Cycle cycle;
    std::int64_t x = 0, y = 0, dx = 1, dy = 0;
    do {
      // The cells ahead, to the left and to the right of the way.
      const bool left = is_open(x + (dx - dy - 1) / 2, y + (dy + dx - 1) / 2);
      const bool right = is_open(x + (dx + dy - 1) / 2, y + (dy - dx - 1) / 2);
      if (right || !left) {
        cycle.push_back({static_cast<double>(x), static_cast<double>(y), 0});
        const std::int64_t turned = right ? -dx : dx;
        dx = right ? dy : -dy;
        dy = turned;
      }
      x += dx;
      y += dy;
    } while (x != 0 || y != 0);
    cycle.insert(cycle.begin(), Vec3{0, 0, 0});
    return cycle;
  }

 private:
  bool is_open(std::int64_t x, std::int64_t y) const {
    return x >= 0 && y >= 0 && x < size_ && y < size_ &&
           is_open_[static_cast<std::size_t>(y) * size_ + static_cast<std::size_t>(x)];
  }

  std::uint32_t size_;
  std::vector<bool> is_open_;
};

inline Cycle maze(std::uint32_t size, std::mt19937_64& random) {
  return Maze(size, random).outline();
}

}  // namespace algebra3d::plane_shapes
