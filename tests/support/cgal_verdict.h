#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "support/to_cgal.h"

namespace algebra3d::oracle {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;

inline ExactKernel::Triangle_3 cgal_triangle(const TriangleMesh& mesh, std::uint32_t face) {
  const TriangleRef c = mesh.corners(FaceId(face));
  return {to_cgal<ExactKernel>(c[0]), to_cgal<ExactKernel>(c[1]), to_cgal<ExactKernel>(c[2])};
}

/// True if the two have a segment or an area in common. That bodies touch in points is allowed, wherever these are.
inline bool meet_in_more_than_a_point(const TriangleMesh& mesh, std::uint32_t face, std::uint32_t other) {
  const auto common = CGAL::intersection(cgal_triangle(mesh, face), cgal_triangle(mesh, other));
  return common && boost::get<ExactKernel::Point_3>(&*common) == nullptr;
}

/// True if two triangles without a common corner meet in more than a point.
inline bool do_triangles_meet(const TriangleMesh& mesh) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
  std::vector<Box> boxes;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) boxes.emplace_back(cgal_triangle(mesh, f).bbox(), f);
  bool found = false;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& s, const Box& t) {
    const TriangleMesh::Triangle one = mesh.triangle(FaceId(s.info())), other = mesh.triangle(FaceId(t.info()));
    const bool have_common_corner =
        std::ranges::any_of(one, [&](std::uint32_t v) { return std::ranges::find(other, v) != other.end(); });
    found = found || (!have_common_corner && meet_in_more_than_a_point(mesh, s.info(), t.info()));
  });
  return found;
}

/// True if CGAL finds a pair of faces that meets in more than common corners and edges, and in more than a point.
template <typename Mesh>
bool passes_through_itself(const TriangleMesh& solid, const Mesh& mesh) {
  using Face = typename Mesh::Face_index;
  std::vector<std::pair<Face, Face>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  return std::ranges::any_of(
      pairs, [&](const auto& pair) { return meet_in_more_than_a_point(solid, pair.first, pair.second); });
}

/// What CGAL's polygon mesh processing, with exact coordinates, finds wrong with a solid; an empty string if nothing.
/// What it cannot take as a mesh, since more than two faces meet at an edge, is examined as triangles: those without a
/// common corner must not meet.
inline std::string complaint(const TriangleMesh& solid) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  if (solid.is_empty()) return {};
  if (auto mesh = to_cgal_mesh<ExactKernel>(solid)) {
    if (!CGAL::is_closed(*mesh)) return "not closed";
    if (passes_through_itself(solid, *mesh)) return "passes through itself";
    return pmp::does_bound_a_volume(*mesh) ? "" : "bounds no volume";
  }
  return do_triangles_meet(solid) ? "passes through itself" : "";
}

}  // namespace algebra3d::oracle
