#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/attribute_transfer.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "base/indices.h"

namespace algebra3d {

/// A manifold mesh of polygons, with or without boundary, whose elements can be changed: every half-edge has its next,
/// previous and opposite half-edge, origin and face stored. Boundary edges have a second half-edge without a face;
/// these run around the boundary loops. Edits take constant time, or time proportional to the degrees of the faces and
/// vertices at the place. Elements keep their numbers; those of removed elements are used again, the last one first.
///
/// Invariants, which `audit` checks: the surface stays a manifold with the same components, handles and boundary loops;
/// every face has at least three corners; no two edges have the same ends. An edit that would break one is refused with
/// the reason, and changes nothing. Geometry is not looked at: faces may become bent or flat. The caller owns the
/// object; one thread uses it at a time.
class MeshEditor {
 public:
  /// From a mesh, with the same numbers of vertices, half-edges and faces. Undefined, with the reason, if the mesh is
  /// not a manifold. Cost: linear.
  static Maybe<MeshEditor> of(const PolygonMesh& mesh);
  /// The mesh as it is now: faces and vertices in the order of their numbers, without the unused numbers. Vertices that
  /// were isolated stay. Cost: linear.
  PolygonMesh mesh() const;
  /// The attributes of `result`, the mesh as it is now, from those of `source`, the mesh that this object was made
  /// from. Elements that stay keep theirs. New ones have those of the element that they were part of: both parts of an
  /// edge or face those of the whole; a vertex in an edge, and its corners, the mean of the ends by its place in the
  /// edge; a vertex that was split off and its corners those of the vertex. New edges have none. Of two edges that
  /// become one, the one at the vertex that stays counts. Corners of vertices that were merged: see taken_over_merged.
  /// Cost: linear.
  MeshAttributes attributes(const MeshAttributes& given, const PolygonMesh& source, const PolygonMesh& result) const;

  std::size_t vertex_count() const { return points_.size() - free_vertices_.size(); }
  std::size_t edge_count() const { return (halfedges_.size() - free_halfedges_.size()) / 2; }
  std::size_t face_count() const { return faces_.size() - free_faces_.size(); }
  /// The numbers of elements are below these; some may be unused.
  std::size_t vertex_slots() const { return points_.size(); }
  std::size_t halfedge_slots() const { return halfedges_.size(); }
  std::size_t face_slots() const { return faces_.size(); }
  bool is_used(VertexId v) const { return vertices_[v.index()].is_used; }
  bool is_used(HalfedgeId h) const { return halfedges_[h.index()].next.is_valid(); }
  bool is_used(FaceId f) const { return faces_[f.index()].is_valid(); }

  HalfedgeId next(HalfedgeId h) const { return halfedges_[h.index()].next; }
  HalfedgeId prev(HalfedgeId h) const { return halfedges_[h.index()].prev; }
  HalfedgeId opposite(HalfedgeId h) const { return halfedges_[h.index()].opposite; }
  VertexId origin(HalfedgeId h) const { return halfedges_[h.index()].origin; }
  VertexId target(HalfedgeId h) const { return origin(opposite(h)); }
  /// Invalid beyond the boundary.
  FaceId face(HalfedgeId h) const { return halfedges_[h.index()].face; }
  bool is_boundary(HalfedgeId h) const { return !face(h).is_valid(); }
  HalfedgeId halfedge(FaceId f) const { return faces_[f.index()]; }
  /// A half-edge that leaves `v`, without a face if there is one; invalid at isolated vertices.
  HalfedgeId outgoing(VertexId v) const { return vertices_[v.index()].outgoing; }
  const ExactPoint& point(VertexId v) const { return points_[v.index()]; }
  std::size_t degree(FaceId f) const;
  std::size_t valence(VertexId v) const;
  /// The half-edge from one vertex to another; invalid if no edge joins them.
  HalfedgeId find(VertexId from, VertexId to) const;

  // The edits. Half-edges, faces and vertices that are passed must be in use. Undefined, with the reason, if the edit
  // would break an invariant; then nothing has changed.

  /// Turns an edge between two faces counter-clockwise: its ends move to the next corners of the two faces. Refused at
  /// the boundary; if one face is on both sides; where an end would be left with one edge; if an edge joins those
  /// corners already, or they are one.
  Maybe<HalfedgeId> flip_edge(HalfedgeId h);
  /// Puts a vertex into an edge, and in each triangle along it an edge from the vertex to the third corner, unless that
  /// of the other triangle is the same; faces of more corners get one corner more, or two if they are on both sides.
  /// `h` ends in the new vertex. `share`: the place of the vertex in the edge for its attributes, from 0 at the origin
  /// to 1. Always possible.
  VertexId split_edge(HalfedgeId h, const ExactPoint& point, double share);
  /// Splits the edge at the point; the share is that of the nearest place on the edge, rounded.
  VertexId split_edge(HalfedgeId h, const ExactPoint& point);
  /// Merges the ends of an edge into its origin, which stays where it is; triangles along it vanish. Refused unless the
  /// link condition holds: if a vertex is joined to both ends that is not a corner of a triangle along the edge; if the
  /// edge is inside and both ends are on the boundary; if one face is on both sides; if the third corner of a triangle
  /// has no edge besides; of a tetrahedron. Source: [dey1999].
  Maybe<VertexId> collapse_edge(HalfedgeId h);
  /// Joins two corners of a face by an edge. The part that begins at the first corner, in the order of the face, keeps
  /// the number. Of a vertex that is several corners of the face, the first one counts. Refused unless both are corners
  /// of the face, not neighbours in it, and not joined by an edge.
  Maybe<FaceId> split_face(FaceId f, VertexId from, VertexId to);
  /// Puts a vertex into a face and joins it to all corners: n triangles, of which the one at the first edge keeps the
  /// number. The values of the vertex and of its corners are means of those of the corners of the face, by the mean
  /// value coordinates of the point [floater2003]; in a triangle these are its barycentric ones. Refused if a vertex is
  /// two corners of the face.
  Maybe<VertexId> split_face(FaceId f, const ExactPoint& point);
  /// Makes an edge of a vertex: the half-edges that leave it from `first` on, counter-clockwise up to but without
  /// `last`, leave the new vertex, at `point`, afterwards. A triangle to the right of `first` or `last` becomes two, so
  /// that both vertices are joined to the other end of that edge; faces of more corners get a corner more. Refused
  /// unless both leave the vertex, and are two. This reverses a collapse.
  Maybe<VertexId> split_vertex(VertexId v, HalfedgeId first, HalfedgeId last, const ExactPoint& point);
  /// Always possible.
  void move_vertex(VertexId v, const ExactPoint& point) { points_[v.index()] = point; }

  /// Every violated invariant of this object, a sentence each; empty if all hold. Cost: n log n.
  std::vector<std::string> audit() const;

 private:
  friend struct MeshEditorTester;  // damages an object, to see that `audit` finds it

  // The sources are elements of the mesh that this object was made from, or blends of them, or kNone.
  struct Halfedge {
    HalfedgeId next, prev, opposite;
    VertexId origin;
    FaceId face;
    std::uint32_t corner = kNone;  // the source of the corner
    std::uint32_t along = kNone;   // a half-edge along the source of the edge
  };
  struct Vertex {
    HalfedgeId outgoing;
    bool is_used = true;
    std::uint32_t source = kNone;
  };

  MeshEditor() = default;
  void take(const PolygonMesh& mesh);
  void add_boundary(const PolygonMesh& mesh);

  HalfedgeId new_edge();
  VertexId new_vertex(const ExactPoint& point, std::uint32_t source);
  FaceId new_face(HalfedgeId h, FaceId part_of);
  ElementSources sources(const PolygonMesh& source, const PolygonMesh& result) const;
  /// The source of the corner at a share of the way from the one that `h` leaves to the next one; of none if there is
  /// no face.
  std::uint32_t corner_between(HalfedgeId h, double share);
  /// The half-edges of a face, from its first.
  std::vector<HalfedgeId> halfedges_around(FaceId f) const;
  void free_edge(HalfedgeId h);
  void connect(HalfedgeId h, HalfedgeId to);
  /// Makes a half-edge without a face that of the vertex, if there is one.
  void settle(VertexId v, HalfedgeId any);
  void cut_triangle(HalfedgeId h);
  void remove_digon(HalfedgeId h);
  /// The other ends of the edges at a vertex that has some, ascending.
  std::vector<VertexId> neighbours(VertexId v) const;
  std::string link_violation(HalfedgeId h) const;
  std::string wing_violation(HalfedgeId h) const;

  void audit_halfedges(std::vector<std::string>& found) const;
  void audit_edges(std::vector<std::string>& found) const;
  void audit_faces(std::vector<std::string>& found) const;
  void audit_vertices(std::vector<std::string>& found) const;

  std::vector<Halfedge> halfedges_;  // next is invalid at unused ones
  std::vector<HalfedgeId> faces_;    // invalid at unused ones
  std::vector<std::uint32_t> face_sources_;
  std::vector<Vertex> vertices_;
  std::vector<ExactPoint> points_;
  std::vector<HalfedgeId> free_halfedges_;  // in pairs
  std::vector<FaceId> free_faces_;
  std::vector<VertexId> free_vertices_;
  ElementBlends blends_;
};

}  // namespace algebra3d
