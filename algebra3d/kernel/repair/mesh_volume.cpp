#include "algebra3d/kernel/repair/mesh_volume.h"

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "base/propagate.h"

namespace algebra3d {

Result<double> nearest_volume(const TriangleMesh& mesh, const Monitor& monitor) {
  A3D_ASSIGN(const Rational volume, exact_volume(mesh.points(), triangles_of(mesh), monitor.cancel()));
  return volume.nearest_double();
}

Result<Amount> measured_volume(const TriangleMesh& mesh, const Monitor& monitor) {
  A3D_ASSIGN(const Rational volume, exact_volume(mesh.points(), triangles_of(mesh), monitor.cancel()));
  return Amount::nearest(volume);
}

}  // namespace algebra3d
