// Why one question per shell proves the winding number everywhere.
//
// Let the mesh have no degenerate or duplicate triangles, let triangles meet in nothing but single points and whole
// common edges, and let the triangles round each edge alternate in direction. Each is then a cycle, so every point off
// the surface has a winding number, and it changes by one where a triangle is crossed: by going from its front to its
// back it grows by one.
//
// (1) It is the same in front of all of one triangle. Near an inner point of a triangle there is no other triangle,
// except near finitely many points in which others touch it; a path close in front of the triangle avoids these.
// (2) It is the same in front of two triangles that share an edge. Near an inner point of the edge, apart from finitely
// many touched ones, there are only the triangles at the edge. They cut the neighbourhood into sectors, and since they
// alternate, each sector lies either in front of both its triangles or behind both; going round, the number steps up
// and down by one, so it is the same in all the front sectors, and one more in all the others.
// (3) So the number in front of one point of one triangle decides for the whole shell, and 0 there means 1 behind it.
// (4) Every cell of space off the surface is bounded by some triangle, or is all of space, so it has the number 0 or 1
// if all shells pass.

#include "algebra3d/kernel/validity/detail/winding.h"

#include <algorithm>
#include <limits>

#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/validity/detail/front_ray.h"
#include "algebra3d/kernel/validity/shell_tops.h"
#include "base/disjoint_sets.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

constexpr std::size_t kFacesPerLabelling = 32768;

/// Joins the regions that share edges.
DisjointSets connected_regions(const TriangleMesh& mesh, const HeightFields& fields) {
  const FacingRegions& regions = fields.regions();
  const auto region_of = [&](HalfedgeId h) { return regions.of_face[TriangleMesh::face(h)].index(); };
  DisjointSets sets(regions.regions.size());
  for (const HalfedgeId h : fields.borders())
    if (const HalfedgeId opposite = mesh.opposite(h); opposite.is_valid())
      sets.unite(region_of(h), region_of(opposite));
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
    for (const HalfedgeId h : mesh.nonmanifold_edge(n))
      sets.unite(region_of(mesh.nonmanifold_edge(n)[0]), region_of(h));
  return sets;
}

ShellWindings find_shells(const TriangleMesh& mesh, const HeightFields& fields) {
  const FacingRegions& regions = fields.regions();
  DisjointSets sets = connected_regions(mesh, fields);
  ShellWindings shells;
  IdVector<RegionId, std::uint32_t> shell_of_region(regions.regions.size());
  // The lowest region of a set, by which it is represented, has its lowest face.
  for (const RegionId region : regions.regions.ids()) {
    if (const RegionId lowest(sets.find(region.index())); lowest != region) {
      shell_of_region[region] = shell_of_region[lowest];
      continue;
    }
    shell_of_region[region] = static_cast<std::uint32_t>(shells.first_faces.size());
    shells.first_faces.push_back(regions.regions[region].first.index());
  }
  shells.shell_of_face.resize(mesh.face_count());
  parallel_for(mesh.face_count(), kFacesPerLabelling,
               [&](std::size_t face) { shells.shell_of_face[face] = shell_of_region[regions.of_face[FaceId(face)]]; });
  return shells;
}

class WindingQuery {
 public:
  WindingQuery(const TriangleMesh& mesh, const BoxHierarchy& hierarchy, const ShellWindings& shells)
      : mesh_(mesh), hierarchy_(hierarchy), shells_(shells), shell_boxes_(shells.first_faces.size()) {
    if (shell_boxes_.size() == 1) {
      // Every crossing counts; asking no box saves reading all points.
      shell_boxes_[0] = {{-Box3::kInfinity, -Box3::kInfinity, -Box3::kInfinity},
                         {Box3::kInfinity, Box3::kInfinity, Box3::kInfinity}};
      return;
    }
    for (std::size_t face = 0; face < mesh.face_count(); ++face) {
      poll_interruption_at(face);
      for (const PointRef& corner : mesh.corners(FaceId(face)))
        shell_boxes_[shells.shell_of_face[face]].extend(box_of(corner));
    }
  }

  /// Winding number in front of `face`, which must not be vertical.
  int in_front_of(FaceId face) const {
    for (int attempt = 0;; ++attempt) {
      FrontRay ray(mesh_.corners(face), attempt);
      const Box3 where = box_of(ray.start());
      hierarchy_.for_each_on_vertical_ray(where, ray.upward(), [&](std::uint32_t other) {
        // A shell is a cycle by itself, and its winding number is 0 outside its box.
        if (other != face.index() && shell_boxes_[shells_.shell_of_face[other]].intersects(where))
          ray.cross(mesh_, FaceId(other));
      });
      if (!ray.starts_on_other()) return ray.winding();
    }
  }

 private:
  const TriangleMesh& mesh_;
  const BoxHierarchy& hierarchy_;
  const ShellWindings& shells_;
  std::vector<Box3> shell_boxes_;
};

/// Per shell, its first face that is not vertical. There is one: a shell bounds something, which has a top.
std::vector<std::uint32_t> faces_to_ask(const TriangleMesh& mesh, const ShellWindings& shells) {
  std::vector<std::uint32_t> faces(shells.first_faces.size(), kNone);
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    poll_interruption_at(face);
    std::uint32_t& chosen = faces[shells.shell_of_face[face]];
    if (chosen == kNone && !is_vertical(mesh.corners(FaceId(face)))) chosen = face;
  }
  return faces;
}

/// The numbers in front of shells by counting all that a ray passes: good for a few shells, and for any.
class FrontsByRays {
 public:
  FrontsByRays(const TriangleMesh& mesh, const BoxHierarchy& hierarchy, const ShellWindings& shells)
      : faces_(faces_to_ask(mesh, shells)), query_(mesh, hierarchy, shells) {}

  int front(std::uint32_t shell) const { return query_.in_front_of(FaceId(faces_[shell])); }

 private:
  std::vector<std::uint32_t> faces_;
  WindingQuery query_;
};

constexpr int kUnknown = std::numeric_limits<int>::max();

/// The number in front of a shell of its own that looks outward (1) or inward (-1).
int own_front(int orientation) {
  return orientation > 0 ? 0 : -1;
}

/// Up to so many shells, rays cost less than an order of the shells.
constexpr std::size_t kFewShells = 64;

Status end_if_cancelled(const std::atomic<bool>* cancel) {
  if (cancel != nullptr && cancel->load(std::memory_order_relaxed)) return Error{ErrorCode::interrupted, "interrupted"};
  return {};
}

/// Finds the fronts that are unknown.
Status ask_for_unknown(const TriangleMesh& mesh, const BoxHierarchy& hierarchy, const std::atomic<bool>* cancel,
                       ShellWindings& shells) {
  const std::size_t count = shells.first_faces.size();
  const FrontsByRays rays(mesh, hierarchy, shells);
  if (count <= kFewShells) {
    for (std::uint32_t shell = 0; shell < count; ++shell) {
      A3D_TRY(end_if_cancelled(cancel));
      shells.fronts[shell] = rays.front(shell);
    }
    return {};
  }
  // To the number in front of a shell of its own comes what is right above it.
  const ShellTops tops(mesh, hierarchy, shells.shell_of_face, count);
  const std::vector<int> orientations = shell_orientations(mesh, shells.shell_of_face, count);
  for (const std::uint32_t shell : tops.from_highest()) {
    A3D_TRY(end_if_cancelled(cancel));
    if (shells.fronts[shell] != kUnknown) continue;
    const FaceOverhead above = tops.overhead(shell);
    int outside = 0;
    if (above.face.is_valid() && above.is_known)
      outside = shells.fronts[shells.shell_of_face[above.face.index()]] + (above.sign > 0 ? 1 : 0);
    shells.fronts[shell] = above.is_known ? outside + own_front(orientations[shell]) : rays.front(shell);
  }
  return {};
}

/// Per shell: true if a face of it and one of another shell have a common vertex or are a pair of `near`.
Result<std::vector<bool>> shells_near_others(const TriangleMesh& mesh, const ShellWindings& shells,
                                             const BoxHierarchy& near, const std::atomic<bool>* cancel) {
  std::vector<bool> are_near(shells.first_faces.size());
  const auto compare_shells = [&](std::uint32_t a, std::uint32_t b) {
    if (a != b) are_near[a] = are_near[b] = true;
  };
  std::vector<std::uint32_t> shell_at(mesh.vertex_count(), kNone);
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    poll_interruption_at(face);
    for (const std::uint32_t vertex : mesh.triangle(FaceId(face))) {
      if (shell_at[vertex] == kNone) shell_at[vertex] = shells.shell_of_face[face];
      compare_shells(shell_at[vertex], shells.shell_of_face[face]);
    }
  }
  Status ended;
  near.for_each_pair(
      [&](std::uint32_t f, std::uint32_t g) {
        compare_shells(shells.shell_of_face[f], shells.shell_of_face[g]);
        return true;
      },
      [&] {
        ended = end_if_cancelled(cancel);
        return ended.ok();
      });
  A3D_TRY(std::move(ended));
  return are_near;
}

/// Sets the fronts of shells that are near no other. While rounding moves the corners of the image on straight ways to
/// where they come to lie, such a shell meets no other; so the winding number of the others does not change along it.
/// In the preimage it is 0 less the shell's own.
Status take_over(const TriangleMesh& mesh, const Preimage& preimage, const BoxHierarchy& near,
                 const std::atomic<bool>* cancel, ShellWindings& shells) {
  const std::size_t count = shells.first_faces.size();
  A3D_ASSIGN(const std::vector<bool> are_near, shells_near_others(mesh, shells, near, cancel));
  const std::vector<int> before = shell_orientations(*preimage.mesh, shells.shell_of_face, count);
  const std::vector<int> after = shell_orientations(mesh, shells.shell_of_face, count);
  for (std::size_t shell = 0; shell < count; ++shell)
    if (!are_near[shell]) shells.fronts[shell] = own_front(after[shell]) - own_front(before[shell]);
  return {};
}

}  // namespace

bool ShellWindings::is_inside_out() const {
  // Turned over, front and back change places and all numbers their signs: -1 in front becomes 1 behind.
  return !fronts.empty() && std::ranges::all_of(fronts, [](int front) { return front == -1; });
}

Result<ShellWindings> find_shell_windings(const TriangleMesh& mesh, const HeightFields& fields,
                                          const BoxHierarchy& hierarchy, const std::atomic<bool>* cancel) {
  ShellWindings shells = find_shells(mesh, fields);
  shells.fronts.assign(shells.first_faces.size(), kUnknown);
  A3D_TRY(ask_for_unknown(mesh, hierarchy, cancel, shells));
  return shells;
}

Result<ShellWindings> find_shell_windings(const TriangleMesh& mesh, const HeightFields& fields,
                                          const Preimage& preimage, const BoxHierarchy& near,
                                          const std::atomic<bool>* cancel) {
  ShellWindings shells = find_shells(mesh, fields);
  shells.fronts.assign(shells.first_faces.size(), kUnknown);
  if (shells.first_faces.size() > kFewShells) A3D_TRY(take_over(mesh, preimage, near, cancel, shells));
  if (std::ranges::find(shells.fronts, kUnknown) != shells.fronts.end())
    A3D_TRY(ask_for_unknown(mesh, BoxHierarchy(mesh), cancel, shells));
  return shells;
}

Result<ShellWindings> find_shell_windings(const TriangleMesh& mesh, const std::atomic<bool>* cancel) {
  return find_shell_windings(mesh, HeightFields(mesh), BoxHierarchy(mesh), cancel);
}

}  // namespace algebra3d
