#pragma once

#include <cstdint>

#include "queries/streams/datum.h"
#include "queries/streams/index_object.h"
#include "rtree/rtree.h"

namespace queries {

/// An rtree object: an index on the boxes of one attribute.
class SpatialIndex : public IndexObject<rtree::RTree<std::uint64_t>> {
  using IndexObject::IndexObject;
};

}  // namespace queries
