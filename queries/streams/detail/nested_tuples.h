#pragma once

#include <string>
#include <vector>

#include "algebra3d/values/types/nested_relation.h"
#include "queries/streams/datum.h"

namespace queries {

/// A stream of the tuples of a nested relation, of none if it is undefined. The tuples have no ids. A deferred relation
/// is loaded. `context` outlives the stream, which can be interrupted. Errors: those of the store.
Result<TupleStreamPtr> tuples_of_nested(const Value& relation, const algebra3d::Context& context);

/// The nested relation of the attributes `attributes` of all tuples of a stream; `op` names the operator in errors.
/// Errors: those of the stream, of loading, interrupted; limit_exceeded if it does not fit into the work memory.
Result<Value> collected_relation(TupleStream& tuples, const std::vector<std::size_t>& attributes,
                                 const algebra3d::NestedRelationType& type, const std::string& op,
                                 const algebra3d::Context& context);

}  // namespace queries
