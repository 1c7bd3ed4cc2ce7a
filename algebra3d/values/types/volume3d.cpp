#include "algebra3d/values/types/detail/geometry.h"
#include "algebra3d/values/types/detail/geometry_type.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

class Volume3dType final : public GeometryType<Volume3d> {
 public:
  Volume3dType()
      : GeometryType({.name = "volume3d",
                      .doc = "A solid bounded by triangles that are oriented outward, with exact coordinates; cavities "
                             "and several bodies included.",
                      .notation = "(tri*), tri = (p1 p2 p3), p = (x y z)",
                      .example = "(((0 0 0) (0 1 0) (1 0 0)) ((0 0 0) (1 0 0) (0 0 1)) ((0 0 0) (0 0 1) (0 1 0)) ((1 0 "
                                 "0) (0 1 0) (0 0 1)))",
                      .kinds = {Kind::data, Kind::spatial3d},
                      .is_large = true,
                      .summary_unit = "triangle",
                      .coordinates = Coordinates::triangles},
                     Orientation::counts) {}
};

}  // namespace

Volume3d::Volume3d() {
  // All empty values share one geometry.
  static const std::shared_ptr<const Geometry> empty = make_geometry({});
  geometry_ = empty;
}

Result<Maybe<Volume3d>> Volume3d::prove(TriangleMesh mesh, const ProofOptions& options) {
  A3D_ASSIGN(const auto report, prove_volume(mesh, options));
  if (!report.is_valid()) return Maybe<Volume3d>(Undefined{fmt::format("no valid solid: {}", report.text())});
  return Maybe<Volume3d>(trusted(std::move(mesh)));
}

Volume3d Volume3d::trusted(TriangleMesh mesh) {
  return Volume3d(make_geometry(std::move(mesh)));
}

const Type& TypeOf<Volume3d>::type() {
  static const Volume3dType the_type;
  return the_type;
}

}  // namespace algebra3d
