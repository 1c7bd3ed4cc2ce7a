#include "algebra3d/repair/kept_shells.h"

#include <utility>
#include <vector>

#include "algebra3d/exact/exact_sum.h"
#include "algebra3d/halfedge/mesh_triangles.h"
#include "algebra3d/halfedge/topology.h"
#include "algebra3d/repair/winding_solid.h"

namespace algebra3d {

Result<TriangleMesh> kept_shells(TriangleMesh solid, const RepairOptions& options, RepairReport& report,
                                 const Monitor& monitor) {
  if (options.keeps_cavities && !(options.smallest_shell > 0)) return solid;
  const Rational smallest(options.smallest_shell);
  std::vector<FaceId> kept;
  std::vector<TriangleMesh::Triangle> triangles;
  for (const std::vector<FaceId>& shell : connected_components(solid).faces()) {
    RETURN_IF_ERROR(monitor.check());
    triangles.clear();
    for (const FaceId face : shell) triangles.push_back(solid.triangle(face));
    ASSIGN_OR_RETURN(const Rational volume, exact_volume(solid.points(), triangles));
    const bool is_cavity = volume.sign() < 0, is_small = volume.abs() < smallest;
    const bool is_dropped = is_small || (is_cavity && !options.keeps_cavities);
    if (!is_dropped) kept.insert(kept.end(), shell.begin(), shell.end());
    if (is_dropped)
      report.add(is_small ? RepairStep::small_shells : RepairStep::cavities,
                 solid.point(solid.origin(TriangleMesh::halfedge(shell[0]))).approx);
  }
  if (kept.size() == solid.face_count()) return solid;
  // Without a shell others may lie within each other.
  const auto is_inside = [](int winding) { return winding > 0; };
  return winding_solid(submesh(solid, kept), is_inside, monitor);
}

Result<double> nearest_volume(const TriangleMesh& mesh, const Monitor& monitor) {
  ASSIGN_OR_RETURN(const Rational volume, exact_volume(mesh.points(), triangles_of(mesh), monitor.cancel()));
  return volume.nearest_double();
}

Result<Amount> measured_volume(const TriangleMesh& mesh, const Monitor& monitor) {
  ASSIGN_OR_RETURN(const Rational volume, exact_volume(mesh.points(), triangles_of(mesh), monitor.cancel()));
  return Amount::nearest(volume);
}

}  // namespace algebra3d
