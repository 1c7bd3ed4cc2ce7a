#include "algebra3d/autorefinement/detail/face_sheets.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "algebra3d/base/disjoint_sets.h"
#include "algebra3d/base/indices.h"
#include "algebra3d/halfedge/circulators.h"

namespace algebra3d {
namespace {

/// A set of sheets, a bit for each.
using Sheets = std::uint8_t;
constexpr std::uint32_t kMostSheets = 8;

/// A non-manifold edge in one direction, as two times its number, and 1 for the direction against its first half-edge.
using EdgeDirection = std::size_t;

/// Faces that are connected across manifold edges, as a number for each face.
struct Patches {
  std::vector<std::uint32_t> of_face;
  std::size_t count = 0;
};

Patches patches_of(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.face_count());
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i)
    if (const HalfedgeId opposite = mesh.opposite(HalfedgeId(i)); opposite.is_valid())
      sets.unite(TriangleMesh::face(HalfedgeId(i)).index(), TriangleMesh::face(opposite).index());
  Patches patches{std::vector<std::uint32_t>(mesh.face_count())};
  std::vector<std::uint32_t> number_of(mesh.face_count(), kNone);  // per set, at its representative
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::uint32_t& number = number_of[sets.find(f)];
    if (number == kNone) number = static_cast<std::uint32_t>(patches.count++);
    patches.of_face[f] = number;
  }
  return patches;
}

/// Per patch: along which non-manifold edges it runs, an edge as often as there are half-edges.
std::vector<std::vector<EdgeDirection>> edges_of_patches(const TriangleMesh& mesh, const Patches& patches) {
  std::vector<std::vector<EdgeDirection>> result(patches.count);
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) {
    const auto edge = mesh.nonmanifold_edge(n);
    for (const HalfedgeId h : edge) {
      const bool runs_back = mesh.origin(h) != mesh.origin(edge.front());
      result[patches.of_face[TriangleMesh::face(h).index()]].push_back(2 * n + (runs_back ? 1 : 0));
    }
  }
  return result;
}

bool runs_twice(std::vector<EdgeDirection> edges) {
  std::ranges::sort(edges);
  return std::ranges::adjacent_find(edges) != edges.end();
}

}  // namespace

FaceSheets face_sheets(const TriangleMesh& mesh) {
  const Patches patches = patches_of(mesh);
  const auto edges = edges_of_patches(mesh, patches);
  std::vector<Sheets> taken(2 * mesh.nonmanifold_edge_count());  // per directed edge
  std::vector<std::uint32_t> sheet_of(patches.count);
  for (std::size_t patch = 0; patch < patches.count; ++patch) {
    Sheets full = 0;
    for (const EdgeDirection e : edges[patch]) full |= taken[e];
    const auto sheet = runs_twice(edges[patch]) ? kMostSheets : static_cast<std::uint32_t>(std::countr_one(full));
    sheet_of[patch] = sheet;
    if (sheet == kMostSheets) continue;
    for (const EdgeDirection e : edges[patch]) taken[e] |= static_cast<Sheets>(1U << sheet);
  }
  FaceSheets result;
  for (const FaceId face : faces(mesh)) {
    const std::uint32_t sheet = sheet_of[patches.of_face[face.index()]];
    if (sheet < kMostSheets && result.sheets.size() <= sheet) result.sheets.resize(sheet + 1);
    (sheet < kMostSheets ? result.sheets[sheet] : result.others).push_back(face);
  }
  return result;
}

}  // namespace algebra3d
