#include "algebra3d/repair/snapped_mesh.h"

#include <array>
#include <cstdint>
#include <utility>

#include "algebra3d/arrangement/triangulation.h"
#include "algebra3d/arrangement/vertex_pool.h"

namespace algebra3d {
namespace {

using arrangement::DirectedEdge;

/// The triangles of all facets, with the outlines that they have now.
class Snapping {
 public:
  Snapping(const TriangleMesh& mesh, const MovedVertices& moved) : outlines_(mesh, moved) {}

  SnappedMesh run();

 private:
  void add(const TriangleMesh::Triangle& triangle);
  bool fill(Projection plane, const std::vector<DirectedEdge>& outline,
            const std::vector<TriangleMesh::Triangle>& triangles) const;
  bool add_triangulated(std::uint32_t facet);
  void add_moved(std::uint32_t facet);
  TriangleMesh used_points_only();

  FacetOutlines outlines_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

/// True if none of the triangles turns over and they have this boundary, without opposites, all together.
bool Snapping::fill(Projection plane, const std::vector<DirectedEdge>& outline,
                    const std::vector<TriangleMesh::Triangle>& triangles) const {
  std::vector<DirectedEdge> sides;
  for (const auto& [a, b, c] : triangles) {
    if (outlines_.turn(plane, a, b, c) <= 0) return false;
    sides.insert(sides.end(), {{a, b}, {b, c}, {c, a}});
  }
  return without_opposites(std::move(sides)) == outline;
}

void Snapping::add(const TriangleMesh::Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  if (a != b && b != c && c != a) triangles_.push_back(triangle);
}

/// False if the outline bounds no region.
bool Snapping::add_triangulated(std::uint32_t facet) {
  const Projection plane = outlines_.facets().projection(facet);
  const bool is_flipped = outlines_.facets().is_flipped(facet);
  std::vector<DirectedEdge> edges = outlines_.outline(facet);
  if (is_flipped) {
    for (auto& [from, to] : edges) std::swap(from, to);
    edges = without_opposites(std::move(edges));
  }
  std::vector<TriangleMesh::Triangle> triangles;
  if (!triangulate(outlines_.points(), plane, edges, triangles) || !fill(plane, edges, triangles)) return false;
  for (auto& [a, b, c] : triangles) triangles_.push_back(is_flipped ? std::array{a, c, b} : std::array{a, b, c});
  return true;
}

/// The old triangles between the new points, and others that fill what lies between them and the chains of edges.
void Snapping::add_moved(std::uint32_t facet) {
  for (const std::uint32_t face : outlines_.facets()->faces(facet)) add(outlines_.triangle(face));
  for (const BoundaryEdge& side : outlines_.boundary(facet)) {
    const auto chain = outlines_.edges()[side.edge];
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
      if (side.is_reversed)
        add({chain[0], chain[i + 1], chain[i]});
      else
        add({chain[0], chain[i], chain[i + 1]});
    }
  }
}

TriangleMesh Snapping::used_points_only() {
  PointArray used;
  std::vector<std::uint32_t> numbers(outlines_.points().size(), arrangement::kNone);
  for (TriangleMesh::Triangle& triangle : triangles_)
    for (std::uint32_t& corner : triangle) {
      if (numbers[corner] == arrangement::kNone) {
        numbers[corner] = static_cast<std::uint32_t>(used.size());
        used.push_back(outlines_.points()[corner]);
      }
      corner = numbers[corner];
    }
  return {std::move(used), triangles_};
}

SnappedMesh Snapping::run() {
  for (std::uint32_t facet = 0; facet < outlines_.facets().count(); ++facet) {
    const bool is_as_before = !outlines_.is_moved(facet) || !outlines_.is_simple(facet);
    if (is_as_before || !add_triangulated(facet)) add_moved(facet);
  }
  return {used_points_only(), outlines_.edges().largest_detour()};
}

}  // namespace

SnappedMesh moved_mesh(const TriangleMesh& mesh, PointArray points) {
  const std::size_t count = points.size();
  // What has not moved passes over nothing.
  return snapped_mesh(mesh, {std::move(points), std::vector<double>(count)});
}

SnappedMesh snapped_mesh(const TriangleMesh& mesh, const MovedVertices& moved) {
  return Snapping(mesh, moved).run();
}

}  // namespace algebra3d
