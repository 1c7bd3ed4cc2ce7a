#include "algebra3d/kernel/repair/surface_from_soup.h"

#include <utility>

#include "algebra3d/kernel/arrangement/surface_arrangement.h"
#include "algebra3d/kernel/autorefinement/valid_parts.h"
#include "algebra3d/kernel/repair/detail/degenerate_triangles.h"
#include "algebra3d/kernel/repair/detail/work_limits.h"
#include "algebra3d/kernel/soup/spatial_order.h"
#include "algebra3d/kernel/soup/weld.h"
#include "algebra3d/kernel/validity/limited_proof.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/propagate.h"

namespace algebra3d {

Result<SurfaceFromSoup> surface_from_soup(const TriangleSoup& soup, const RepairOptions& options,
                                          const Monitor& monitor) {
  if (soup.triangles.size() > TriangleMesh::kMaxFaces)
    return Error{ErrorCode::limit_exceeded, "{} triangles; at most {} make a surface", soup.triangles.size(),
                 TriangleMesh::kMaxFaces};
  IndexedSoup indexed(weld(soup.triangles));
  SurfaceFromSoup result;
  drop_degenerate_triangles(indexed, result.repair);
  TriangleMesh given = in_spatial_order(*indexed.mesh());
  const ProofOptions first{.thoroughness = Thoroughness::first_defect, .cancel = monitor.cancel()};
  A3D_ASSIGN(const ValidityReport found, prove_surface(given, first));
  if (found.is_valid()) {
    result.mesh = std::move(given);
    return result;
  }
  A3D_ASSIGN(const ValidParts parts, ValidParts::make(given, monitor));
  for (const FaceId face : parts.lone_faces())
    result.repair.add(RepairStep::intersections, given.corners(face)[0].approx);
  A3D_ASSIGN(const TriangleMesh united, unite_surfaces(parts.operands(), monitor, work_limits(options)));
  result.mesh = in_spatial_order(united);
  ExactWorkLimit limit(exact_work_limit(options));
  A3D_ASSIGN(const ValidityReport proof, prove_surface(result.mesh, first, limit));
  if (!proof.is_valid())
    return Error{ErrorCode::internal, "the triangles divided at one another are not a valid surface: {}", proof.text()};
  return result;
}

}  // namespace algebra3d
