#include "algebra3d/values/measures/common_volume.h"

#include <array>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/values/spatial_relations/relation.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Result<Rational> volume_of(const TriangleMesh& mesh, const Monitor& monitor) {
  return exact_volume(mesh.points(), triangles_of(mesh), monitor.cancel());
}

Result<Rational> volume_of_intersection(const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  const std::array<Operand, 2> operands{
      {{&a.mesh(), 0, &a.geometry().hierarchy()}, {&b.mesh(), 1, &b.geometry().hierarchy()}}};
  const auto is_common = [](const WindingVector& windings) { return windings[0] > 0 && windings[1] > 0; };
  A3D_ASSIGN(const TriangleMesh common, combine_solids(operands, is_common, monitor));
  return volume_of(common, monitor);
}

}  // namespace

Result<Rational> common_volume(const Volume3d& a, const Volume3d& b, const Monitor& monitor) {
  A3D_ASSIGN(const bool is_overlap, do_overlap(a, b, monitor));
  if (is_overlap) return volume_of_intersection(a, b, monitor);
  // The empty solid is inside every other.
  A3D_ASSIGN(const bool is_first_inside, is_inside(a, b, monitor));
  if (is_first_inside) return volume_of(a.mesh(), monitor);
  A3D_ASSIGN(const bool is_second_inside, is_inside(b, a, monitor));
  if (is_second_inside) return volume_of(b.mesh(), monitor);
  return Rational(0);
}

}  // namespace algebra3d
