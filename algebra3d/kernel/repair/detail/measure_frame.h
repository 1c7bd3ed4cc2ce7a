#pragma once

#include <cstdint>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"
#include "algebra3d/kernel/repair/scaled_triangles.h"

namespace algebra3d {

/// The data that the steps of a measurement share: the triangles as given, the solid made of them, the scale of the
/// coordinates, and the tolerance.
class MeasureFrame {
 public:
  /// `moved`: the largest distance by which a corner was moved, in coordinate units. The arguments must outlive this.
  MeasureFrame(const TriangleMesh& given, const TriangleMesh& solid, double moved, const Monitor& monitor);

  const TriangleMesh& given() const { return given_; }
  const TriangleMesh& solid() const { return solid_; }
  const BinaryScale& scale() const { return scale_; }
  /// The tolerance of a measurement, scaled: triangles that are no farther apart count as lying upon each other. It is
  /// the largest distance by which a corner was moved, or the rounding noise between equal corners if that is larger.
  double tolerance() const { return tolerance_; }

  Triangle3 of_given(FaceId face) const { return scale_.scaled(given_, face); }
  Triangle3 of_solid(FaceId face) const { return scale_.scaled(solid_, face); }
  /// True if a part of a triangle is large enough to be measured.
  bool counts(const ConvexPolygon& part) const { return part.area() > tolerance_ * tolerance_; }
  const Monitor& monitor() const { return monitor_; }
  /// To be called in every loop. Errors: interrupted.
  Status pause() { return ++steps_ % 256 == 0 ? monitor_.check() : Status(); }

 private:
  const TriangleMesh& given_;
  const TriangleMesh& solid_;
  const Monitor& monitor_;
  BinaryScale scale_;
  double tolerance_;
  std::uint64_t steps_ = 0;
};

}  // namespace algebra3d
