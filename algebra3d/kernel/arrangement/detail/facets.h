#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/operands.h"
#include "algebra3d/kernel/arrangement/detail/pair_contacts.h"
#include "algebra3d/kernel/arrangement/detail/slice.h"
#include "algebra3d/kernel/exact/integer_plane.h"

namespace algebra3d::arrangement {

/// A coplanar facet: a maximal set of faces of one operand that lie in one plane and are connected across manifold
/// edges. Its inner edges, between two of its faces, depend on the triangulation, so nothing is constructed from them.
/// Two facets of one operand may be neighbours in one plane, across a non-manifold edge. Then they have one PlaneId,
/// since the result may drop the other faces at that edge, and then the two become one facet.
struct Facet {
  OperandId operand;
  PlaneId plane;
  int orientation;  ///< 1 if the facet's front is the front of its plane, else -1
  Slice faces;      ///< of Facets::faces
};

/// A plane with facets in it. Its front is the side from which the corners of `triangle` are seen counter-clockwise.
struct Plane {
  const TriangleMesh* mesh;
  FaceId face;  ///< of the mesh; a triangle in the plane, never a constructed one
  Projection projection;
  bool is_clockwise;          ///< the face is clockwise in the projection
  IntegerPlane coefficients;  ///< null unless they were known for one of its faces

  /// The corners of the face, counter-clockwise in the projection: two are exchanged if the face is clockwise there.
  TriangleRef triangle() const {
    TriangleRef corners = mesh->corners(face);
    if (is_clockwise) std::swap(corners[1], corners[2]);
    return corners;
  }
};

/// Output of stage 3: the coplanar facets that take part in an arrangement, which are those with a face that touches
/// another operand, and their planes.
struct Facets {
  IdVector<InputFaceId, FacetId> of_face;  ///< none for a face whose whole facet touches no other operand
  std::vector<InputFaceId> faces;          ///< facet by facet
  IdVector<FacetId, Facet> facets;
  /// Facets that touch and are coplanar share a plane. Equal planes may have two ids if none of their facets touch.
  IdVector<PlaneId, Plane> planes;

  IdRange<FacetId> ids() const { return facets.ids(); }
  const Facet& operator[](FacetId facet) const { return facets[facet]; }
  const Plane& plane_of(FacetId facet) const { return planes[facets[facet].plane]; }
  std::span<const InputFaceId> faces_of(FacetId facet) const { return facets[facet].faces.of(faces); }
  /// True unless the faces on both sides of the edge are of one facet. The half-edge's face must be in a facet.
  bool is_boundary(const Operands& operands, InputHalfedgeId halfedge) const {
    const InputHalfedgeId other = operands.opposite(halfedge);
    return other.is_none() || of_face[Operands::face(other)] != of_face[Operands::face(halfedge)];
  }
};

/// Stage 3: makes the facets of all faces that touch. Exact. Cost: linear in the faces of these facets and in the
/// contacts.
Facets make_facets(const Operands& operands, const PairContacts& contacts);
/// Makes the facets of all faces, whether they touch or not. For CoplanarFacets (coplanar_facets.h), which is not an
/// arrangement.
Facets make_facets_of_all_faces(const Operands& operands);

/// Every violated invariant, one sentence each: the faces of a facet are listed once, are of its operand, lie in its
/// plane and look to its side; no facet goes on across a manifold edge; the triangle of a plane turns counter-clockwise
/// in the projection and lies in the plane of the coefficients. Cost: linear, with exact predicates.
std::vector<std::string> audit(const Operands& operands, const Facets& facets);

}  // namespace algebra3d::arrangement
