#pragma once

#include <optional>

#include "algebra3d/base/monitor.h"
#include "algebra3d/values/spatial_relations/relation.h"
#include "algebra3d/values/types/face_blocks.h"

namespace algebra3d {

// Questions about two sets of which one at least is a stored surface or solid whose faces are read in blocks
// (face_blocks.h), those that can matter: the answers are exactly those of the functions for sets in memory
// (relation.h, nearest_points.h). Nothing, if too many faces would be read: then the sets have to be loaded. Errors:
// those of reading, interrupted. Cost: that of the faces read, and a microsecond for some blocks.

/// A set as an operand: in memory, or a surface or solid in blocks. Refers to the blocks.
struct BlockedSet {
  /// A set in memory, and its box.
  BlockedSet(SpatialSet set, const Box3& box);
  /// A surface, or a solid.
  BlockedSet(const FaceBlocks& blocks, bool is_solid);

  std::optional<SpatialSet> in_memory;
  const FaceBlocks* blocks = nullptr;  ///< null: in memory
  bool is_solid = false;               ///< of blocks
  Box3 box;
};

/// As do_meet.
Result<std::optional<bool>> do_meet_by_blocks(const BlockedSet& a, const BlockedSet& b, const Monitor& monitor = {});
/// As squared_distance_of. No set may be empty.
Result<std::optional<Rational>> squared_distance_by_blocks(const BlockedSet& a, const BlockedSet& b,
                                                           const Monitor& monitor = {});
/// As are_within. No set may be empty.
Result<std::optional<bool>> are_within_by_blocks(const BlockedSet& a, const BlockedSet& b, double distance,
                                                 const Monitor& monitor = {});

}  // namespace algebra3d
