// Why it is enough to look at the faces near the added ones.
//
// Faces that stay get along with each other, so only pairs with an added face are open. Such a pair has a common point,
// so the boxes of the two meet, and the one that stays is near. The same holds for all faces at an edge of an added
// face. Other edges have the faces that they had, since the added faces have the same boundary as the removed ones.
//
// A shell has the winding number 0 in front of it if that is so for one of its faces. Take one that stays and is not
// near: the deformation of the removed faces into the added ones sweeps over no point of it, since each point of the
// way is within `movement` of an added face. So the number in front of it is what it was.

#include "algebra3d/kernel/validity/replacement.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/edge_balance.h"
#include "algebra3d/kernel/halfedge/replaced_faces.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/kernel/validity/contacts.h"
#include "algebra3d/kernel/validity/detail/edges.h"
#include "algebra3d/kernel/validity/detail/front_ray.h"
#include "algebra3d/kernel/validity/detail/intersections.h"
#include "algebra3d/kernel/validity/detail/proved_parts.h"
#include "algebra3d/kernel/validity/detail/triangles.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/indices.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

Box3 box_of_face(const TriangleMesh& mesh, std::uint32_t face) {
  return box_of_triangle(mesh.corners(FaceId(face)));
}

Box3 box_of_mesh(const TriangleMesh& mesh) {
  Box3 box;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) box.extend(box_of(mesh.points()[v]));
  return box;
}

/// A coarse grid of cells over a box, some of which are marked.
class MarkedCells {
 public:
  explicit MarkedCells(const Box3& bounds) : bounds_(bounds) {
    const Vec3 size = bounds.max - bounds.min;
    for (std::size_t axis = 0; axis < 3; ++axis) scale_[axis] = size[axis] > 0 ? kCells / size[axis] : 0;
  }

  /// Marks the cells that the box meets.
  void mark(const Box3& box) {
    const Cells cells = cells_of(box);
    for (unsigned x = cells.low[0]; x <= cells.high[0]; ++x)
      for (unsigned y = cells.low[1]; y <= cells.high[1]; ++y) columns_[x * kCells + y] |= cells.part_of_column;
  }
  /// True if the box meets a marked cell.
  bool meets_marked(const Box3& box) const {
    if (!box.intersects(bounds_)) return false;
    const Cells cells = cells_of(box);
    std::uint64_t met = 0;
    for (unsigned x = cells.low[0]; x <= cells.high[0]; ++x)
      for (unsigned y = cells.low[1]; y <= cells.high[1]; ++y) met |= columns_[x * kCells + y] & cells.part_of_column;
    return met != 0;
  }

 private:
  static constexpr unsigned kCells = 64;

  struct Cells {
    std::array<unsigned, 2> low, high;
    std::uint64_t part_of_column;
  };

  /// The number of a cell along an axis: monotonic, and the first or the last one beyond the bounds.
  unsigned number(double coordinate, std::size_t axis) const {
    const double place = (coordinate - bounds_.min[axis]) * scale_[axis];
    return place > 0 ? static_cast<unsigned>(std::min(place, kCells - 1.0)) : 0;
  }
  Cells cells_of(const Box3& box) const {
    const unsigned bottom = number(box.min.z, 2), top = number(box.max.z, 2);
    return {{number(box.min.x, 0), number(box.min.y, 1)},
            {number(box.max.x, 0), number(box.max.y, 1)},
            (~std::uint64_t{0} >> (kCells - 1 - top)) & (~std::uint64_t{0} << bottom)};
  }

  Box3 bounds_;
  Vec3 scale_;
  std::vector<std::uint64_t> columns_ = std::vector<std::uint64_t>(std::size_t{kCells} * kCells);  // a bit per cell
};

/// The faces of a mesh, without the excepted ones, that may be within `reach` of a face of another mesh: all whose
/// boxes are, and others beside them. Ascending. `is_excepted`: one flag per face. Cost: linear in both meshes, some 10
/// ns per face.
std::vector<FaceId> faces_near(const TriangleMesh& mesh, const std::vector<bool>& is_excepted,
                               const TriangleMesh& others, double reach) {
  if (others.is_empty()) return {};
  MarkedCells cells(padded(box_of_mesh(others), reach));
  for (std::uint32_t f = 0; f < others.face_count(); ++f) cells.mark(padded(box_of_face(others, f), reach));
  constexpr std::size_t kFacesPerScan = 4'000;
  return parallel_collect(mesh.face_count(), kFacesPerScan, [&](std::size_t begin, std::size_t end) {
    std::vector<FaceId> found;
    for (auto f = static_cast<std::uint32_t>(begin); f < end; ++f)
      if (!is_excepted[f] && cells.meets_marked(box_of_face(mesh, f))) found.emplace_back(f);
    return found;
  });
}

/// A volume, the faces that go, and those in their place.
struct Replacement {
  const TriangleMesh* volume;
  const std::vector<bool>* is_removed;
  const TriangleMesh* added;

  bool removes(std::size_t face) const { return (*is_removed)[face]; }
};

/// True if the removed and the added faces are bounded by the same edges, and no edge that is not manifold has faces
/// that go and faces that stay.
bool have_same_boundary(const Replacement& replacement) {
  const TriangleMesh& volume = *replacement.volume;
  const TriangleMesh& added = *replacement.added;
  EdgeBalance balance;
  const auto stays = [&](HalfedgeId h) { return !replacement.removes(TriangleMesh::face(h).index()); };
  for (std::uint32_t f = 0; f < volume.face_count(); ++f) {
    poll_interruption_at(f);
    if (!replacement.removes(f)) continue;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const HalfedgeId h = TriangleMesh::halfedge(FaceId(f), corner);
      if (volume.is_nonmanifold(h)) {
        if (std::ranges::any_of(volume.edge_halfedges(h), stays)) return false;
      } else if (stays(volume.opposite(h))) {
        balance.add(volume, h, 1);
      }
    }
  }
  balance.add(added, -1);
  return balance.is_zero();
}

/// Gathers faces of several meshes into one.
class MeshAssembly {
 public:
  /// The faces of a mesh that are listed.
  void add(const TriangleMesh& mesh, const std::vector<FaceId>& faces) {
    std::vector<std::uint32_t> numbers(mesh.vertex_count(), kNone);
    for (const FaceId face : faces) {
      TriangleMesh::Triangle triangle = mesh.triangle(face);
      for (std::uint32_t& corner : triangle) {
        if (numbers[corner] == kNone) numbers[corner] = number_of(mesh.points()[corner]);
        corner = numbers[corner];
      }
      triangles_.push_back(triangle);
    }
  }
  TriangleMesh mesh() && { return {std::move(points_), triangles_}; }

 private:
  std::uint32_t number_of(const PointRef& point) {
    const std::uint32_t number = places_.intern(point);
    if (number == points_.size()) points_.push_back(point);
    return number;
  }

  PointTable places_;
  PointArray points_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

/// The added faces and those near them, as one mesh: first the added ones.
TriangleMesh mesh_around(const Replacement& replacement, const std::vector<FaceId>& near) {
  MeshAssembly assembly;
  const auto added = faces(*replacement.added);
  assembly.add(*replacement.added, {added.begin(), added.end()});
  assembly.add(*replacement.volume, near);
  return std::move(assembly).mesh();
}

/// The first face that is not vertical of each closed shell of the mesh. There is one: a closed shell bounds something,
/// which has a top.
std::vector<FaceId> faces_of_closed_shells(const TriangleMesh& mesh) {
  const FaceComponents shells = connected_components(mesh);
  std::vector<bool> is_done(shells.count);
  for (std::size_t i = 0; i < mesh.halfedge_count(); ++i)
    if (mesh.is_boundary(HalfedgeId(i))) is_done[shells.of_face[TriangleMesh::face(HalfedgeId(i)).index()]] = true;
  std::vector<FaceId> chosen;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    if (is_done[shells.of_face[f]] || is_vertical(mesh.corners(FaceId(f)))) continue;
    is_done[shells.of_face[f]] = true;
    chosen.emplace_back(f);
  }
  return chosen;
}

/// The winding number of the whole changed volume in front of a face of the `around` mesh. `goes_or_is_near`: the faces
/// of the volume that this mesh stands for. Cost: a scan of all faces.
int winding_in_front_of(FaceId face, const TriangleMesh& around, const TriangleMesh& volume,
                        const std::vector<bool>& goes_or_is_near) {
  for (int attempt = 0;; ++attempt) {
    FrontRay ray(around.corners(face), attempt);
    for (std::uint32_t f = 0; f < around.face_count(); ++f)
      if (f != face.index()) ray.cross(around, FaceId(f));
    for (std::uint32_t f = 0; f < volume.face_count(); ++f)
      if (!goes_or_is_near[f]) ray.cross(volume, FaceId(f));
    if (!ray.starts_on_other()) return ray.winding();
  }
}

/// For a proof of a mesh that consists of faces that get along with each other, and of `count` added ones from `first`.
ProofOptions options_for(std::size_t face_count, std::size_t first, std::size_t count,
                         const std::atomic<bool>* cancel) {
  std::vector<bool> stays(face_count, true);
  std::fill_n(stays.begin() + static_cast<std::ptrdiff_t>(first), count, false);
  return {.thoroughness = Thoroughness::first_defect, .cancel = cancel, .known = FaceSet(std::move(stays))};
}

/// The proof of the whole volume, in which pairs of faces that stay are not tested.
Result<bool> is_valid_whole(const Replacement& replacement, const std::atomic<bool>* cancel) {
  const TriangleMesh whole = with_replaced_faces(*replacement.volume, *replacement.is_removed, *replacement.added);
  const std::size_t count = replacement.added->face_count();
  const ProofOptions options = options_for(whole.face_count(), whole.face_count() - count, count, cancel);
  A3D_ASSIGN(const ValidityReport report, prove_volume(whole, options));
  return report.is_valid();
}

/// From so many added faces on, a second task pays.
constexpr std::size_t kManyAdded = 1'000;

/// Up to so many closed shells, a ray for each is cheaper than the proof of the whole volume.
constexpr std::size_t kFewClosedShells = 16;

/// True if the winding numbers in front of all shells are 0 that consist of added faces and those near them.
Result<bool> have_right_windings(const Replacement& replacement, const TriangleMesh& around,
                                 const std::vector<FaceId>& near, const std::atomic<bool>* cancel) {
  const std::vector<FaceId> in_question = faces_of_closed_shells(around);
  if (in_question.empty()) return true;
  if (in_question.size() > kFewClosedShells) return is_valid_whole(replacement, cancel);
  std::vector<bool> goes_or_is_near = *replacement.is_removed;
  for (const FaceId face : near) goes_or_is_near[face.index()] = true;
  const Monitor monitor(cancel);
  const bool are_right = std::ranges::all_of(in_question, [&](FaceId face) {
    return !monitor.is_cancelled() && winding_in_front_of(face, around, *replacement.volume, goes_or_is_near) == 0;
  });
  A3D_TRY(monitor.check());
  return are_right;
}

}  // namespace

Result<ProofWithContacts> prove_replacement(const TriangleMesh& volume, const std::vector<bool>& is_removed,
                                            const TriangleMesh& added, double movement,
                                            const std::atomic<bool>* cancel) {
  const Replacement replacement{&volume, &is_removed, &added};
  const bool is_large = added.face_count() > kManyAdded;
  bool has_same_boundary = false;
  std::vector<FaceId> near;
  TriangleMesh mesh;
  parallel_invoke(
      is_large, [&] { has_same_boundary = have_same_boundary(replacement); },
      [&] {
        near = faces_near(volume, is_removed, added, movement);
        mesh = mesh_around(replacement, near);
      });
  if (!has_same_boundary) return ProofWithContacts{};

  const ProofOptions options = options_for(mesh.face_count(), 0, added.face_count(), cancel);
  ValidityReport report;
  std::optional<ProvedParts> proved;
  std::optional<BoxHierarchy> hierarchy;
  parallel_invoke(
      is_large,
      [&] {
        proved.emplace(mesh, options.known);
        const SoundFaces sound = check_triangles(mesh, *proved, report);
        check_edges(mesh, sound, report, options.known);
      },
      [&] { hierarchy.emplace(mesh); });
  if (!report.is_valid()) return ProofWithContacts{};
  FaceSet ignored;
  A3D_ASSIGN(const FacePairs touching, find_intersections(mesh, *proved, *hierarchy, options, report, ignored));
  if (!report.is_valid()) return ProofWithContacts{};
  A3D_ASSIGN(const bool are_right, have_right_windings(replacement, mesh, near, cancel));
  if (!are_right) return ProofWithContacts{};
  return ProofWithContacts{true, vertex_count_of(vertex_contacts(mesh, touching))};
}

}  // namespace algebra3d
