#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "algebra3d/base/box3.h"
#include "algebra3d/values/spatial_relations/relation.h"
#include "queries/streams/datum.h"
#include "queries/streams/detail/box_join.h"
#include "queries/streams/mapping.h"

namespace queries {

/// Whether a pair of sets belongs to a join.
enum class PairVerdict : std::uint8_t {
  no,
  yes,
  turned,  ///< yes, with the second one first
};

/// The condition of a join. Called from several threads at once.
struct PairTest {
  /// The verdict if boxes decide it, else nothing; so geometry is not loaded where it is not needed.
  std::function<std::optional<PairVerdict>(const algebra3d::Box3& a, const algebra3d::Box3& b)> by_boxes;
  /// The verdict if a set and the box of the other one decide it, which is the first one if `is_box_of_first`.
  std::function<std::optional<PairVerdict>(const algebra3d::Box3& box, bool is_box_of_first,
                                           const algebra3d::SpatialSet& other)>
      by_one_box;
  std::function<Result<PairVerdict>(const algebra3d::SpatialSet& a, const algebra3d::SpatialSet& b,
                                    const algebra3d::Monitor& monitor)>
      by_geometry;
};

/// The attributes that a join compares, in the tuples of the build side and of the probe side. Their values are
/// spatial, defined and not empty in all pairs.
struct PairKeys {
  std::size_t build, probe;
};

/// The concatenated tuples of the pairs that belong to the join, in the order of the pairs. Pairs are read in blocks,
/// the first of which are small, so that results come soon; a block is as large as the work memory and a limit allow.
/// Each block is examined by SpatialPairs. `stages` of the stream shows how pairs were decided.
TupleStreamPtr refined_join(PairStreamPtr pairs, PairKeys keys, PairTest test, const Context& context);

}  // namespace queries
