#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "algebra3d/mesh/mesh.h"

/// Lists of faces for tests of the mesh library, and what brute force says about them.
namespace algebra3d::mesh::lists {

using Faces = std::vector<std::vector<std::uint32_t>>;

/// Points without a pattern, one per number.
inline std::vector<Vec3> some_points(std::size_t count) {
  std::mt19937 random(7);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(random() % 1000) / 8;
  return points;
}

inline PolygonMesh polygons_of(const Faces& faces, const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> corners, degrees;
  for (const auto& face : faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    degrees.push_back(static_cast<std::uint32_t>(face.size()));
  }
  return *PolygonMesh::of_faces(points, corners, degrees);
}

inline TriangleMesh triangles_of(const Faces& faces, const std::vector<Vec3>& points) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& face : faces) triangles.push_back({face.at(0), face.at(1), face.at(2)});
  return *TriangleMesh::of_triangles(points, triangles);
}

/// A grid of squares, or of triangles, in the plane z = 0: open, manifold.
inline Faces grid(std::uint32_t width, std::uint32_t height, bool is_of_triangles) {
  Faces faces;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t a = y * (width + 1) + x, b = a + 1, d = a + width + 1, c = d + 1;
      if (is_of_triangles) {
        faces.push_back({a, b, c});
        faces.push_back({a, c, d});
      } else {
        faces.push_back({a, b, c, d});
      }
    }
  return faces;
}
inline std::vector<Vec3> grid_points(std::uint32_t width, std::uint32_t height) {
  std::vector<Vec3> points;
  for (std::uint32_t y = 0; y <= height; ++y)
    for (std::uint32_t x = 0; x <= width; ++x) points.push_back({static_cast<double>(x), static_cast<double>(y), 0});
  return points;
}

/// A torus of squares or triangles: closed, genus 1.
inline Faces torus(std::uint32_t width, std::uint32_t height, bool is_of_triangles) {
  Faces faces = grid(width, height, is_of_triangles);
  for (auto& face : faces)
    for (std::uint32_t& v : face) v = v / (width + 1) % height * width + v % (width + 1) % width;
  return faces;
}
inline std::vector<Vec3> torus_points(std::uint32_t width, std::uint32_t height) {
  std::vector<Vec3> points;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const double a = 2 * M_PI * x / width, b = 2 * M_PI * y / height;
      points.push_back({(3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b)});
    }
  return points;
}

inline Faces cube() {
  return {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
}
inline std::vector<Vec3> cube_points() {
  std::vector<Vec3> points;
  for (unsigned i = 0; i < 8; ++i)
    points.push_back({static_cast<double>(i & 1), static_cast<double>(i >> 1 & 1), static_cast<double>(i >> 2)});
  return points;
}

/// Faces with random corners: open and non-manifold, with isolated vertices, some with repeated corners.
inline Faces random_faces(std::mt19937& random, std::uint32_t vertex_count, std::uint32_t max_degree) {
  Faces faces(random() % 25);
  for (auto& face : faces) {
    face.resize(3 + random() % (max_degree - 2));
    for (std::uint32_t& v : face) v = static_cast<std::uint32_t>(random()) % vertex_count;
  }
  return faces;
}
/// A manifold grid or torus with faces taken out: slits, bridges, isolated vertices.
inline Faces random_holes(std::mt19937& random, Faces faces) {
  const auto kept_of_ten = 4 + random() % 6;
  std::erase_if(faces, [&](const auto&) { return random() % 10 >= kept_of_ten; });
  return faces;
}

/// The faces with their vertices numbered anew by first use, so that none is isolated.
inline Faces renumbered(Faces faces) {
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (auto& face : faces)
    for (std::uint32_t& v : face) v = numbers.try_emplace(v, static_cast<std::uint32_t>(numbers.size())).first->second;
  return faces;
}
inline bool has_repeated_corners(const Faces& faces) {
  return std::ranges::any_of(faces, [](std::vector<std::uint32_t> face) {
    std::ranges::sort(face);
    return std::ranges::adjacent_find(face) != face.end();
  });
}

/// Half-edges, edges and neighbours of a list of faces, found by looking at all of them.
struct BruteForce {
  struct Halfedge {
    std::uint32_t from, to, face;
  };
  std::vector<Halfedge> halfedges;
  std::vector<std::vector<std::uint32_t>> edges;  ///< their half-edges, in order of the first one
  std::vector<std::uint32_t> edge_of_halfedge;

  explicit BruteForce(const Faces& faces) {
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      for (std::size_t i = 0; i < faces[f].size(); ++i)
        halfedges.push_back({faces[f][i], faces[f][(i + 1) % faces[f].size()], f});
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
    for (std::uint32_t h = 0; h < halfedges.size(); ++h) {
      const auto ends = std::minmax(halfedges[h].from, halfedges[h].to);
      const auto [found, is_new] = numbers.try_emplace({ends.first, ends.second}, edges.size());
      if (is_new) edges.emplace_back();
      edges[found->second].push_back(h);
      edge_of_halfedge.push_back(found->second);
    }
  }
  const std::vector<std::uint32_t>& along(std::uint32_t h) const { return edges[edge_of_halfedge[h]]; }
  bool is_manifold(std::uint32_t h) const {
    const auto& all = along(h);
    return all.size() == 2 && halfedges[all[0]].from == halfedges[all[1]].to && halfedges[h].from != halfedges[h].to;
  }
  bool is_boundary(std::uint32_t h) const { return along(h).size() == 1 && halfedges[h].from != halfedges[h].to; }
};

/// Calls test(mesh, faces) for meshes of all kinds, of triangles and of polygons.
template <typename Test>
void for_each_mesh(Test test) {
  std::mt19937 random(1);
  test(TriangleMesh(), Faces());
  test(PolygonMesh(), Faces());
  for (int i = 0; i < 400; ++i) {
    const Faces triangles = random_faces(random, 3 + i % 12, 3), polygons = random_faces(random, 3 + i % 12, 7);
    test(triangles_of(triangles, some_points(16)), triangles);
    test(polygons_of(polygons, some_points(16)), polygons);
  }
  for (std::uint32_t i = 0; i < 60; ++i) {
    const std::uint32_t width = 3 + i % 7, height = 3 + i % 5;
    for (const bool is_of_triangles : {true, false})
      for (const bool is_closed : {true, false}) {
        const Faces all = is_closed ? torus(width, height, is_of_triangles) : grid(width, height, is_of_triangles);
        const std::vector<Vec3> points = is_closed ? torus_points(width, height) : grid_points(width, height);
        const Faces faces = i == 0 ? all : random_holes(random, all);
        test(polygons_of(faces, points), faces);
        if (is_of_triangles) test(triangles_of(faces, points), faces);
      }
  }
}

}  // namespace algebra3d::mesh::lists
