#include "algebra3d/kernel/repair/detail/hole_loops.h"

#include <cstddef>
#include <unordered_map>

#include "algebra3d/kernel/halfedge/topology.h"

namespace algebra3d {
namespace {

using HalfedgePath = std::vector<HalfedgeId>;

/// The parts of a loop between visits of the same vertex, each a loop by itself.
std::vector<HalfedgePath> simple_loops(const TriangleMesh& mesh, const HalfedgePath& loop) {
  std::vector<HalfedgePath> result;
  HalfedgePath path;
  std::unordered_map<VertexId, std::size_t> places;  // in the path, of the origins
  for (const HalfedgeId h : loop) {
    places[mesh.origin(h)] = path.size();
    path.push_back(h);
    const auto known = places.find(mesh.target(h));
    if (known == places.end()) continue;
    const auto start = path.begin() + static_cast<std::ptrdiff_t>(known->second);
    for (auto g = start; g != path.end(); ++g) places.erase(mesh.origin(*g));
    result.emplace_back(start, path.end());
    path.erase(start, path.end());
  }
  return result;
}

/// New triangles run against the boundary.
HoleLoop hole_of(const TriangleMesh& mesh, const HalfedgePath& boundary) {
  HoleLoop hole;
  hole.triangle = TriangleMesh::face(boundary[0]);
  for (std::size_t i = boundary.size(); i-- > 0;) {
    const VertexId from = mesh.target(boundary[i]);
    hole.vertices.push_back(from);
    hole.loop.corners.push_back(mesh.point(from).approx);
    hole.loop.beyond.push_back(mesh.point(mesh.origin(TriangleMesh::prev(boundary[i]))).approx);
  }
  return hole;
}

}  // namespace

Box3 HoleLoop::box() const {
  Box3 box;
  for (const Vec3& corner : loop.corners) box.extend(corner);
  return box;
}

double HoleLoop::diameter() const {
  const Box3 around = box();
  return length(around.max - around.min);
}

IdVector<HoleId, HoleLoop> hole_loops(const TriangleMesh& mesh) {
  IdVector<HoleId, HoleLoop> result;
  for (const BoundaryLoop& boundary : boundary_loops(mesh))
    for (const HalfedgePath& loop : simple_loops(mesh, boundary.halfedges))
      if (loop.size() >= 3) result.push_back(hole_of(mesh, loop));
  return result;
}

}  // namespace algebra3d
