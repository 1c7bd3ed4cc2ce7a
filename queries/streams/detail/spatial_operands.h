#pragma once

#include "algebra3d/operators/registry/registry.h"
#include "queries/streams/mapping.h"

namespace queries {

/// The operands of a spatial join: two streams, and a spatial attribute of each.
struct SpatialOperands {
  std::size_t left_key, right_key;  ///< attribute indices
  TypeExpr left_type, right_type;   ///< of the attributes
  TypeExpr joined;                  ///< tuple type of the result
};

/// Those of a join of two streams: the streams at places 0 and 1, the attributes at 2 and 3.
Result<SpatialOperands> spatial_operands(const algebra3d::Registry& registry, const MappingCheck& check);

/// Those of a join of a stream with itself: the stream at place 0, the attribute at place 1. In the result the
/// attributes of the first tuple of a pair end in `_a`, those of the second in `_b`.
Result<SpatialOperands> spatial_self_operands(const algebra3d::Registry& registry, const MappingCheck& check);

}  // namespace queries
