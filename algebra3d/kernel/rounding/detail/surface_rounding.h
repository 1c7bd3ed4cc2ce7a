#pragma once

#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/detail/rounding_job.h"
#include "algebra3d/kernel/rounding/rounded_surface.h"

namespace algebra3d {

/// The rounding of a surface.
class SurfaceRounding : public RoundingJob {
 public:
  /// The surface must outlive this.
  SurfaceRounding(const TriangleMesh& surface, const CoordinateGrid& grid, const Monitor& monitor);

  bool is_solid() const override { return false; }
  Folded folded() const override { return Folded::stays; }
  /// All pieces, each once.
  Result<std::optional<TriangleMesh>> divided(const TriangleMesh& mesh, std::size_t max_pairs) const override;
  using RoundingJob::divided;
  /// An empty candidate is refused if a wider reach than the first one was needed.
  Result<bool> prove(const RoundingCandidate& candidate) override;
  Result<bool> accept_moved() override;

  /// The last accepted candidate; nothing is known of the vertices that moved.
  RoundedSurface&& result() { return std::move(result_); }

 private:
  RoundedSurface result_;
};

}  // namespace algebra3d
