// Why shells determine bodies.
//
// A shell here is a set of faces that are linked with each other along the inside of the solid: at an edge with two
// faces these, at any other edge each face and the next one behind which the inside goes on. So a shell is a connected
// part of the boundary of the interior, as of the solid shrunk by a hair. Each body has one shell that bounds it from
// outside, which encloses a positive volume, and one for each of its cavities, which enclose negative ones.

#include "algebra3d/values/measures/clash.h"

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/distance/farthest_point.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/exact/inner_point.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/values/spatial_relations/boundary_faces.h"
#include "algebra3d/values/spatial_relations/nearest_points.h"
#include "algebra3d/values/spatial_relations/point_location.h"
#include "algebra3d/values/spatial_relations/relation.h"
#include "base/disjoint_ids.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The common part of two solids of which neither is inside the other, as far as a clash needs it.
struct Overlap {
  /// True if one of them divides a body of the other: the rest of the body is not connected.
  bool is_divided = false;
  Surface3d of_first_in_second, of_second_in_first;  ///< the parts of the boundaries in the interior of the other

  /// Exact. Errors: interrupted, limit_exceeded. Cost: that of an arrangement of both.
  static Result<Overlap> of(const Volume3d& a, const Volume3d& b, const Monitor& monitor);
};

struct Shell {
  std::vector<FaceId> faces;
  TriangleMesh mesh;
  Rational volume = {};  ///< after `measure`
};

/// Links the faces at a non-manifold edge. The inside lies behind a face, so in radial order after one that runs
/// backwards along the edge, up to the next one, which runs forwards.
void link_at_edge(const TriangleMesh& mesh, std::span<const HalfedgeId> edge, DisjointIds<FaceId>& linked) {
  const VertexId begin = mesh.origin(edge.front()), end = mesh.target(edge.front());
  const auto third = [&](HalfedgeId h) { return mesh.point(mesh.origin(TriangleMesh::prev(h))); };
  for (const HalfedgeId backward : edge) {
    if (mesh.origin(backward) == begin) continue;
    std::optional<HalfedgeId> next;
    for (const HalfedgeId forward : edge) {
      if (mesh.origin(forward) != begin) continue;
      if (!next ||
          compare_around_edge(mesh.point(begin), mesh.point(end), third(backward), third(forward), third(*next)) < 0)
        next = forward;
    }
    if (next) linked.unite(TriangleMesh::face(backward), TriangleMesh::face(*next));
  }
}

std::vector<Shell> shells_of(const TriangleMesh& mesh) {
  DisjointIds<FaceId> linked(mesh.face_count());
  for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
    const HalfedgeId other = mesh.opposite(HalfedgeId(h));
    if (other.is_valid()) linked.unite(TriangleMesh::face(HalfedgeId(h)), TriangleMesh::face(other));
  }
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) link_at_edge(mesh, mesh.nonmanifold_edge(n), linked);
  std::vector<Shell> shells;
  std::vector<std::size_t> shell_of(mesh.face_count(), SIZE_MAX);  // by the leading face of a set
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::size_t& shell = shell_of[linked.find(FaceId(f)).index()];
    if (shell == SIZE_MAX) {
      shell = shells.size();
      shells.emplace_back();
    }
    shells[shell].faces.emplace_back(f);
  }
  SubmeshMaker maker(mesh);
  for (Shell& shell : shells) shell.mesh = maker.make(shell.faces);
  return shells;
}

/// Exact, which takes microseconds for each triangle whose corners are not doubles.
Status measure(std::vector<Shell>& shells, const Monitor& monitor) {
  for (Shell& shell : shells) {
    A3D_ASSIGN(shell.volume, exact_volume(shell.mesh.points(), triangles_of(shell.mesh), monitor.cancel()));
  }
  return {};
}

/// The boxes of solids, to be searched.
class SolidBoxes {
 public:
  explicit SolidBoxes(std::span<const Volume3d> solids) : corners_(corners_of(solids)), hierarchy_(corners_) {}

  /// Calls visit(i) for each solid whose box may meet the box.
  template <typename Visit>
  void for_each_meeting(const Box3& box, Visit visit) const {
    hierarchy_.for_each_meeting(box, [&](std::uint32_t solid) {
      visit(std::size_t{solid});
      return true;
    });
  }

 private:
  /// A face for each solid, with two corners of its box.
  static TriangleMesh corners_of(std::span<const Volume3d> solids) {
    std::vector<Vec3> points;
    std::vector<TriangleMesh::Triangle> faces;
    for (const Volume3d& solid : solids) {
      const auto first = static_cast<std::uint32_t>(points.size());
      points.push_back(solid.box().min);
      points.push_back(solid.box().max);
      faces.push_back({first, first + 1, first + 1});
    }
    return {PointArray(std::move(points)), faces};
  }

  TriangleMesh corners_;
  BoxHierarchy hierarchy_;
};

/// The body that holds a body of a part of the solid, by a point of a face of that one. Bodies touch in edges only, so
/// a point that two of them hold is replaced by another one.
std::size_t body_around(const Shell& part, std::span<const Volume3d> bodies, const SolidBoxes& boxes) {
  for (int attempt = 0;; ++attempt) {
    const ExactPoint point = inner_point(part.mesh.corners(FaceId(0)), attempt);
    std::vector<std::size_t> holders;
    boxes.for_each_meeting(box_of(point), [&](std::size_t i) {
      if (place_in_solid(point, bodies[i].geometry()) != Placement::outside) holders.push_back(i);
    });
    if (holders.size() == 1) return holders.front();
  }
}

/// True if the wall of a cavity is inside of an outer shell, which it may touch in points and edges.
bool is_within(const Shell& cavity, const Geometry& outer) {
  for (int attempt = 0;; ++attempt) {
    const ExactPoint point = inner_point(cavity.mesh.corners(FaceId(0)), attempt);
    const Placement placement = place_in_solid(point, outer);
    if (placement != Placement::boundary) return placement == Placement::inside;
  }
}

// The bodies of a solid: the connected parts of its interior. Parts that touch in an edge only are different bodies,
// though their faces are connected across that edge.
Result<std::vector<Volume3d>> bodies_of(const Volume3d& solid, const Monitor& monitor) {
  std::vector<Shell> shells = shells_of(solid.mesh());
  if (shells.size() <= 1) return std::vector<Volume3d>(shells.size(), solid);
  A3D_TRY(measure(shells, monitor));
  std::vector<Shell> outer, cavities;
  for (Shell& shell : shells) (shell.volume.sign() > 0 ? outer : cavities).push_back(std::move(shell));
  if (outer.size() <= 1) return std::vector<Volume3d>(outer.size(), solid);
  std::vector<Volume3d> filled;
  filled.reserve(outer.size());
  for (Shell& shell : outer) filled.push_back(Volume3d::trusted(std::move(shell.mesh)));
  const SolidBoxes boxes(filled);
  for (const Shell& cavity : cavities) {
    A3D_TRY(monitor.check());
    // Outer shells around a point are nested; the cavity belongs to the innermost one.
    std::optional<std::size_t> innermost;
    boxes.for_each_meeting(box_of(cavity.mesh.point(VertexId(0))), [&](std::size_t i) {
      if ((!innermost || outer[i].volume < outer[*innermost].volume) && is_within(cavity, filled[i].geometry()))
        innermost = i;
    });
    if (innermost)
      outer[*innermost].faces.insert(outer[*innermost].faces.end(), cavity.faces.begin(), cavity.faces.end());
  }
  std::vector<Volume3d> bodies;
  bodies.reserve(outer.size());
  SubmeshMaker maker(solid.mesh());
  for (const Shell& shell : outer) bodies.push_back(Volume3d::trusted(maker.make(shell.faces)));
  return bodies;
}

/// True if a part of a solid, a valid volume, has two bodies in one body of the solid. Exact. Errors: interrupted.
/// Cost: linear; for each body of the part a ray for each body of the solid whose box holds it.
Result<bool> has_divided_body(const Volume3d& solid, const TriangleMesh& part, const Monitor& monitor) {
  std::vector<Shell> shells = shells_of(part);
  if (shells.size() <= 1) return false;
  A3D_TRY(measure(shells, monitor));
  std::erase_if(shells, [](const Shell& shell) { return shell.volume.sign() <= 0; });
  if (shells.size() <= 1) return false;
  A3D_ASSIGN(const std::vector<Volume3d> bodies, bodies_of(solid, monitor));
  if (bodies.size() == 1) return true;
  const SolidBoxes boxes(bodies);
  std::vector<std::uint8_t> has_part(bodies.size(), 0);
  for (const Shell& shell : shells) {
    A3D_TRY(monitor.check());
    std::uint8_t& flag = has_part[body_around(shell, bodies, boxes)];
    if (flag != 0) return true;
    flag = 1;
  }
  return false;
}

Result<SolidArrangement> arrangement_of(const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  const std::array<Operand, 2> operands{
      {{&a.mesh(), 0, &a.geometry().hierarchy()}, {&b.mesh(), 1, &b.geometry().hierarchy()}}};
  return SolidArrangement::make(operands, monitor);
}

/// The part of the boundary of one group in the interior of the other.
Result<Surface3d> boundary_in_other(const SolidArrangement& arrangement, std::size_t group) {
  const auto is_inside_other = [group](const WindingVector& front, const WindingVector& back) {
    const bool is_boundary = (front[group] > 0) != (back[group] > 0);
    return is_boundary && front[1 - group] > 0 && back[1 - group] > 0 ? 1 : 0;
  };
  A3D_ASSIGN(TriangleMesh part, arrangement.faces(is_inside_other));
  return Surface3d::trusted(std::move(part));
}

/// True if a body of the solid, which is of one group, is divided by the other one.
Result<bool> is_divided(const Volume3d& solid, const SolidArrangement& arrangement, std::size_t group,
                        const Monitor& monitor) {
  const auto is_left = [group](const WindingVector& windings) {
    return windings[group] > 0 && windings[1 - group] == 0;
  };
  A3D_ASSIGN(const TriangleMesh rest, arrangement.solid(is_left));
  return has_divided_body(solid, rest, monitor);
}

Result<Overlap> Overlap::of(const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  A3D_ASSIGN(const SolidArrangement arrangement, arrangement_of(a, b, monitor));
  Overlap overlap;
  A3D_ASSIGN(overlap.of_first_in_second, boundary_in_other(arrangement, 0));
  A3D_ASSIGN(overlap.of_second_in_first, boundary_in_other(arrangement, 1));
  A3D_ASSIGN(overlap.is_divided, algebra3d::is_divided(a, arrangement, 0, monitor));
  if (overlap.is_divided) return overlap;
  A3D_ASSIGN(overlap.is_divided, algebra3d::is_divided(b, arrangement, 1, monitor));
  return overlap;
}

using FoundClash = std::optional<Clash>;

DistanceOperand boundary_of(const Volume3d& solid) {
  return {&solid.mesh(), &solid.geometry().hierarchy()};
}

/// The triangle of a solid that is nearest to a point.
Result<FaceId> triangle_near(const ExactPoint& point, const Volume3d& solid, const Monitor& monitor) {
  const BoundaryFaces place(PointSet{{&point, 1}});
  A3D_ASSIGN(const auto closest, closest_points(place.operand(), boundary_of(solid), monitor));
  return closest->second_face;
}

/// A clash with its depth: that of the deepest point of parts of the boundaries that lie inside the other solid.
Result<FoundClash> with_depth(ClashKind kind, const Volume3d& a, const Volume3d& b, const Surface3d& of_a_in_b,
                              const Surface3d& of_b_in_a, const Monitor& monitor) {
  std::vector<FarthestSearch> searches;
  const auto add = [&](const Surface3d& part, const Volume3d& around) {
    if (!part.mesh().is_empty())
      searches.push_back({{&part.mesh(), &part.geometry().hierarchy()}, boundary_of(around)});
  };
  add(of_a_in_b, b);
  add(of_b_in_a, a);
  A3D_ASSIGN(std::optional<FarthestPoint> deepest, farthest_point(searches, monitor));
  if (!deepest) {
    // They have whole bodies in common.
    A3D_ASSIGN(const std::optional<MeetingWitness> witness, witness_of_meeting(a, b, monitor));
    return FoundClash(Clash{kind, Rational(0), 0, witness->point, witness->first_face, witness->second_face});
  }
  A3D_ASSIGN(const FaceId of_first, triangle_near(deepest->point, a, monitor));
  A3D_ASSIGN(const FaceId of_second, triangle_near(deepest->point, b, monitor));
  return FoundClash(
      Clash{kind, std::move(deepest->squared_distance), 0, std::move(deepest->point), of_first, of_second});
}

Result<FoundClash> envelopment(const Volume3d& a, const Volume3d& b, bool is_first_inside, const Monitor& monitor) {
  const Surface3d inner = Surface3d::trusted((is_first_inside ? a : b).mesh());
  return with_depth(ClashKind::envelopment, a, b, is_first_inside ? inner : Surface3d(),
                    is_first_inside ? Surface3d() : inner, monitor);
}

Result<FoundClash> overlap(const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  A3D_ASSIGN(const Overlap overlap, Overlap::of(a, b, monitor));
  return with_depth(overlap.is_divided ? ClashKind::piercing : ClashKind::protrusion, a, b, overlap.of_first_in_second,
                    overlap.of_second_in_first, monitor);
}

Result<FoundClash> meeting(ClashKind kind, const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  A3D_ASSIGN(const std::optional<MeetingWitness> witness, witness_of_meeting(a, b, monitor));
  return FoundClash(Clash{kind, std::nullopt, 0, witness->point, witness->first_face, witness->second_face});
}

Result<FoundClash> violated_clearance(const Volume3d& a, const Volume3d& b, const Rational& clearance,
                                      const Monitor& monitor) {
  A3D_ASSIGN(const bool is_near, are_within(a, b, clearance, monitor));
  if (!is_near) return FoundClash();
  const Geometry &first = a.geometry(), &second = b.geometry();
  A3D_ASSIGN(std::optional<ClosestPoints> closest,
             closest_points({&first.mesh, &first.hierarchy()}, {&second.mesh, &second.hierarchy()}, monitor));
  if (!closest || closest->squared_distance >= clearance * clearance) return FoundClash();
  return FoundClash(Clash{ClashKind::clearance, std::nullopt, std::move(closest->squared_distance),
                          std::move(closest->first), closest->first_face, closest->second_face});
}

}  // namespace

std::string_view name_of(ClashKind kind) {
  constexpr std::array<std::string_view, 6> kNames{"duplication", "envelopment", "piercing",
                                                   "protrusion",  "touching",    "clearance"};
  return kNames[static_cast<std::size_t>(kind)];
}

Result<std::optional<Clash>> clash_of(const Volume3d& a, const Volume3d& b, const Rational& clearance,
                                      const Monitor& monitor) {
  A3D_ASSIGN(const RelativePosition position, position_of(a, b, monitor));
  if (!position.do_meet) return violated_clearance(a, b, clearance, monitor);
  if (!position.do_interiors_meet) return meeting(ClashKind::touching, a, b, monitor);
  if (position.is_first_inside && position.is_second_inside) return meeting(ClashKind::duplication, a, b, monitor);
  if (position.is_first_inside || position.is_second_inside)
    return envelopment(a, b, position.is_first_inside, monitor);
  return overlap(a, b, monitor);
}

}  // namespace algebra3d
