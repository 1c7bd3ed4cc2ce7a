#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/indices.h"

namespace algebra3d {

/// The triangles of a mesh while they are changed here and there; each vertex knows its own. Vertices keep their places
/// and numbers. Concurrent calls of the const functions are safe. Refers to the mesh. Memory: 12 bytes per triangle,
/// 4 per vertex, and the stars that have grown.
class TriangleStars {
 public:
  explicit TriangleStars(const TriangleMesh& mesh);

  /// How many triangles there are, those that went included: their corners are kNone.
  std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }
  const IndexTriangle& operator[](std::uint32_t triangle) const { return triangles_[triangle]; }
  const Vec3& rounded_place(std::uint32_t vertex) const { return mesh_.points().approx()[vertex]; }
  const TriangleMesh& original() const { return mesh_; }

  /// Calls visit(t) with the number of each triangle at a vertex.
  template <typename Visit>
  void for_each_at(std::uint32_t vertex, const Visit& visit) const {
    const auto visit_if_there = [&](std::uint32_t t) {
      if (std::ranges::find(triangles_[t], vertex) != triangles_[t].end()) visit(t);
    };
    if (const std::uint32_t list = list_of_[vertex]; list != kNone)
      std::ranges::for_each(lists_[list], visit_if_there);
    else
      for (const FaceId face : faces_around(mesh_, VertexId(vertex))) visit_if_there(face.index());
  }

  /// A vertex becomes one with a neighbour: the triangles of both go.
  void merge(std::uint32_t vertex, std::uint32_t target);
  /// Two triangles (a b c) and (b a d), `c` and `d` given, become (c a d) and (d b c).
  void flip(std::uint32_t first, std::uint32_t c, std::uint32_t second, std::uint32_t d);

  /// The mesh of the triangles that are there, vertices numbered in their order. Cost: linear.
  TriangleMesh mesh() const;
  /// For each of its triangles: its number here if it is as in the original mesh, else kNone.
  std::vector<std::uint32_t> unchanged() const;

 private:
  std::vector<std::uint32_t> at(std::uint32_t vertex) const;
  /// The list of the triangles at a vertex, which others may be added to.
  std::vector<std::uint32_t>& list(std::uint32_t vertex);

  const TriangleMesh& mesh_;
  std::vector<IndexTriangle> triangles_;
  // Triangles of the vertices that have got new ones; some may not be at the vertex any more.
  std::vector<std::vector<std::uint32_t>> lists_;
  std::vector<std::uint32_t> list_of_;  // per vertex; kNone: as in the mesh
};

}  // namespace algebra3d
