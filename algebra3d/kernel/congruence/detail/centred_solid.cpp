#include "algebra3d/kernel/congruence/detail/centred_solid.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/exact/nearest_mass_properties.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "base/propagate.h"

namespace algebra3d::detail {

namespace {

Vec3 nearest(const RationalVec3& v) {
  return {v.x.nearest_double(), v.y.nearest_double(), v.z.nearest_double()};
}

/// The inertia tensor in another unit of length.
SymmetricMatrix in_unit(const SymmetricMatrix& m, const Rational& unit) {
  const Rational square = unit * unit, factor = Rational(1) / (square * square * unit);
  return {factor * m.xx, factor * m.yy, factor * m.zz, factor * m.yz, factor * m.zx, factor * m.xy};
}

}  // namespace

Result<CentredSolid> CentredSolid::make(const CongruenceOperand& operand, double unit, const Monitor& monitor) {
  CentredSolid solid;
  solid.operand_ = operand;
  solid.unit_ = unit;
  const TriangleMesh& mesh = *operand.mesh;
  A3D_ASSIGN(const MassProperties mass,
             approximate_mass_properties(mesh.points(), triangles_of(mesh), monitor.cancel()));
  const Rational length_unit(unit);
  solid.volume_ = (mass.volume / (length_unit * length_unit * length_unit)).nearest_double();
  solid.axes_ = principal_axes(in_unit(mass.inertia, length_unit));
  solid.centre_ = nearest(mass.centre);
  // The rounding error of the centre, in units: in coordinates it may be below the smallest double.
  const Vec3 rest = nearest(Rational(1) / length_unit * (mass.centre - RationalVec3(solid.centre_)));
  solid.vertices_.reserve(mesh.vertex_count());
  for (const Vec3& p : mesh.points().approx()) {
    const Vec3 relative = p - solid.centre_;
    solid.vertices_.push_back(Vec3{relative.x / unit, relative.y / unit, relative.z / unit} - rest);
    solid.radius_ = std::max(solid.radius_, length(solid.vertices_.back()));
  }
  return solid;
}

}  // namespace algebra3d::detail
