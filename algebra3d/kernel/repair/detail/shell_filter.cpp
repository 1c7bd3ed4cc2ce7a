#include "algebra3d/kernel/repair/detail/shell_filter.h"

#include <vector>

#include "algebra3d/kernel/autorefinement/winding_selection.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Result<Rational> volume_of_shell(const TriangleMesh& solid, const std::vector<FaceId>& shell) {
  std::vector<TriangleMesh::Triangle> triangles;
  triangles.reserve(shell.size());
  for (const FaceId face : shell) triangles.push_back(solid.triangle(face));
  return exact_volume(solid.points(), triangles);
}

}  // namespace

Result<TriangleMesh> filter_shells(TriangleMesh solid, const RepairOptions& options, RepairReport& report,
                                   const Monitor& monitor) {
  if (options.keeps_cavities && !(options.smallest_shell > 0)) return solid;
  const Rational smallest(options.smallest_shell);
  std::vector<FaceId> kept;
  for (const std::vector<FaceId>& shell : connected_components(solid).faces()) {
    A3D_TRY(monitor.check());
    A3D_ASSIGN(const Rational volume, volume_of_shell(solid, shell));
    const bool is_cavity = volume.sign() < 0, is_small = volume.abs() < smallest;
    if (!is_small && (!is_cavity || options.keeps_cavities)) {
      kept.insert(kept.end(), shell.begin(), shell.end());
      continue;
    }
    report.add(is_small ? RepairStep::small_shells : RepairStep::cavities,
               solid.point(solid.origin(TriangleMesh::halfedge(shell[0]))).approx);
  }
  if (kept.size() == solid.face_count()) return solid;
  // Without a shell others may lie within each other.
  const auto is_inside = [](int winding) { return winding > 0; };
  return solid_by_winding(submesh(solid, kept), is_inside, monitor);
}

}  // namespace algebra3d
