#include "algebra3d/values/spatial_relations/detail/mesh_relation.h"

#include <array>
#include <cassert>
#include <optional>
#include <vector>

#include "algebra3d/kernel/exact/intersection_point.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/search/node_gaps.h"
#include "algebra3d/kernel/search/slab_gaps.h"
#include "algebra3d/values/spatial_relations/detail/half_plane.h"

namespace algebra3d {
namespace {

std::optional<ExactPoint> common_corner(const TriangleRef& of, const TriangleRef& with) {
  for (const PointRef& corner : of)
    if (is_on_triangle(corner, with)) return ExactPoint(corner);
  return std::nullopt;
}

/// Where an edge of one triangle passes through the other, which lies in another plane.
std::optional<ExactPoint> crossing_of_edge(const TriangleRef& of, const TriangleRef& with) {
  for (std::size_t i = 0; i < 3; ++i) {
    const PointRef &p = of[i], &q = of[(i + 1) % 3];
    if (intersect_segment_triangle(p, q, with) == Contact::point)
      return intersect_line_plane(p, q, IntegerPlane::through(with));
  }
  return std::nullopt;
}

std::size_t axis_of(Projection plane) {
  return 3 - first_axis(plane) - second_axis(plane);
}

/// Where two edges cross of which no one ends in the other triangle.
std::optional<ExactPoint> crossing_of_coplanar_edges(const TriangleRef& s, const TriangleRef& t) {
  const std::size_t axis = axis_of(dominant_projection(s[0], s[1], s[2]));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const PointRef &p = s[i], &q = s[(i + 1) % 3], &u = t[j], &v = t[(j + 1) % 3];
      if (intersect_segments(p, q, u, v) == Contact::point)
        return intersect_line_plane(p, q, IntegerPlane::along_axis(u, v, axis));
    }
  return std::nullopt;
}

/// A point of the intersection of two triangles, which must not be empty: a corner of one of them if a corner is in the
/// intersection, else a crossing of an edge. Exact.
ExactPoint common_point(const TriangleRef& s, const TriangleRef& t, const SidedContact& contact) {
  std::optional<ExactPoint> point = common_corner(s, t);
  if (!point) point = common_corner(t, s);
  if (!point && contact.is_coplanar()) point = crossing_of_coplanar_edges(s, t);
  if (!point) point = crossing_of_edge(s, t);
  if (!point) point = crossing_of_edge(t, s);
  assert(point);
  return *point;
}

using Sides = std::array<int, 3>;

constexpr std::array<std::size_t, 3> kNext{1, 2, 0};

int dimension_of(Contact contact) {
  return static_cast<int>(contact) - 1;
}

/// The half-edge of a face whose ends are its two corners with side 0; invalid if it has not exactly two.
HalfedgeId edge_in_plane(FaceId face, const Sides& sides) {
  for (auto i = 0U; i < 3; ++i)
    if (sides[i] == 0 && sides[kNext[i]] == 0 && sides[kNext[kNext[i]]] != 0) return TriangleMesh::halfedge(face, i);
  return {};
}

/// Triangles of both sets that have a point in common.
struct FacePairContact {
  std::array<FaceId, 2> faces;
  std::array<TriangleRef, 2> corners;
  SidedContact contact;

  /// The sides on which the corners of one triangle lie of the plane of the other.
  const Sides& sides(Role role) const { return role == Role::first ? contact.s_sides : contact.t_sides; }
};

class MeshRelation {
 public:
  MeshRelation(const MeshSet& first, const MeshSet& second, Findings& findings, const Monitor& monitor)
      : sets_{first, second}, findings_(findings), monitor_(monitor) {}

  void run();

 private:
  const MeshSet& set(Role role) const { return sets_[index_of(role)]; }
  void compare_extents();
  void compare_faces();
  bool visit(FaceId f, FaceId g);
  MeetingWitness witness(const FacePairContact& pair) const;
  void visit_point(const FacePairContact& pair);
  void visit_segment(const FacePairContact& pair);
  void visit_coplanar(const FacePairContact& pair);
  void visit_edge_in_plane(const FacePairContact& pair, Role role, HalfedgeId of_other);
  void add_overlapping_area(const FacePairContact& pair);
  void add_common_line(HalfedgeId first, HalfedgeId second);
  void compare_boundaries(const FacePairContact& pair);
  void note_line_contact(const FacePairContact& pair);
  bool is_known(Role role) const;
  void add_part(Role role, Placement placement);
  void locate_components(Role role);
  void locate(Role role, EdgeComponentId component);

  std::array<MeshSet, 2> sets_;
  Findings& findings_;
  const Monitor& monitor_;
  std::array<std::vector<bool>, 2> has_line_contact_;  // of each component; empty: none has
};

void MeshRelation::run() {
  compare_extents();
  if (findings_.is_complete() || !set(Role::first).geometry->box.intersects(set(Role::second).geometry->box)) return;
  compare_faces();
  for (const Role role : kRoles)
    if (!findings_.is_complete() && !monitor_.is_cancelled()) locate_components(role);
}

/// Adds the facts that follow from dimensions and boxes. A box is the smallest around its set, so a set whose box is
/// not within that of another is not inside it.
void MeshRelation::compare_extents() {
  for (const Role role : kRoles) {
    const MeshSet &own = set(role), &its_other = set(other(role));
    if (own.dimension() > its_other.dimension() || !its_other.geometry->box.contains(own.geometry->box))
      findings_.add_leaving(role);
  }
}

void MeshRelation::compare_faces() {
  const Geometry &first = *set(Role::first).geometry, &second = *set(Role::second).geometry;
  NodeGaps gaps(first.mesh, first.hierarchy(), second.mesh, second.hierarchy());
  SlabGaps slab_gaps(first.mesh, first.hierarchy(), second.mesh, second.hierarchy());
  first.hierarchy().for_each_pair_with(
      second.hierarchy(),
      [&](auto f, auto g) {
        gaps.note_visit();
        return visit(FaceId(f), FaceId(g));
      },
      [&](BoxHierarchy::Node m, BoxHierarchy::Node n) { return slab_gaps.exceed(m, n, 0) || gaps.exceed(m, n, 0); },
      [this] { return !monitor_.is_cancelled(); }, {0, 1});
}

/// Returns whether to go on.
bool MeshRelation::visit(FaceId f, FaceId g) {
  FacePairContact pair{{f, g}, {sets_[0].mesh().corners(f), sets_[1].mesh().corners(g)}, {}};
  const auto& [s, t] = pair.corners;
  pair.contact = contact_of_triangles(s, t);
  const Contact kind = pair.contact.kind;
  if (kind == Contact::none) return true;
  findings_.add_common(dimension_of(kind));
  if (findings_.wants_witness()) findings_.add_witness(witness(pair));
  if (findings_.is_complete()) return false;
  if (findings_.wants_boundaries()) compare_boundaries(pair);
  if (kind == Contact::point) {
    visit_point(pair);
  } else {
    note_line_contact(pair);
    pair.contact.is_coplanar() ? visit_coplanar(pair) : visit_segment(pair);
  }
  return !findings_.is_complete();
}

/// A face of a mesh in which a point lies; invalid if there is none.
FaceId face_with(const PointRef& point, const Geometry& geometry) {
  FaceId result;
  geometry.hierarchy().for_each_meeting(box_of(point), [&](auto face) {
    if (is_on_triangle(point, geometry.mesh.corners(FaceId(face)))) result = FaceId(face);
    return !result.is_valid();
  });
  return result;
}

/// A corner of one of the two faces if one lies in the other set, whichever face of that has it: people know vertices
/// of their parts again, and their coordinates are short.
MeetingWitness MeshRelation::witness(const FacePairContact& pair) const {
  for (const Role role : kRoles)
    for (const PointRef& corner : pair.corners[index_of(role)]) {
      const FaceId of_other = face_with(corner, *set(other(role)).geometry);
      if (!of_other.is_valid()) continue;
      std::array<FaceId, 2> faces = pair.faces;
      faces[index_of(other(role))] = of_other;
      return {ExactPoint(corner), faces[0], faces[1]};
    }
  return {common_point(pair.corners[0], pair.corners[1], pair.contact), pair.faces[0], pair.faces[1]};
}

/// Surfaces that touch in a point: their interiors meet unless it is on a boundary edge of one of them, perhaps one of
/// another face. (If a solid is touched in a point, nothing follows.)
void MeshRelation::visit_point(const FacePairContact& pair) {
  if (sets_[0].is_solid || sets_[1].is_solid || findings_.do_interiors_meet()) return;
  const ExactPoint point = common_point(pair.corners[0], pair.corners[1], pair.contact);
  if (sets_[0].place(point) == Placement::inside && sets_[1].place(point) == Placement::inside)
    findings_.add_common_interior(0);
}

/// Triangles in different planes with a common segment, which is part of an edge of each, or leads through its inside.
void MeshRelation::visit_segment(const FacePairContact& pair) {
  std::array<HalfedgeId, 2> edges;
  for (const Role role : kRoles) edges[index_of(role)] = edge_in_plane(pair.faces[index_of(role)], pair.sides(role));
  add_common_line(edges[0], edges[1]);
  for (const Role role : kRoles) {
    if (is_known(role)) continue;
    const HalfedgeId of_other = edges[index_of(other(role))];
    for (std::size_t i = 0; i < 3; ++i) {
      const int side = pair.sides(role)[i];
      if (side == 0) continue;
      if (of_other.is_valid())
        add_part(role, place_half_plane(set(other(role)), of_other, pair.corners[index_of(role)][i]));
      else
        add_part(role, side < 0 && set(other(role)).is_solid ? Placement::inside : Placement::outside);
    }
  }
}

void MeshRelation::visit_coplanar(const FacePairContact& pair) {
  if (pair.contact.kind == Contact::area) add_overlapping_area(pair);
  std::array<HalfedgeId, 2> touching;
  for (const Role role : kRoles) {
    const auto& own = pair.corners[index_of(role)];
    const auto& others = pair.corners[index_of(other(role))];
    for (auto i = 0U; i < 3; ++i) {
      if (intersect_segment_triangle(others[i], others[kNext[i]], own) != Contact::segment) continue;
      touching[index_of(other(role))] = TriangleMesh::halfedge(pair.faces[index_of(other(role))], i);
      visit_edge_in_plane(pair, role, touching[index_of(other(role))]);
    }
  }
  if (pair.contact.kind == Contact::segment) add_common_line(touching[0], touching[1]);
}

/// An edge of the other set that runs along a triangle of the set: the triangle may go on on both sides of it.
void MeshRelation::visit_edge_in_plane(const FacePairContact& pair, Role role, HalfedgeId of_other) {
  if (is_known(role)) return;
  const TriangleMesh& mesh = set(other(role)).mesh();
  const PointRef from = mesh.point(mesh.origin(of_other)), to = mesh.point(mesh.target(of_other));
  const auto& own = pair.corners[index_of(role)];
  const Projection plane = dominant_projection(own[0], own[1], own[2]);
  for (const int wanted : {1, -1})
    for (const PointRef& corner : own) {
      if (orient2d(plane, from, to, corner) != wanted) continue;
      add_part(role, place_half_plane(set(other(role)), of_other, corner));
      break;
    }
}

/// Solids with faces upon each other lie on the same side of these or on opposite ones.
void MeshRelation::add_overlapping_area(const FacePairContact& pair) {
  const bool first_is_solid = sets_[0].is_solid, second_is_solid = sets_[1].is_solid;
  if (!first_is_solid && !second_is_solid) return findings_.add_common_interior(2);
  if (!first_is_solid || !second_is_solid) return;
  const auto [plane, turn] = dominant_turn(pair.corners[0]);
  const TriangleRef& t = pair.corners[1];
  if (orient2d(plane, t[0], t[1], t[2]) == turn) return findings_.add_common_interior(3);
  for (const Role role : kRoles) findings_.add_leaving(role);
}

/// Surfaces with a common segment, which is part of these edges if they are valid, else leads through the inside of a
/// face: their interiors meet unless it is boundary of one of them.
void MeshRelation::add_common_line(HalfedgeId first, HalfedgeId second) {
  if (sets_[0].is_solid || sets_[1].is_solid) return;
  const bool is_boundary = (first.is_valid() && sets_[0].mesh().is_boundary(first)) ||
                           (second.is_valid() && sets_[1].mesh().is_boundary(second));
  if (!is_boundary) findings_.add_common_interior(1);
}

/// The dimension of the intersection of the boundaries: of a surface the boundary edges, of a solid the faces.
void MeshRelation::compare_boundaries(const FacePairContact& pair) {
  const bool first_is_solid = sets_[0].is_solid, second_is_solid = sets_[1].is_solid;
  const auto add = [&](Contact contact) { findings_.add_common_boundary(dimension_of(contact)); };
  if (first_is_solid && second_is_solid) return add(pair.contact.kind);
  const Role role = first_is_solid ? Role::second : Role::first;
  const TriangleRef &own = pair.corners[index_of(role)], &others = pair.corners[index_of(other(role))];
  const auto is_boundary = [&](Role of, std::uint32_t i) {
    return set(of).mesh().is_boundary(TriangleMesh::halfedge(pair.faces[index_of(of)], i));
  };
  for (auto i = 0U; i < 3; ++i) {
    if (!is_boundary(role, i)) continue;
    if (set(other(role)).is_solid) {
      add(intersect_segment_triangle(own[i], own[kNext[i]], others));
      continue;
    }
    for (auto j = 0U; j < 3; ++j)
      if (is_boundary(other(role), j)) add(intersect_segments(own[i], own[kNext[i]], others[j], others[kNext[j]]));
  }
}

void MeshRelation::note_line_contact(const FacePairContact& pair) {
  for (const Role role : kRoles) {
    const EdgeComponents& components = set(role).geometry->components();
    std::vector<bool>& known = has_line_contact_[index_of(role)];
    known.resize(components.count());
    known[components.of(pair.faces[index_of(role)]).index()] = true;
  }
}

/// True if no part of the set could add a finding.
bool MeshRelation::is_known(Role role) const {
  if (!findings_.leaves(role)) return false;
  return !set(other(role)).is_solid || (findings_.do_interiors_meet() && findings_.leaves(other(role)));
}

/// Adds what follows from an open part of the surface of a set, or of the set if it is a surface, that lies at
/// `placement`.
void MeshRelation::add_part(Role role, Placement placement) {
  if (placement == Placement::outside) findings_.add_leaving(role);
  if (placement != Placement::inside) return;
  findings_.add_common_interior(set(role).dimension());
  findings_.add_leaving(other(role));
}

void MeshRelation::locate_components(Role role) {
  const EdgeComponents& components = set(role).geometry->components();
  const std::vector<bool>& has_line_contact = has_line_contact_[index_of(role)];
  for (std::size_t i = 0; i < components.count() && !findings_.is_complete() && !is_known(role); ++i) {
    if (!has_line_contact.empty() && has_line_contact[i]) continue;
    if (set(other(role)).is_solid)
      locate(role, EdgeComponentId(i));
    else
      findings_.add_leaving(role);
    if (i % 4096 == 4095 && monitor_.is_cancelled()) return;
  }
}

/// A component that touches the solid in single points at most: it lies where any other point of it lies.
void MeshRelation::locate(Role role, EdgeComponentId component) {
  const EdgeComponents& components = set(role).geometry->components();
  const TriangleRef corners = set(role).mesh().corners(components.first_face(component));
  const auto is_located = [&](const ExactPoint& point) {
    const Placement placement = set(other(role)).place(point);
    if (placement == Placement::boundary) return false;
    add_part(role, placement);
    if (placement == Placement::inside && findings_.wants_witness()) findings_.add_witness({point, {}, {}});
    return true;
  };
  for (const PointRef& corner : corners)
    if (is_located(ExactPoint(corner))) return;
  // Points of the first edge: one of them is not touched.
  const RationalVec3 a = corners[0].rational(), b = corners[1].rational();
  for (std::int64_t n = 2;; ++n) {
    const Rational part(1, n);
    const RationalVec3 point(a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part, a.z + (b.z - a.z) * part);
    if (is_located(ExactPoint(point))) return;
  }
}

}  // namespace

void relate_meshes(const MeshSet& first, const MeshSet& second, Findings& findings, const Monitor& monitor) {
  MeshRelation(first, second, findings, monitor).run();
}

}  // namespace algebra3d
