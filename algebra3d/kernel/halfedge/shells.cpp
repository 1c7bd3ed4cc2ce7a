#include "algebra3d/kernel/halfedge/shells.h"

#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

/// The shell of each face, and how many there are.
template <typename Layout>
FaceComponents shells_of(const HalfedgeMesh<Layout>& mesh) {
  FaceComponents shells{std::vector<std::uint32_t>(mesh.face_count(), kNone), 0};
  std::vector<FaceId> pending;
  for (const FaceId seed : faces(mesh)) {
    poll_interruption_at(seed.index());
    if (shells.of_face[seed.index()] != kNone) continue;
    const auto number = static_cast<std::uint32_t>(shells.count++);
    shells.of_face[seed.index()] = number;
    pending.push_back(seed);
    while (!pending.empty()) {
      const FaceId f = pending.back();
      pending.pop_back();
      for (const HalfedgeId h : halfedges_of(mesh, f)) {
        const HalfedgeId opposite = mesh.opposite(h);
        if (!opposite.is_valid() || shells.of_face[mesh.face(opposite).index()] != kNone) continue;
        shells.of_face[mesh.face(opposite).index()] = number;
        pending.push_back(mesh.face(opposite));
      }
    }
  }
  return shells;
}

/// The faces of the mesh with separate vertices for each shell, all at the origin.
template <typename Layout>
PolygonMesh separated(const HalfedgeMesh<Layout>& mesh, const FaceComponents& shells) {
  LargeVector<std::uint32_t> corners(mesh.halfedge_count());
  std::vector<VertexId> last_vertex(shells.count);
  std::vector<std::uint32_t> its_copy(shells.count);
  std::uint32_t count = 0;
  for (const VertexId v : vertices(mesh)) {
    poll_interruption_at(v.index());
    for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
      const std::uint32_t shell = shells.of_face[mesh.face(h).index()];
      if (last_vertex[shell] != v) {
        last_vertex[shell] = v;
        its_copy[shell] = count++;
      }
      corners[h.index()] = its_copy[shell];
    }
  }
  LargeVector<std::uint32_t> starts(mesh.face_count() + 1, 0);
  for (const FaceId f : faces(mesh)) starts[f.index() + 1] = starts[f.index()] + mesh.degree(f);
  return {PointArray(std::vector<Vec3>(count)), PolygonLayout(std::move(starts)), std::move(corners)};
}

template <typename Layout>
Maybe<std::int64_t> summed_genus(const HalfedgeMesh<Layout>& mesh, const FaceComponents& shells) {
  std::int64_t sum = 0;
  for (const Maybe<std::int64_t>& genus : component_genus(mesh, shells)) {
    if (!genus) return genus;
    sum += *genus;
  }
  return sum;
}

}  // namespace

template <typename Layout>
Maybe<std::int64_t> genus_of_shells(const HalfedgeMesh<Layout>& mesh) {
  const FaceComponents shells = shells_of(mesh);
  if (mesh.nonmanifold_edge_count() == 0) return summed_genus(mesh, shells);
  return summed_genus(separated(mesh, shells), shells);
}

template Maybe<std::int64_t> genus_of_shells(const HalfedgeMesh<TriangleLayout>&);
template Maybe<std::int64_t> genus_of_shells(const HalfedgeMesh<PolygonLayout>&);

}  // namespace algebra3d
