#pragma once

#include <cstdint>
#include <memory>

#include "queries/streams/datum.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"
#include "queries/streams/spatial_index.h"

namespace queries {

/// A search in an index of a relation.
struct IndexSearch {
  std::shared_ptr<SpatialIndex> index;
  RelationPtr relation;
  std::size_t attribute;  ///< the indexed one, in the relation
};

/// The `limit` tuples whose geometry is nearest to that of `to`, a defined value that is not empty, by ascending exact
/// distance, then by id. Candidates come by the distance of their boxes, until these are farther away than the next
/// result; so the first tuples come before the others are looked at. Errors: those of loading; interrupted. Source:
/// [hjaltason1999], section 4.
TupleStreamPtr exact_distance_scan(IndexSearch search, Value to, std::uint64_t limit, const Context& context);

}  // namespace queries
