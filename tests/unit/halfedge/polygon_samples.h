#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "mesh_samples.h"

/// Meshes of polygons, and what brute force says about a list of polygons.
namespace algebra3d::samples {

using Polygon = std::vector<std::uint32_t>;
using PolygonList = std::vector<Polygon>;

inline PolygonMesh polygon_mesh_of(const PolygonList& polygons, PointArray points) {
  LargeVector<std::uint32_t> starts, corners;
  starts.reserve(polygons.size() + 1);
  starts.push_back(0);
  std::size_t corner_count = 0;
  for (const Polygon& polygon : polygons) corner_count += polygon.size();
  corners.reserve(corner_count);
  for (const Polygon& polygon : polygons) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  return {std::move(points), PolygonLayout(std::move(starts)), std::move(corners)};
}

inline PolygonMesh polygon_mesh_of(const PolygonList& polygons, std::size_t least_vertex_count = 0) {
  std::size_t count = least_vertex_count;
  for (const Polygon& polygon : polygons)
    for (const std::uint32_t corner : polygon) count = std::max<std::size_t>(count, corner + 1);
  return polygon_mesh_of(polygons, points_for(count));
}

inline PolygonList as_polygons(const Triangles& triangles) {
  PolygonList result;
  for (const auto& triangle : triangles) result.emplace_back(triangle.begin(), triangle.end());
  return result;
}

/// Closed, genus 0: six quads, 8 vertices, bit i of a vertex its coordinate i.
inline PolygonList cube() {
  return {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
}

/// Closed, genus 0: two polygons of n corners and n quads.
inline PolygonList prism(std::uint32_t n) {
  PolygonList result(2);
  for (std::uint32_t i = 0; i < n; ++i) {
    result[0].push_back(n - 1 - i);
    result[1].push_back(n + i);
    result.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  return result;
}

/// Quads as in `grid`.
inline PolygonList quad_grid(std::uint32_t m, std::uint32_t n, bool wrap_m, bool wrap_n) {
  PolygonList result;
  const Triangles halves = grid(m, n, wrap_m, wrap_n);
  for (std::size_t i = 0; i < halves.size(); i += 2)
    result.push_back({halves[i][0], halves[i][1], halves[i][2], halves[i + 1][2]});
  return result;
}

/// Polygons of 3 to 7 corners among few vertices; repeated corners only if wanted.
inline PolygonList random_polygon_soup(std::mt19937& random, std::size_t count, std::uint32_t vertex_count,
                                       bool degenerate) {
  PolygonList result;
  while (result.size() < count) {
    Polygon polygon(3 + random() % std::min<std::uint32_t>(5, vertex_count - 2));
    for (std::uint32_t& corner : polygon) corner = static_cast<std::uint32_t>(random() % vertex_count);
    if (degenerate || std::set(polygon.begin(), polygon.end()).size() == polygon.size()) result.push_back(polygon);
  }
  return result;
}

/// A grid or torus of quads of which some are divided, some away, some turned round and some vertices merged, in random
/// order.
inline PolygonList damaged_quads(std::mt19937& random) {
  PolygonList result;
  for (const Polygon& q : quad_grid(3 + random() % 4, 3 + random() % 4, random() % 2 == 0, random() % 2 == 0)) {
    if (random() % 3 == 0) {
      result.push_back({q[0], q[1], q[2]});
      result.push_back({q[0], q[2], q[3]});
    } else if (random() % 9 != 0) {
      result.push_back(q);
    }
  }
  for (std::size_t i = random() % 3; i > 0; --i) std::ranges::reverse(result[random() % result.size()]);
  for (std::size_t i = random() % 3; i > 0; --i) {
    const std::uint32_t from = result[random() % result.size()][0];
    const std::uint32_t to = result[random() % result.size()][1];
    for (Polygon& polygon : result) std::ranges::replace(polygon, from, to);
  }
  if (random() % 3 == 0) result.push_back(result[random() % result.size()]);
  std::ranges::shuffle(result, random);
  return result;
}

/// Polygons of all kinds, always the same ones.
inline std::vector<PolygonList> all_polygon_kinds() {
  std::mt19937 random(20261126);
  std::vector<PolygonList> result = {{},
                                     cube(),
                                     prism(3),
                                     prism(7),
                                     quad_grid(3, 5, true, true),
                                     quad_grid(4, 3, false, false),
                                     quad_grid(4, 3, true, false),
                                     {{0, 1, 2, 3, 4}},
                                     {{0, 1, 0, 2}},
                                     {{0, 0, 0, 0}},
                                     {{0, 1, 2, 3}, {0, 1, 2, 3}},
                                     {{0, 1, 2, 3}, {3, 2, 1, 0}},
                                     {{0, 1, 2, 3}, {0, 4, 5}},
                                     {{0, 1, 2}, {0, 1, 3, 4}, {0, 1, 5, 6, 7}}};
  for (const Triangles& triangles : all_kinds()) result.push_back(as_polygons(triangles));
  for (std::uint32_t i = 0; i < 300; ++i)
    result.push_back(random_polygon_soup(random, 1 + i % 25, 3 + i % 8, i % 3 == 0));
  for (int i = 0; i < 300; ++i) result.push_back(damaged_quads(random));
  return result;
}

/// Answers about a list of polygons, from maps and searches alone.
class PolygonBruteForce {
 public:
  explicit PolygonBruteForce(const PolygonList& polygons) {
    for (std::uint32_t f = 0; f < polygons.size(); ++f)
      for (std::uint32_t i = 0; i < polygons[f].size(); ++i) {
        const auto degree = static_cast<std::uint32_t>(polygons[f].size());
        const auto first = static_cast<std::uint32_t>(sides_.size()) - i;
        sides_.push_back({polygons[f][i], polygons[f][(i + 1) % degree], f, first + (i + 1) % degree,
                          first + (i + degree - 1) % degree});
      }
    for (std::uint32_t h = 0; h < sides_.size(); ++h) edges_[edge(h)].push_back(h);
  }

  std::uint32_t halfedge_count() const { return static_cast<std::uint32_t>(sides_.size()); }
  std::uint32_t origin(std::uint32_t h) const { return sides_[h].origin; }
  std::uint32_t target(std::uint32_t h) const { return sides_[h].target; }
  std::uint32_t face(std::uint32_t h) const { return sides_[h].face; }
  std::uint32_t next(std::uint32_t h) const { return sides_[h].next; }
  std::uint32_t prev(std::uint32_t h) const { return sides_[h].prev; }
  std::pair<std::uint32_t, std::uint32_t> edge(std::uint32_t h) const { return std::minmax({origin(h), target(h)}); }
  const std::vector<std::uint32_t>& along(std::uint32_t h) const { return edges_.at(edge(h)); }
  const std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>>& edges() const { return edges_; }

  bool is_boundary(std::uint32_t h) const { return along(h).size() == 1 && origin(h) != target(h); }
  bool is_manifold(std::uint32_t h) const {
    return along(h).size() == 2 && origin(along(h)[0]) == target(along(h)[1]) && origin(h) != target(h);
  }
  std::uint32_t opposite(std::uint32_t h) const { return along(h)[0] == h ? along(h)[1] : along(h)[0]; }

  /// The half-edges that leave `v`, grouped into fans by flooding.
  std::vector<std::set<std::uint32_t>> fans(std::uint32_t v) const {
    std::vector<std::set<std::uint32_t>> result;
    std::set<std::uint32_t> met;
    for (std::uint32_t seed = 0; seed < halfedge_count(); ++seed) {
      if (origin(seed) != v || met.contains(seed)) continue;
      std::set<std::uint32_t> fan;
      std::vector<std::uint32_t> pending{seed};
      while (!pending.empty()) {
        const std::uint32_t h = pending.back();
        pending.pop_back();
        if (!fan.insert(h).second) continue;
        if (is_manifold(prev(h))) pending.push_back(opposite(prev(h)));
        if (is_manifold(h)) pending.push_back(next(opposite(h)));
      }
      met.insert(fan.begin(), fan.end());
      result.push_back(std::move(fan));
    }
    return result;
  }

 private:
  struct Side {
    std::uint32_t origin, target, face, next, prev;
  };
  std::vector<Side> sides_;  // per half-edge
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges_;
};

}  // namespace algebra3d::samples
