#pragma once

#include <atomic>

#include "algebra3d/base/error.h"
#include "algebra3d/exact/point_table.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/rounding/coordinate_grid.h"
#include "algebra3d/rounding/detail/rounded_vertices.h"
#include "algebra3d/rounding/detail/solid_part.h"
#include "algebra3d/rounding/rounded_solid.h"
#include "algebra3d/rounding/rounding_method.h"

namespace algebra3d {

/// A closed mesh on the grid that may be the rounded solid.
struct RoundingCandidate {
  TriangleMesh mesh;
  double movement = 0;  ///< no point is farther from the given boundary, in coordinate units
  double reach = 0;     ///< within which features were joined, in coordinate units; 0 if none were
  RoundingMethod method = RoundingMethod::vertices_moved;
};

/// The smallest reach within which features are joined, in spacings of the grid.
inline constexpr double kFirstReach = 2;

/// The snap rounded mesh. Errors: interrupted.
Result<RoundingCandidate> snap_rounded(const TriangleMesh& mesh, const RoundedVertices& vertices,
                                       const std::atomic<bool>* cancel);

/// The rounding of a solid, or of a part of it, while methods make candidates: what is given, and the first candidate
/// that was proved.
class RoundingJob {
 public:
  /// The solid must outlive this.
  RoundingJob(const TriangleMesh& solid, SolidPart part, const CoordinateGrid& grid, const std::atomic<bool>* cancel);

  /// The mesh that is to be rounded: the solid or a part of it.
  const TriangleMesh& mesh() const { return part_.mesh(); }
  bool is_whole() const { return part_.is_whole(); }
  const RoundedVertices& vertices() const { return vertices_; }
  const CoordinateGrid& grid() const { return grid_; }
  double size() const { return size_; }  ///< the largest coordinate of the solid
  /// The spacing of the grid there.
  double spacing() const { return spacing_; }
  const std::atomic<bool>* cancel() const { return cancel_; }

  /// Proves the candidate; true if it is valid, and the result from now on. First its form without superfluous vertices
  /// is tried. An empty one is refused if a wider reach than the first one was needed, or if a cell of the grid lies
  /// within the solid: nothing may vanish altogether that is thicker than the grid.
  Result<bool> accept(const RoundingCandidate& candidate);

  /// The last accepted candidate, put in place of the part; nothing is known of the vertices that moved.
  RoundedSolid&& result() { return std::move(result_); }

 private:
  void find_places_that_stay();
  Result<bool> may_vanish(double reach) const;
  Result<RoundingCandidate> without_superfluous(const RoundingCandidate& candidate) const;
  Result<bool> accept_as_it_is(const RoundingCandidate& candidate);

  const TriangleMesh& solid_;
  SolidPart part_;
  CoordinateGrid grid_;
  double size_, spacing_;
  const std::atomic<bool>* cancel_;
  RoundedVertices vertices_;
  PointTable places_that_stay_;  // of vertices of the part of which no facet has a moved corner
  RoundedSolid result_;
};

}  // namespace algebra3d
