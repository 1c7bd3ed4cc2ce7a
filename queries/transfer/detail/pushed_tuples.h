#pragma once

#include <cstdint>
#include <functional>

#include "queries/store/store.h"
#include "queries/streams/relation.h"
#include "queries/transfer/detail/moved_columns.h"
#include "queries/transfer/transfer_options.h"

namespace queries {

/// The relation of the options, in an open transaction. Errors: unknown_name, type_error.
Result<RelationPtr> relation_to_push(Store& store, const TransferOptions& options);

/// Reads tuples up to that of a number; `next` is then the first one behind it, or null. `report` is called for each.
/// Their digest.
Result<RowDigest> skip_pushed_tuples(TupleStream& tuples, TuplePtr& next, const MovedColumns& columns,
                                     std::int64_t last_tuple, const std::function<void()>& report);

}  // namespace queries
