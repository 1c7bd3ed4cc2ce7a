#pragma once

#include <optional>
#include <span>
#include <variant>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {

// The topological relations of two sets in space. All sets are closed. A point is its own interior; the interior of a
// box that is a rectangle or a segment is that within its plane or line; that of a surface is the surface without its
// boundary edges; that of a solid is open. All other points are boundary. The empty set is inside every set and meets
// none.
//
// How it is decided: docs/spatial-relations.md. All decisions are exact, also for exact coordinates. Cost: that of
// walking two box hierarchies where the sets are near each other, plus a ray through one hierarchy for each component
// of the other that nothing touches; a question ends as soon as its answer is known. Errors: interrupted.

/// Points in ascending order, without duplicates.
struct PointSet {
  std::span<const ExactPoint> points;
};
/// A set as an operand: points, a box (which is not empty; it may be flat), a surface or a solid. Cheap to copy; refers
/// to points, which must outlive it.
using SpatialSet = std::variant<PointSet, Box3, Surface3d, Volume3d>;

/// True if they have a point in common.
Result<bool> do_meet(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor = {});
/// True if they meet, but their interiors do not.
Result<bool> do_touch(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor = {});
/// True if every point of a is in b.
Result<bool> is_inside(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor = {});
/// True if their interiors meet and neither is inside the other.
Result<bool> do_overlap(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor = {});

/// How two sets lie to each other.
struct RelativePosition {
  bool do_meet = false;
  bool do_interiors_meet = false;
  bool is_first_inside = false;   ///< every point of the first is in the second
  bool is_second_inside = false;  ///< the converse
};
Result<RelativePosition> position_of(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor = {});

/// All about two sets.
struct SpatialRelation : RelativePosition {
  /// The dimension of the common part: -1 if it is empty, else 0 to 3 for points, lines, faces and space.
  int shared_dimension = -1;
  int shared_boundary_dimension = -1;  ///< the same of the boundaries alone
};
Result<SpatialRelation> relation_of(const SpatialSet& a, const SpatialSet& b, const Monitor& monitor = {});

/// Why two sets meet.
struct MeetingWitness {
  ExactPoint point;                ///< common to both
  FaceId first_face, second_face;  ///< triangles of surfaces and solids that meet in it; else invalid
};
/// A common point, or nothing if there is none: of surfaces and solids whose faces meet, a corner of two such faces
/// where one lies in the other set. Deterministic.
Result<std::optional<MeetingWitness>> witness_of_meeting(const SpatialSet& a, const SpatialSet& b,
                                                         const Monitor& monitor = {});

}  // namespace algebra3d
