#pragma once

#include <array>

#include "mesh_structures/structure.h"

namespace bench::structures {

/// Triangles without neighbours, by their corners: points ("single triangles") or numbers of points ("shared vertex").
/// Every neighbour is searched among all triangles.
template <typename Corner>
class TriangleList {
 public:
  using Triangle = std::array<Corner, 3>;

  std::size_t face_count() const { return triangles_.size(); }

  template <typename Visit>
  void visit_ring(const Corner& v, const Visit& visit) const {
    visit_corners(v, [&](Index f, std::size_t i) { visit(triangles_[f][(i + 1) % 3]); });
  }
  template <typename Visit>
  void visit_faces_round(const Corner& v, const Visit& visit) const {
    visit_corners(v, [&](Index f, std::size_t) { visit(f); });
  }
  /// The faces of edge i of face f.
  template <typename Visit>
  void visit_edge(Index f, std::size_t i, const Visit& visit) const {
    const Corner &a = triangles_[f][i], &b = triangles_[f][(i + 1) % 3];
    for (Index g = 0; g < triangles_.size(); ++g)
      for (std::size_t j = 0; j < 3; ++j)
        if (triangles_[g][j] == b && triangles_[g][(j + 1) % 3] == a) visit(f, g);
  }
  template <typename Visit>
  void visit_neighbours(Index f, const Visit& visit) const {
    for (std::size_t i = 0; i < 3; ++i) visit_edge(f, i, [&](Index, Index neighbour) { visit(neighbour); });
  }

 protected:
  std::vector<Triangle> triangles_;

 private:
  template <typename Visit>
  void visit_corners(const Corner& v, const Visit& visit) const {
    for (Index f = 0; f < triangles_.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i)
        if (triangles_[f][i] == v) visit(f, i);
  }
};

class SingleTriangles : public TriangleList<Vec3> {
 public:
  explicit SingleTriangles(const TriangleMesh& mesh) : vertex_count_(mesh.vertex_count()) {
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const auto corners = mesh.triangle(FaceId(f));
      const auto& points = mesh.points().approx();
      triangles_.push_back({points[corners[0]], points[corners[1]], points[corners[2]]});
    }
  }
  std::size_t vertex_count() const { return vertex_count_; }
  std::size_t bytes() const { return bytes_of(triangles_); }

 private:
  std::size_t vertex_count_;
};

class SharedVertices : public TriangleList<Index> {
 public:
  explicit SharedVertices(const TriangleMesh& mesh) : points_(mesh.points().approx()) {
    for (Index f = 0; f < mesh.face_count(); ++f) triangles_.push_back(mesh.triangle(FaceId(f)));
  }
  std::size_t vertex_count() const { return points_.size(); }
  std::size_t bytes() const { return bytes_of(triangles_) + bytes_of(points_); }

 private:
  std::vector<Vec3> points_;
};

}  // namespace bench::structures
