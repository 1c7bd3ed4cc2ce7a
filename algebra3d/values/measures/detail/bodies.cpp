// Why shells determine bodies.
//
// A shell here is a set of faces that are linked with each other along the inside of the solid: at an edge with two
// faces these, at any other edge each face and the next one behind which the inside goes on. So a shell is a connected
// part of the boundary of the interior, as of the solid shrunk by a hair. Each body has one shell that bounds it from
// outside, which encloses a positive volume, and one for each of its cavities, which enclose negative ones.

#include "algebra3d/values/measures/detail/bodies.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/exact/inner_point.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/values/spatial_relations/point_location.h"
#include "base/disjoint_ids.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

struct Shell {
  std::vector<FaceId> faces;
  TriangleMesh mesh;
  Rational volume;
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

Result<std::vector<Shell>> shells_of(const TriangleMesh& mesh, const Monitor& monitor) {
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
  for (Shell& shell : shells) {
    shell.mesh = maker.make(shell.faces);
    A3D_ASSIGN(shell.volume, exact_volume(shell.mesh.points(), triangles_of(shell.mesh), monitor.cancel()));
  }
  return shells;
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

}  // namespace

Result<std::vector<Volume3d>> bodies_of(const Volume3d& solid, const Monitor& monitor) {
  A3D_ASSIGN(std::vector<Shell> shells, shells_of(solid.mesh(), monitor));
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

Result<bool> has_divided_body(const Volume3d& solid, const TriangleMesh& part, const Monitor& monitor) {
  A3D_ASSIGN(std::vector<Shell> shells, shells_of(part, monitor));
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

}  // namespace algebra3d
