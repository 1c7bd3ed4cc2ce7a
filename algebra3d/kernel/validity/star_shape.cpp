// Why backs turned to a point, edges of two triangles each, and a single triangle above the point prove a valid volume.
//
// Let (1) two triangles run along each edge, in opposite directions, (2) the point c lie strictly behind each triangle,
// and (3) one ray from c, which meets no edge, meet one triangle. Project everything from c to the sphere of
// directions. By (2) each triangle becomes a spherical triangle that turns counter-clockwise and is smaller than a
// hemisphere, one to one, and so do its edges become arcs and its corners points.
//
// (a) Every direction that lies on no arc is covered once. Where a path crosses one edge's arc apart from corners it
// leaves one of the edge's two triangles and enters the other: both turn counter-clockwise and have the arc in opposite
// directions, so they lie on different sides of it. That holds for each of several arcs that are crossed in one place.
// So the number of triangles over a direction does not change, paths round the finitely many corners lead everywhere,
// and (3) says that it is 1.
// (b) Hence the insides of different spherical triangles are disjoint, since common parts of their insides are open. A
// direction inside a triangle belongs to no other one, as that would have inner points near it. A direction on an arc,
// apart from corners, belongs to the two triangles of that edge alone, which fill the surroundings of the direction.
// (c) Round a corner v the triangles follow each other across edges, by (1) in one or more cycles, and each cycle goes
// round the direction of v at least once, since all its triangles turn counter-clockwise. By (a) all cycles over one
// direction together go round once: so there is one cycle, about one vertex. Hence no two vertices with triangles have
// one direction; in particular their points differ.
// (d) So a ray from c meets the boundary in one point, and the intersection of two triangles is, by (b) and (c), empty,
// one common corner, or one common edge. Not two edges: such triangles would have the same corners and, by (1), would
// turn differently. So the mesh is a valid surface. The part of the ray before the boundary is the inside: it is behind
// the triangle, and all of it is the same room, round c. The winding number there is 1 by (a), and 0 beyond.
//
// For a valid volume all of whose triangles turn their backs to c, (1) and (3) hold as well: a ray passes the boundary
// from within to the outside only, so once; and so does one beside an edge, which leaves room for two triangles at it.
//
// (3) is asked of the ray upwards from c, moved by (e, e^2, 0) for an e smaller than any number. Behind all planes
// the moved point is as well.

#include "algebra3d/kernel/validity/star_shape.h"

#include "algebra3d/kernel/exact/vertical_line.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

/// False means that the triangle lies beside or below the ray upwards from the centre. Rounded coordinates decide:
/// rounding exchanges no two numbers.
bool may_be_above(const TriangleRef& t, const Vec3& centre) {
  const auto are_less = [&](std::size_t axis) {
    return t[0].approx[axis] < centre[axis] && t[1].approx[axis] < centre[axis] && t[2].approx[axis] < centre[axis];
  };
  const auto are_greater = [&](std::size_t axis) {
    return t[0].approx[axis] > centre[axis] && t[1].approx[axis] > centre[axis] && t[2].approx[axis] > centre[axis];
  };
  return !(are_less(0) || are_greater(0) || are_less(1) || are_greater(1) || are_less(2));
}

bool has_two_triangles_along_each_edge(const TriangleMesh& mesh, FaceId face) {
  for (std::uint32_t corner = 0; corner < 3; ++corner)
    if (!mesh.opposite(TriangleMesh::halfedge(face, corner)).is_valid()) return false;
  return true;
}

}  // namespace

bool is_star_shaped(const TriangleMesh& mesh, const PointRef& centre) {
  int above = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    if (!has_two_triangles_along_each_edge(mesh, FaceId(f))) return false;
    const TriangleRef corners = mesh.corners(FaceId(f));
    if (orient3d(corners[0], corners[1], corners[2], centre) >= 0) return false;
    if (may_be_above(corners, centre.approx) && cross_vertical_line(centre, corners).side < 0 && ++above > 1)
      return false;
  }
  return above == 1;
}

}  // namespace algebra3d
