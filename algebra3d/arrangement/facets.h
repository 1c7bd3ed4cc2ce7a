#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/arrangement/disjoint_sets.h"
#include "algebra3d/arrangement/operands.h"
#include "algebra3d/arrangement/planes_of_faces.h"

namespace algebra3d::arrangement {

/// A maximal set of faces of one operand that lie in one plane and hang together across manifold edges. Its inner
/// edges are artificial: whoever triangulated it otherwise would have other ones, so nothing is computed from them.
/// Two facets of one operand may follow each other in one plane, across a non-manifold edge: then their planes have one
/// number, since the result may lose what else is at the edge, and they become one.
struct Facet {
  std::uint32_t operand;
  std::uint32_t plane;        ///< facets of one plane number were found coplanar; see Planes
  int orientation;            ///< 1 if the facet's front is the front of its plane, else -1
  std::uint32_t first, last;  ///< its faces: a range of Facets::faces
};

/// A plane with facets in it. Its front is where the projected coordinates turn counter-clockwise.
struct Plane {
  TriangleRef triangle;  ///< some input triangle in it, never a constructed one; counter-clockwise in the projection
  Projection projection;
  IntegerPlane exact;  ///< null if nobody has asked for it so far
};

/// The facets that take part in an arrangement: those with a face that touches another operand.
class Facets {
 public:
  explicit Facets(const Operands& operands)
      : operands_(operands),
        of_face_(operands.face_count(), kNone),
        planes_of_faces_(operands),
        has_boundary_origin_(3 * std::size_t{operands.face_count()}) {}

  /// Makes the face's facet, unless it is there. Cost: linear in the faces of a new facet.
  std::uint32_t add(std::uint32_t face);
  /// The two lie in one plane.
  void join_planes(std::uint32_t a, std::uint32_t b) { planes_of_facets_.unite(a, b); }
  /// Numbers the planes and sets `plane` and `orientation` of all facets. Call once, after the last join.
  void number_planes();

  std::size_t size() const { return facets_.size(); }
  /// Of all facets together.
  std::size_t face_count() const { return faces_.size(); }
  const Facet& operator[](std::uint32_t facet) const { return facets_[facet]; }
  std::span<const std::uint32_t> faces(std::uint32_t facet) const {
    return std::span(faces_).subspan(facets_[facet].first, facets_[facet].last - facets_[facet].first);
  }
  const std::vector<Plane>& planes() const { return planes_; }
  /// The plane by its numbers, which are kept.
  const IntegerPlane& exact_plane(std::uint32_t plane) {
    if (planes_[plane].exact.is_null()) planes_[plane].exact = IntegerPlane::through(planes_[plane].triangle);
    return planes_[plane].exact;
  }
  /// Makes these, with two threads if they are many.
  void make_exact_planes(std::vector<std::uint32_t> planes);
  /// The same, which are made anew if they are not there.
  IntegerPlane exact_plane(std::uint32_t plane) const {
    return planes_[plane].exact.is_null() ? IntegerPlane::through(planes_[plane].triangle) : planes_[plane].exact;
  }
  /// The plane of a face, which is made if it is new.
  const IntegerPlane& plane_of_face(std::uint32_t face) { return planes_of_faces_.get(face); }
  /// Null if it is not there.
  const IntegerPlane* known_plane_of_face(std::uint32_t face) const { return planes_of_faces_.find(face); }
  /// kNone for a face that touches nothing.
  std::uint32_t of_face(std::uint32_t face) const { return of_face_[face]; }
  std::span<const std::uint32_t> of_all_faces() const { return of_face_; }

  /// True unless the faces on both sides of the edge are of one facet.
  bool is_boundary(std::uint32_t halfedge) const {
    const std::uint32_t other = operands_.opposite(halfedge);
    return other == kNone || of_face_[other / 3] != of_face_[halfedge / 3];
  }
  /// True unless the origin lies inside the facet of the half-edge's own face.
  /// The face must be in a facet.
  bool has_boundary_origin(std::uint32_t halfedge);

 private:
  enum : std::uint8_t { kUnknown, kNo, kYes };

  bool finds_boundary_at_origin(std::uint32_t halfedge) const;
  bool is_coplanar_across(std::uint32_t halfedge, std::uint32_t other) const;
  bool are_coplanar_at(std::uint32_t halfedge, std::uint32_t other) const;
  void join_planes_across_nonmanifold_edges();

  const Operands& operands_;
  std::vector<std::uint32_t> of_face_;
  PlanesOfFaces planes_of_faces_;
  std::vector<std::uint32_t> faces_;  // facet by facet
  std::vector<Facet> facets_;
  std::vector<Plane> planes_;
  DisjointSets planes_of_facets_{0};
  std::vector<std::uint8_t> has_boundary_origin_;  // per half-edge, once it was asked for
};

}  // namespace algebra3d::arrangement
