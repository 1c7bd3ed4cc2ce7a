#pragma once

#include <CGAL/Exact_rational.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

/// Our meshes as CGAL's, so that its algorithms can be oracles. `Kernel` is any with exact constructions from rationals
/// (for meshes of doubles alone, any kernel).
namespace algebra3d::oracle {

template <typename Kernel>
typename Kernel::Point_3 to_cgal(PointRef point) {
  if (point.is_double()) return {point.approx.x, point.approx.y, point.approx.z};
  const auto number = [](const Rational& value) { return typename Kernel::FT(CGAL::Exact_rational(value.text())); };
  return {number(point.coordinate(0)), number(point.coordinate(1)), number(point.coordinate(2))};
}

/// Points and triangles, index for index: works for every mesh, non-manifold and degenerate ones included.
template <typename Kernel>
struct Soup {
  std::vector<typename Kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};

template <typename Kernel>
Soup<Kernel> to_cgal_soup(const TriangleMesh& mesh) {
  Soup<Kernel> soup;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) soup.points.push_back(to_cgal<Kernel>(mesh.point(VertexId(v))));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.triangle(FaceId(f));
    soup.triangles.push_back({a, b, c});
  }
  return soup;
}

/// The mesh with the same indices of vertices and faces; nothing if CGAL refuses a face, as it does where an edge is
/// non-manifold. Non-manifold vertices may pass: CGAL does not notice all of them.
template <typename Kernel>
std::optional<CGAL::Surface_mesh<typename Kernel::Point_3>> to_cgal_mesh(const TriangleMesh& mesh) {
  using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;
  Mesh result;
  std::vector<typename Mesh::Vertex_index> vertices;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    vertices.push_back(result.add_vertex(to_cgal<Kernel>(mesh.point(VertexId(v)))));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto [a, b, c] = mesh.triangle(FaceId(f));
    if (a == b || b == c || c == a) return std::nullopt;
    if (result.add_face(vertices[a], vertices[b], vertices[c]) == Mesh::null_face()) return std::nullopt;
  }
  return result;
}

}  // namespace algebra3d::oracle
