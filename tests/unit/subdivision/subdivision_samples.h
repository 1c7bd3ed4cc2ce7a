#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/subdivision/subdivided.h"
#include "unit/halfedge/mesh_samples.h"

/// Polygon meshes for tests of subdivision.
namespace algebra3d::samples {

/// The variants by name, as SubdivisionOptions take them.
inline SubdivisionOptions variant(const SubdivisionScheme& scheme, std::string_view name) {
  return {subdivision_variant(scheme, name).value()};
}

using Faces = std::vector<std::vector<std::uint32_t>>;

/// With given points.
inline PolygonMesh polygon_mesh(const Faces& faces, std::vector<Vec3> points) {
  LargeVector<std::uint32_t> starts{0}, corners;
  for (const auto& face : faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  return {PointArray(std::move(points)), PolygonLayout(std::move(starts)), std::move(corners)};
}

/// With small integers as coordinates, so that masks with binary weights have exact results in doubles.
inline PolygonMesh polygon_mesh(const Faces& faces) {
  std::uint32_t count = 0;
  for (const auto& face : faces)
    for (const std::uint32_t corner : face) count = std::max(count, corner + 1);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(-16, 16);
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    points.push_back({x, y, z});
  }
  return polygon_mesh(faces, std::move(points));
}

inline Faces faces_of(const Triangles& triangles) {
  Faces faces;
  for (const auto& [a, b, c] : triangles) faces.push_back({a, b, c});
  return faces;
}

/// Six quadrilaterals; corner 4 z + 2 y + x.
inline Faces cube() {
  return {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
}

inline Triangles icosahedron() {
  return {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
          {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
          {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
}

/// m by n quadrilaterals with a boundary.
inline Faces quadrilateral_grid(std::uint32_t m, std::uint32_t n) {
  Faces faces;
  for (std::uint32_t i = 0; i < m; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      faces.push_back({a, b, b + 1, a + 1});
    }
  return faces;
}

/// A pentagon beside a triangle and a quadrilateral.
inline Faces mixed_faces() {
  return {{0, 1, 2, 3, 4}, {1, 0, 5}, {2, 1, 5, 6}};
}

/// A fan of `count` triangles about vertex 0, closed or open.
inline Triangles fan(std::uint32_t count, bool is_closed) {
  Triangles triangles;
  for (std::uint32_t i = 0; i < count; ++i) triangles.push_back({0, i + 1, is_closed && i + 1 == count ? 1 : i + 2});
  return triangles;
}

struct NamedMesh {
  std::string name;
  PolygonMesh mesh;
};

/// Manifold meshes of triangles, open and closed, with vertices of many degrees.
inline std::vector<NamedMesh> manifold_triangle_meshes() {
  std::vector<NamedMesh> meshes = {{"tetrahedron", polygon_mesh(faces_of(tetrahedron()))},
                                   {"icosahedron", polygon_mesh(faces_of(icosahedron()))},
                                   {"fan", polygon_mesh(faces_of(fan(9, true)))},
                                   {"open fan", polygon_mesh(faces_of(fan(9, false)))},
                                   {"large fan", polygon_mesh(faces_of(fan(40, true)))}};
  std::size_t number = 0;
  for (const Triangles& triangles : all_kinds()) {
    const bool has_loop =
        std::ranges::any_of(triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    PolygonMesh mesh = polygon_mesh(faces_of(triangles));
    // Two triangles back to back have vertices with two edges, which are refused.
    const bool is_taken = triangles != Triangles{{0, 1, 2}, {0, 2, 1}} && !has_loop && is_manifold(mesh);
    if (is_taken) meshes.push_back({"kind " + std::to_string(number), std::move(mesh)});
    ++number;
  }
  return meshes;
}

/// Manifold meshes of polygons, open and closed.
inline std::vector<NamedMesh> manifold_polygon_meshes() {
  std::vector<NamedMesh> meshes = {
      {"cube", polygon_mesh(cube())},
      {"grid", polygon_mesh(quadrilateral_grid(4, 3))},
      {"one face", polygon_mesh(quadrilateral_grid(1, 1))},
      {"mixed", polygon_mesh(mixed_faces())},
      {"large face", polygon_mesh({{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20}})}};
  // Vertices and faces of several degrees side by side.
  for (const PolygonMesh& mesh : {polygon_mesh(cube()), polygon_mesh(faces_of(icosahedron()))})
    meshes.push_back({"dual", *subdivided(mesh, SubdivisionScheme::doo_sabin, 1)});
  return meshes;
}

}  // namespace algebra3d::samples
