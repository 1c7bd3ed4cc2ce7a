#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

/// Meshes with known properties, random ones of every kind, and what brute force says about a list of triangles.
namespace algebra3d::samples {

using Triangles = std::vector<TriangleMesh::Triangle>;

inline PointArray points_for(std::size_t count) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = static_cast<double>(i);
    points.push_back({t, t * t, t * t * t});  // on a curve of which no four points lie in a plane
  }
  return PointArray(std::move(points));
}

inline TriangleMesh mesh_of(const Triangles& triangles, std::size_t least_vertex_count = 0) {
  std::size_t count = least_vertex_count;
  for (const auto& triangle : triangles)
    for (const std::uint32_t corner : triangle) count = std::max<std::size_t>(count, corner + 1);
  return {points_for(count), triangles};
}

inline Triangles moved(Triangles triangles, std::uint32_t offset) {
  for (auto& triangle : triangles)
    for (std::uint32_t& corner : triangle) corner += offset;
  return triangles;
}

inline Triangles joined(Triangles first, const Triangles& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Closed, genus 0, 4 vertices.
inline Triangles tetrahedron() {
  return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
}

/// Closed, genus 0, 6 vertices.
inline Triangles octahedron() {
  return {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
}

/// Grid of m by n cells. A direction that is wrapped is closed to a ring: both wrapped, a torus (genus 1).
inline Triangles grid(std::uint32_t m, std::uint32_t n, bool wrap_m, bool wrap_n) {
  const std::uint32_t columns = wrap_n ? n : n + 1;
  const std::uint32_t rows = wrap_m ? m : m + 1;
  const auto id = [&](std::uint32_t i, std::uint32_t j) { return (i % rows) * columns + j % columns; };
  Triangles result;
  for (std::uint32_t i = 0; i < m; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      result.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      result.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return result;
}

inline Triangles torus(std::uint32_t m, std::uint32_t n) {
  return grid(m, n, true, true);
}

/// Points of torus(m, n) in space, without self-intersection and oriented outward.
inline PointArray torus_points(std::uint32_t m, std::uint32_t n) {
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < m; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / m;
      const double v = 2 * std::numbers::pi * j / n;
      points.push_back({(3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v)});
    }
  }
  return PointArray(std::move(points));
}

/// Strip of five triangles over five vertices with a half twist: cannot be oriented.
inline Triangles moebius_strip() {
  return {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 0, 4}, {4, 0, 1}};
}

/// Two tori joined where one triangle of each was: genus 2.
inline Triangles double_torus() {
  Triangles first = torus(4, 4);
  Triangles second = moved(torus(4, 4), 16);
  const auto [a, b, c] = first.back();
  const auto [d, e, f] = second.back();
  first.pop_back();
  second.pop_back();
  Triangles result = joined(first, second);
  for (auto& triangle : result)
    for (std::uint32_t& corner : triangle) corner = corner == d ? a : corner == e ? c : corner == f ? b : corner;
  return result;
}

/// Triangles with random corners among few vertices: edges and vertices of every non-manifold kind; repeated corners
/// only if wanted.
inline Triangles random_soup(std::mt19937& random, std::size_t count, std::uint32_t vertex_count, bool degenerate) {
  std::uniform_int_distribution<std::uint32_t> corner(0, vertex_count - 1);
  Triangles result;
  while (result.size() < count) {
    const TriangleMesh::Triangle t{corner(random), corner(random), corner(random)};
    if (degenerate || (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])) result.push_back(t);
  }
  return result;
}

/// A mesh that is mostly manifold: a grid or torus without some faces, with some turned round, some vertices merged and
/// some doubled, in random order.
inline Triangles damaged_grid(std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::uint32_t>(0, static_cast<std::uint32_t>(n) - 1)(random);
  };
  Triangles result = grid(3 + below(4), 3 + below(4), below(2) == 0, below(2) == 0);
  for (std::uint32_t i = below(6); i > 0; --i) result.erase(result.begin() + below(result.size()));
  for (std::uint32_t i = below(3); i > 0; --i) std::swap(result[below(result.size())][0], result.front()[0]);
  for (std::uint32_t i = below(3); i > 0; --i) {
    auto& triangle = result[below(result.size())];
    std::swap(triangle[1], triangle[2]);
  }
  for (std::uint32_t i = below(3); i > 0; --i) {
    const std::uint32_t from = result[below(result.size())][0];
    const std::uint32_t to = result[below(result.size())][1];
    for (auto& triangle : result) std::ranges::replace(triangle, from, to);
  }
  if (below(3) == 0) result.push_back(result[below(result.size())]);
  std::ranges::shuffle(result, random);
  return result;
}

/// Meshes of all kinds, always the same ones.
inline std::vector<Triangles> all_kinds() {
  std::mt19937 random(20240817);
  std::vector<Triangles> result = {{},
                                   tetrahedron(),
                                   octahedron(),
                                   torus(3, 3),
                                   torus(5, 7),
                                   double_torus(),
                                   grid(1, 1, false, false),
                                   grid(4, 3, false, false),
                                   grid(4, 3, true, false),
                                   moebius_strip(),
                                   {{0, 1, 2}},
                                   {{0, 0, 1}},
                                   {{0, 0, 0}},
                                   {{0, 1, 2}, {0, 1, 2}},
                                   {{0, 1, 2}, {0, 2, 1}},
                                   {{0, 1, 2}, {0, 3, 4}},
                                   {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}},
                                   {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}},
                                   joined(tetrahedron(), moved(tetrahedron(), 3)),
                                   joined(octahedron(), moved(octahedron(), 100))};
  for (int i = 0; i < 300; ++i) {
    const auto count = static_cast<std::size_t>(1 + i % 25);
    result.push_back(random_soup(random, count, 3 + static_cast<std::uint32_t>(i % 7), i % 3 == 0));
  }
  for (int i = 0; i < 300; ++i) result.push_back(damaged_grid(random));
  for (std::uint32_t i = 0; i < 64; ++i) {
    Triangles& holed = result.emplace_back(grid(3 + i % 4, 3 + i / 16, i % 2 == 0, i % 8 < 4));
    std::ranges::shuffle(holed, random);
    holed.pop_back();
  }
  return result;
}

/// Answers about a list of triangles, from maps and searches alone.
class BruteForce {
 public:
  explicit BruteForce(const Triangles& triangles) : triangles_(triangles) {
    for (std::uint32_t h = 0; h < 3 * triangles.size(); ++h) edges_[edge(h)].push_back(h);
  }

  std::uint32_t halfedge_count() const { return static_cast<std::uint32_t>(3 * triangles_.size()); }
  std::uint32_t origin(std::uint32_t h) const { return triangles_[h / 3][h % 3]; }
  std::uint32_t target(std::uint32_t h) const { return triangles_[h / 3][(h % 3 + 1) % 3]; }
  std::pair<std::uint32_t, std::uint32_t> edge(std::uint32_t h) const { return std::minmax({origin(h), target(h)}); }
  const std::vector<std::uint32_t>& along(std::uint32_t h) const { return edges_.at(edge(h)); }
  const std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>>& edges() const { return edges_; }

  bool is_boundary(std::uint32_t h) const { return along(h).size() == 1 && origin(h) != target(h); }
  bool is_manifold(std::uint32_t h) const {
    return along(h).size() == 2 && origin(along(h)[0]) == target(along(h)[1]) && origin(h) != target(h);
  }
  std::uint32_t opposite(std::uint32_t h) const { return along(h)[0] == h ? along(h)[1] : along(h)[0]; }

  /// Half-edges that leave `v`.
  std::vector<std::uint32_t> corners(std::uint32_t v) const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t h = 0; h < halfedge_count(); ++h)
      if (origin(h) == v) result.push_back(h);
    return result;
  }

  /// The corners at `v`, grouped into fans by flooding.
  std::vector<std::set<std::uint32_t>> fans(std::uint32_t v) const {
    std::vector<std::set<std::uint32_t>> result;
    std::set<std::uint32_t> met;
    for (const std::uint32_t seed : corners(v)) {
      if (met.contains(seed)) continue;
      std::set<std::uint32_t> fan;
      std::vector<std::uint32_t> pending{seed};
      while (!pending.empty()) {
        const std::uint32_t h = pending.back();
        pending.pop_back();
        if (!fan.insert(h).second) continue;
        const std::uint32_t before = 3 * (h / 3) + (h % 3 + 2) % 3;
        if (is_manifold(before)) pending.push_back(opposite(before));
        if (is_manifold(h)) pending.push_back(3 * (opposite(h) / 3) + (opposite(h) % 3 + 1) % 3);
      }
      met.insert(fan.begin(), fan.end());
      result.push_back(std::move(fan));
    }
    return result;
  }

 private:
  Triangles triangles_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges_;
};

}  // namespace algebra3d::samples
