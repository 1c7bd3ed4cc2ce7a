#include "algebra3d/kernel/autorefinement/valid_parts.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/disjoint_sets.h"
#include "base/indices.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The faces of any mesh in sheets without tangled edges, as few as are easily found. A *tangled* edge is a
/// non-manifold one around which winding numbers may differ: it is not balanced, or its faces do not alternate
/// (EdgeOrder), or one of them is degenerate.
struct FaceSheets {
  std::vector<std::vector<FaceId>> sheets;  ///< the faces of each, ascending
  std::vector<FaceId> others;               ///< faces that are in no sheet, ascending
};

/// A set of sheets, a bit for each.
using Sheets = std::uint8_t;
constexpr std::uint32_t kMostSheets = 8;

/// A tangled edge in one direction, as two times its number, and 1 for the direction against its first half-edge.
using EdgeDirection = std::size_t;

/// Faces that are connected across edges that are not tangled, as a number for each face.
struct Patches {
  std::vector<std::uint32_t> of_face;
  std::size_t count = 0;
};

/// Unless an edge is tangled, the winding numbers in front of all its faces are the same, as far as the edge decides
/// it.
bool is_tangled(const TriangleMesh& mesh, std::span<const HalfedgeId> edge) {
  const auto has_area = [&](HalfedgeId h) {
    const TriangleRef corners = mesh.corners(TriangleMesh::face(h));
    return !collinear(corners[0], corners[1], corners[2]);
  };
  return !is_balanced(mesh, edge) || !std::ranges::all_of(edge, has_area) ||
         order_around(mesh, edge) != EdgeOrder::alternating;
}

/// By their numbers among the non-manifold edges; ascending.
std::vector<std::size_t> tangled_edges_of(const TriangleMesh& mesh) {
  std::vector<std::size_t> tangled;
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
    if (is_tangled(mesh, mesh.nonmanifold_edge(n))) tangled.push_back(n);
  return tangled;
}

/// A face that runs along a tangled edge.
struct FaceAtEdge {
  std::uint32_t patch;
  EdgeDirection direction;
  FaceId face;

  bool is_like(const FaceAtEdge& other) const { return patch == other.patch && direction == other.direction; }
};

/// The steps of face_sheets.
class SheetMaker {
 public:
  explicit SheetMaker(const TriangleMesh& mesh) : mesh_(mesh), tangled_edges_(tangled_edges_of(mesh)) {}

  FaceSheets run();

 private:
  void find_patches();
  std::vector<FaceAtEdge> faces_at(std::size_t tangled_edge) const;
  void list_edges_of_patches();
  std::vector<std::uint32_t> choose_sheets();

  const TriangleMesh& mesh_;
  std::vector<std::size_t> tangled_edges_;
  Patches patches_;
  std::vector<std::vector<EdgeDirection>> edges_of_patches_;  // the tangled ones
  std::vector<bool> is_alone_;                                // per face
};

void SheetMaker::find_patches() {
  DisjointSets sets(mesh_.face_count());
  for (std::uint32_t i = 0; i < mesh_.halfedge_count(); ++i)
    if (const HalfedgeId opposite = mesh_.opposite(HalfedgeId(i)); opposite.is_valid())
      sets.unite(TriangleMesh::face(HalfedgeId(i)).index(), TriangleMesh::face(opposite).index());
  for (std::size_t n = 0; n < mesh_.nonmanifold_edge_count(); ++n) {
    if (std::ranges::binary_search(tangled_edges_, n)) continue;
    const auto edge = mesh_.nonmanifold_edge(n);
    for (const HalfedgeId h : edge) sets.unite(TriangleMesh::face(edge.front()).index(), TriangleMesh::face(h).index());
  }
  patches_.of_face.resize(mesh_.face_count());
  std::vector<std::uint32_t> number_of(mesh_.face_count(), kNone);  // per set, at its representative
  for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
    std::uint32_t& number = number_of[sets.find(f)];
    if (number == kNone) number = static_cast<std::uint32_t>(patches_.count++);
    patches_.of_face[f] = number;
  }
}

/// The faces at a tangled edge, sorted by patch and direction.
std::vector<FaceAtEdge> SheetMaker::faces_at(std::size_t tangled_edge) const {
  const auto edge = mesh_.nonmanifold_edge(tangled_edge);
  std::vector<FaceAtEdge> result;
  for (const HalfedgeId h : edge) {
    const FaceId face = TriangleMesh::face(h);
    const bool runs_back = mesh_.origin(h) != mesh_.origin(edge.front());
    result.push_back({patches_.of_face[face.index()], 2 * tangled_edge + (runs_back ? 1 : 0), face});
  }
  std::ranges::stable_sort(result, {}, [](const FaceAtEdge& at) { return std::pair(at.patch, at.direction); });
  return result;
}

/// Leaves faces alone of which several in one patch run along an edge in the same direction.
void SheetMaker::list_edges_of_patches() {
  edges_of_patches_.resize(patches_.count);
  is_alone_.resize(mesh_.face_count());
  for (const std::size_t edge : tangled_edges_) {
    const std::vector<FaceAtEdge> at = faces_at(edge);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const bool is_repeated = (i > 0 && at[i].is_like(at[i - 1])) || (i + 1 < at.size() && at[i].is_like(at[i + 1]));
      if (is_repeated)
        is_alone_[at[i].face.index()] = true;
      else
        edges_of_patches_[at[i].patch].push_back(at[i].direction);
    }
  }
}

/// The first sheet for each patch in which no face runs along one of its edges in the same direction; kMostSheets if
/// there is none.
std::vector<std::uint32_t> SheetMaker::choose_sheets() {
  std::vector<Sheets> taken(2 * mesh_.nonmanifold_edge_count());  // per directed edge
  std::vector<std::uint32_t> sheet_of;
  for (const std::vector<EdgeDirection>& edges : edges_of_patches_) {
    Sheets full = 0;
    for (const EdgeDirection e : edges) full |= taken[e];
    sheet_of.push_back(static_cast<std::uint32_t>(std::countr_one(full)));
    for (const EdgeDirection e : edges) taken[e] |= static_cast<Sheets>(1U << sheet_of.back());
  }
  return sheet_of;
}

FaceSheets SheetMaker::run() {
  find_patches();
  list_edges_of_patches();
  const std::vector<std::uint32_t> sheet_of = choose_sheets();
  FaceSheets result;
  for (const FaceId face : faces(mesh_)) {
    const std::uint32_t sheet = is_alone_[face.index()] ? kMostSheets : sheet_of[patches_.of_face[face.index()]];
    if (sheet < kMostSheets && result.sheets.size() <= sheet) result.sheets.resize(sheet + 1);
    (sheet < kMostSheets ? result.sheets[sheet] : result.others).push_back(face);
  }
  return result;
}

/// The faces of a mesh sorted into sheets, patch by patch: a patch has all faces that are connected across edges that
/// are not tangled. It goes to the first sheet without a face that runs along one of its tangled edges in the same
/// direction. The others are faces of one patch that run along a tangled edge in the same direction, and patches for
/// which eight sheets have no room. Exact. Deterministic. Cost: that of the exact order around non-manifold edges; else
/// linear.
FaceSheets face_sheets(const TriangleMesh& mesh) {
  return SheetMaker(mesh).run();
}

/// A mesh of one face, at a cost that does not depend on the mesh.
TriangleMesh mesh_of_face(const TriangleMesh& mesh, FaceId face) {
  PointArray points;
  for (const PointRef& corner : mesh.corners(face)) points.push_back(corner);
  FacePlanes planes;
  if (const IntegerPlane* plane = mesh.planes().find(face.index()); plane != nullptr) planes.set(0, planes.add(*plane));
  return {std::move(points), std::vector<TriangleMesh::Triangle>{{0, 1, 2}}, std::move(planes)};
}

}  // namespace

Result<ValidParts> ValidParts::make(const TriangleMesh& mesh, const Monitor& monitor, const FaceSet& known) {
  return make(mesh, std::vector<bool>(mesh.face_count()), monitor, known);
}

Result<ValidParts> ValidParts::make(const TriangleMesh& mesh, const std::vector<bool>& are_alone,
                                    const Monitor& monitor, const FaceSet& known) {
  A3D_ASSIGN(const std::vector<Entanglement> entanglements, disentangle(mesh, monitor.cancel(), known));
  ValidParts result;
  std::vector<FaceId> free;
  for (const FaceId face : faces(mesh)) {
    const Entanglement entanglement = entanglements[face.index()];
    if (entanglement == Entanglement::degenerate) continue;
    if (entanglement == Entanglement::none && !are_alone[face.index()])
      free.push_back(face);
    else
      result.add_alone(mesh, face);
  }
  if (!free.empty()) result.meshes_.push_back(submesh(mesh, free));
  result.list_operands();
  return result;
}

Result<ValidParts> ValidParts::in_sheets(const TriangleMesh& mesh, const Monitor& monitor) {
  const FaceSheets sheets = face_sheets(mesh);
  ValidParts result;
  std::vector<TriangleMesh> free_parts;
  for (const std::vector<FaceId>& its_faces : sheets.sheets) {
    const TriangleMesh sheet = submesh(mesh, its_faces);
    A3D_ASSIGN(const std::vector<Entanglement> entanglements,
               disentangle(sheet, monitor.cancel(), {}, AllowedEdges::any));
    std::vector<FaceId> free;
    for (std::size_t i = 0; i < its_faces.size(); ++i) {
      if (entanglements[i] == Entanglement::none) free.push_back(its_faces[i]);
      if (entanglements[i] == Entanglement::entangled) result.add_alone(mesh, its_faces[i]);
    }
    if (!free.empty()) free_parts.push_back(submesh(mesh, free));
  }
  for (const FaceId face : sheets.others) {
    const TriangleRef corners = mesh.corners(face);
    if (!collinear(corners[0], corners[1], corners[2])) result.add_alone(mesh, face);
  }
  std::ranges::sort(result.lone_faces_);
  std::ranges::move(free_parts, std::back_inserter(result.meshes_));
  result.list_operands();
  return result;
}

void ValidParts::add_alone(const TriangleMesh& mesh, FaceId face) {
  lone_faces_.push_back(face);
  meshes_.push_back(mesh_of_face(mesh, face));
}

void ValidParts::list_operands() {
  operands_.reserve(meshes_.size());
  for (const TriangleMesh& part : meshes_) operands_.push_back({&part, 0});
}

}  // namespace algebra3d
