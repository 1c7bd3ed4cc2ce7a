#pragma once

#include <cstddef>
#include <memory>

#include "algebra3d/base/error.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/mesh/mesh.h"

namespace algebra3d::mesh {

/// A manifold mesh, with or without boundary, whose elements can be changed. Vertices, half-edges and faces have the
/// numbers of the mesh that it was made of, and keep them; numbers of removed elements are used again. A boundary edge
/// has a second half-edge here, without a face: these run around the boundary loops, so every half-edge has an
/// opposite.
///
/// Edits keep the surface a manifold with the same components, handles and boundary loops, with three or more corners
/// per face and one edge at most between two vertices. An edit that would break this is refused: the error
/// invalid_value with the reason, and nothing has changed. Handles that are not in use are errors, too. Geometry is not
/// looked at. The caller owns the object; one thread uses it at a time. One that was moved from may be assigned to and
/// destroyed, nothing else.
class MeshEditor {
 public:
  /// Errors: invalid_value, with the reason, if the mesh is not a manifold. Cost: linear.
  static Result<MeshEditor> of(const PolygonMesh& mesh);
  static Result<MeshEditor> of(const TriangleMesh& mesh);
  MeshEditor(MeshEditor&&) noexcept;
  MeshEditor& operator=(MeshEditor&&) noexcept;
  ~MeshEditor();

  /// The mesh as it is now: faces and vertices in the order of their numbers, without the unused numbers; elements that
  /// stayed have their attributes, and new ones those of the elements that they were part of (docs/halfedge.md).
  /// Errors: out_of_memory. Cost: linear.
  Result<PolygonMesh> mesh() const;
  /// The same as a mesh of triangles. Errors: also invalid_value if a face is no triangle.
  Result<TriangleMesh> triangle_mesh() const;

  std::size_t vertex_count() const;
  std::size_t edge_count() const;
  std::size_t face_count() const;
  bool is_used(VertexId v) const;
  bool is_used(HalfedgeId h) const;
  bool is_used(FaceId f) const;

  // Navigation, for handles in use (asserted).
  HalfedgeId next(HalfedgeId h) const;
  HalfedgeId prev(HalfedgeId h) const;
  HalfedgeId opposite(HalfedgeId h) const;
  VertexId origin(HalfedgeId h) const;
  VertexId target(HalfedgeId h) const;
  /// Invalid beyond the boundary.
  FaceId face(HalfedgeId h) const;
  HalfedgeId halfedge(FaceId f) const;
  /// A half-edge that leaves `v`, one without a face if there is one; invalid at isolated vertices.
  HalfedgeId outgoing(VertexId v) const;
  /// The half-edge from one vertex to another; invalid if no edge joins them. Cost: linear in the edges at `from`.
  HalfedgeId find_halfedge(VertexId from, VertexId to) const;
  const Vec3& point(VertexId v) const;

  /// Turns an edge between two faces counter-clockwise: its ends move to the next corners of the two faces.
  Result<HalfedgeId> flip_edge(HalfedgeId h);
  /// Puts a vertex into an edge, and in each triangle along it an edge from the vertex to the third corner; other faces
  /// get one corner more. `h` ends in the new vertex.
  Result<VertexId> split_edge(HalfedgeId h, const Vec3& point);
  /// Merges the ends of an edge into its origin, which stays where it is; triangles along it vanish. Refused unless the
  /// link condition holds. Source: [dey1999].
  Result<VertexId> collapse_edge(HalfedgeId h);
  /// Joins two corners of a face by an edge. The part that begins at the first corner keeps the number.
  Result<FaceId> split_face(FaceId f, VertexId from, VertexId to);
  /// Puts a vertex into a face and joins it to all corners.
  Result<VertexId> split_face(FaceId f, const Vec3& point);
  /// Makes an edge of a vertex: the half-edges that leave it from `first` on, counter-clockwise up to but without
  /// `last`, leave the new vertex afterwards. This reverses a collapse.
  Result<VertexId> split_vertex(VertexId v, HalfedgeId first, HalfedgeId last, const Vec3& point);
  Status move_vertex(VertexId v, const Vec3& point);

 private:
  struct Content;
  explicit MeshEditor(std::unique_ptr<Content> content);
  std::unique_ptr<Content> content_;
};

}  // namespace algebra3d::mesh
