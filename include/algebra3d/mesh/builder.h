#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>

#include "algebra3d/base/error.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/mesh/mesh.h"

namespace algebra3d::mesh {

/// Which faces a MeshBuilder takes.
enum class FaceRule : std::uint8_t {
  any,            ///< edges and vertices may become non-manifold
  manifold_edges  ///< every edge has one face on each side at most; is_manifold says whether vertices are manifold, too
};

/// Builds a mesh vertex by vertex and face by face, or changes the faces of one. Elements keep their numbers until
/// `mesh` is called. The caller owns the object; one thread uses it at a time. One that was moved from may be assigned
/// to and destroyed, nothing else.
class MeshBuilder {
 public:
  explicit MeshBuilder(FaceRule rule = FaceRule::manifold_edges);
  /// Begins with a mesh, whose attributes are kept; new elements have none. Its faces are not checked. Cost: linear.
  explicit MeshBuilder(const PolygonMesh& mesh, FaceRule rule = FaceRule::manifold_edges);
  MeshBuilder(MeshBuilder&&) noexcept;
  MeshBuilder& operator=(MeshBuilder&&) noexcept;
  ~MeshBuilder();

  std::size_t vertex_count() const;
  /// Without removed faces.
  std::size_t face_count() const;

  /// Errors: invalid_value for coordinates that are not finite; limit_exceeded. Cost: constant, amortised.
  Result<VertexId> add_vertex(const Vec3& point);
  /// Adds a face with these corners, counter-clockwise seen from its front. Errors: invalid_value, and nothing is
  /// added, for fewer than three corners, a vertex that is not there or that is two corners, and, by the rule
  /// `manifold_edges`, if an edge has a face on this side already; limit_exceeded. Cost: linear in the corners,
  /// expected.
  Result<FaceId> add_face(std::span<const VertexId> corners);
  Result<FaceId> add_face(std::initializer_list<VertexId> corners) {
    return add_face(std::span(corners.begin(), corners.size()));
  }
  /// Errors: invalid_value for a face that is not there. Cost: linear in its corners.
  Status remove_face(FaceId f);

  /// The mesh as it is now: faces in the order of their numbers, without the removed ones. Vertices without faces stay.
  /// Errors: out_of_memory. Cost: linear expected.
  Result<PolygonMesh> mesh() const;
  /// The same as a mesh of triangles. Errors: also invalid_value if a face is no triangle.
  Result<TriangleMesh> triangle_mesh() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace algebra3d::mesh
