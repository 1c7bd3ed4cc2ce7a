#include "algebra3d/values/types/detail/geometry.h"
#include "algebra3d/values/types/detail/geometry_type.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

class Surface3dType final : public GeometryType<Surface3d> {
 public:
  Surface3dType()
      : GeometryType({.name = "surface3d",
                      .doc = "Triangles in space that share no area and whose common segments are whole edges; with "
                             "exact coordinates.",
                      .notation = "(tri*), tri = (p1 p2 p3), p = (x y z)",
                      .example = "(((0 0 0) (1 0 0) (0 1 0)))",
                      .kinds = {Kind::data, Kind::spatial3d},
                      .is_large = true,
                      .summary_unit = "triangle",
                      .coordinates = Coordinates::triangles},
                     Orientation::does_not_count) {}
};

}  // namespace

Surface3d::Surface3d() {
  // All empty values share one geometry.
  static const std::shared_ptr<const Geometry> empty = make_geometry({});
  geometry_ = empty;
}

Result<Maybe<Surface3d>> Surface3d::prove(TriangleMesh mesh, const ProofOptions& options) {
  A3D_ASSIGN(const auto report, prove_surface(mesh, options));
  if (!report.is_valid()) return Maybe<Surface3d>(Undefined{fmt::format("no valid surface: {}", report.text())});
  return Maybe<Surface3d>(trusted(std::move(mesh)));
}

Surface3d Surface3d::trusted(TriangleMesh mesh) {
  return Surface3d(make_geometry(std::move(mesh)));
}

const Type& TypeOf<Surface3d>::type() {
  static const Surface3dType the_type;
  return the_type;
}

}  // namespace algebra3d
