#include "algebra3d/kernel/repair/detail/winding_segmentation.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/arrangement/surface_arrangement.h"
#include "algebra3d/kernel/arrangement/winding_vector.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/repair/detail/cell_classification.h"
#include "algebra3d/kernel/repair/detail/space_cells.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// The boundary of the cells that are inside, divided as the surface is.
struct CellBoundary {
  TriangleMesh mesh;
  std::vector<bool> has_nonmanifold_edge;  ///< per face: the surface had more than two faces at one of its edges
};

CellBoundary boundary_of_inside(const TriangleMesh& surface, SpaceCells& cells,
                                const std::map<CellId, bool>& is_inside) {
  const auto is_side_inside = [&](FaceSide side) {
    const auto known = is_inside.find(cells.cell(side));
    return known != is_inside.end() && known->second;
  };
  std::vector<TriangleMesh::Triangle> triangles;
  CellBoundary result;
  for (const FaceId face : faces(surface)) {
    const bool front = is_side_inside(FaceSide::front(face)), back = is_side_inside(FaceSide::back(face));
    if (front == back) continue;
    TriangleMesh::Triangle triangle = surface.triangle(face);
    if (front) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
    const auto is_not_manifold = [&](HalfedgeId h) { return !surface.opposite(h).is_valid(); };
    result.has_nonmanifold_edge.push_back(std::ranges::any_of(halfedges_of(surface, face), is_not_manifold));
  }
  result.mesh = TriangleMesh(surface.points(), triangles);
  return result;
}

/// Triangulates faces anew with their coplanar neighbours where edges no longer separate anything.
Result<TriangleMesh> without_needless_edges(const CellBoundary& boundary, const Monitor& monitor) {
  A3D_ASSIGN(const ValidParts parts, ValidParts::make(boundary.mesh, boundary.has_nonmanifold_edge, monitor));
  A3D_ASSIGN(const SolidArrangement arrangement,
             SolidArrangement::make(parts.operands(), monitor, {Closure::together}));
  return arrangement.solid([](const WindingVector& windings) { return windings[0] > 0; });
}

}  // namespace

Result<TriangleMesh> solid_by_generalized_winding(const IndexedSoup& soup, const ValidParts& parts,
                                                  const Monitor& monitor, const ArrangementOptions& limits,
                                                  double max_angles) {
  A3D_ASSIGN(const TriangleMesh surface, unite_surfaces(parts.operands(), monitor, limits));
  SpaceCells cells(surface);
  A3D_TRY(cells.find(monitor));
  A3D_ASSIGN(const auto is_inside,
             classify_cells(surface, cells, GeneralizedWindingNumbers(soup), monitor, max_angles));
  return without_needless_edges(boundary_of_inside(surface, cells, is_inside), monitor);
}

}  // namespace algebra3d
