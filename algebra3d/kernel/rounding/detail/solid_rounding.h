#pragma once

#include <optional>

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/detail/rounding_job.h"
#include "algebra3d/kernel/rounding/detail/solid_part.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"

namespace algebra3d {

/// The rounding of a solid, or of a part of it.
class SolidRounding : public RoundingJob {
 public:
  /// The solid and the part must outlive this.
  SolidRounding(const TriangleMesh& solid, const SolidPart& part, const CoordinateGrid& grid, const Monitor& monitor);

  bool is_whole() const override { return part_.is_whole(); }
  bool is_solid() const override { return true; }
  Folded folded() const override { return Folded::vanishes; }
  /// The cells with a positive winding number.
  Result<std::optional<TriangleMesh>> divided(const TriangleMesh& mesh, std::size_t max_pairs) const override;
  using RoundingJob::divided;
  /// First the candidate's simplified form is tried. An empty one is refused if a wider reach than
  /// the first one was needed, or if a cell of the grid is found within the solid.
  Result<bool> prove(const RoundingCandidate& candidate) override;
  /// If the part can be simplified, only its simplified form is tried.
  Result<std::optional<double>> prove_moved_vertices() override;
  Result<bool> accept_cover() override;

  /// The last accepted candidate, put in place of the part; nothing is known of the vertices that moved.
  RoundedSolid&& result() { return std::move(result_); }

 private:
  void find_places_that_stay();
  /// Whether the candidate, which is empty, may be the result.
  Result<bool> may_vanish(const RoundingCandidate& candidate) const;
  /// The candidate in a simpler form (simpler_form.h), or nothing. Vertices at `places_that_stay_` stay.
  Result<std::optional<RoundingCandidate>> simplified(const RoundingCandidate& candidate) const;
  /// Accepts the candidate without simplification if it is valid, an empty one only if the solid may vanish.
  Result<bool> accept_as_it_is(const RoundingCandidate& candidate);
  /// Proves the solid with `added` in place of `part`, and makes it the result; pairs of `known` faces are not tested.
  Result<bool> accept_in_place_of(const SolidPart& part, const TriangleMesh& added, const FaceSet& known,
                                  const RoundingCandidate& candidate);

  const TriangleMesh& solid_;
  const SolidPart& part_;
  PointTable places_that_stay_;  // of vertices of the part at whose faces no corner moves
  RoundedSolid result_;
};

}  // namespace algebra3d
