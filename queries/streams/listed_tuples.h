#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "queries/streams/relation.h"

namespace queries {

/// Ids of tuples, and how they are to be read.
struct TupleList {
  std::vector<TupleId> ids;
  std::vector<bool> read;                                         ///< attributes, as for Relation::by_id
  std::function<bool(const Batch& batch, std::size_t row)> fits;  ///< whether a tuple is as it must be; null: all are
  /// Called for an id without a tuple, or whose tuple does not fit. After success that id is left out, or its tuple
  /// stays.
  std::function<Status(TupleId id, bool has_tuple)> found_wrong;
};

/// The tuples of a relation with these ids, in their order, as they are when the first one is asked for. It reads some
/// ahead, more and more of them.
TupleStreamPtr listed_tuples(std::shared_ptr<Relation> relation, TupleList list, const algebra3d::Context& context);

/// The tuples of a stream, all of which the relation has, as `by_id` reads them.
TupleStreamPtr tuples_by_ids_of(TupleStreamPtr tuples, std::shared_ptr<Relation> relation,
                                std::unique_ptr<TuplesById> by_id);

}  // namespace queries
