#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "mesh_samples.h"

/// Lists of polygons, and what searches say about them.
namespace algebra3d::samples {

using PolygonList = std::vector<std::vector<std::uint32_t>>;

inline PolygonMesh polygon_mesh(const PolygonList& polygons, PointArray points) {
  LargeVector<std::uint32_t> starts{0}, corners;
  for (const auto& polygon : polygons) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  return {std::move(points), PolygonLayout(std::move(starts)), std::move(corners)};
}
inline PolygonMesh polygon_mesh(const PolygonList& polygons) {
  std::uint32_t count = 0;
  for (const auto& polygon : polygons)
    for (const std::uint32_t corner : polygon) count = std::max(count, corner + 1);
  return polygon_mesh(polygons, points_for(count));
}

inline PolygonList polygons_of(const Triangles& triangles) {
  PolygonList polygons;
  for (const auto& t : triangles) polygons.push_back({t[0], t[1], t[2]});
  return polygons;
}

/// The six faces of the cube of this edge length, outward.
inline PolygonList cube_faces() {
  return {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
}
inline PointArray cube_points(double a = 1) {
  return PointArray(
      std::vector<Vec3>{{0, 0, 0}, {a, 0, 0}, {a, a, 0}, {0, a, 0}, {0, 0, a}, {a, 0, a}, {a, a, a}, {0, a, a}});
}

/// All kinds of triangle meshes, and random polygons of three to six corners among few vertices.
inline std::vector<PolygonList> all_polygon_lists() {
  std::vector<PolygonList> lists;
  for (const Triangles& triangles : all_kinds()) lists.push_back(polygons_of(triangles));
  lists.push_back(cube_faces());
  std::mt19937 random(5);
  for (std::uint32_t round = 0; round < 200; ++round) {
    PolygonList& list = lists.emplace_back();
    for (std::uint32_t i = 0; i < 1 + round % 12; ++i) {
      auto& polygon = list.emplace_back(3 + i % 4);
      for (std::uint32_t& corner : polygon)
        corner = std::uniform_int_distribution<std::uint32_t>(0, 3 + round % 9)(random);
    }
  }
  return lists;
}

}  // namespace algebra3d::samples
