#pragma once

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/operators/registry/rows.h"
#include "queries/streams/stream_operator.h"

namespace queries {

// Aggregates and table operators (algebra3d/operators/registry) work on values and rows; these functions apply them to
// streams of tuples.

/// Binds an operator that takes streams: a relational operator, or an aggregate over an attribute of a stream.
/// `op` of `registry` and `context` outlive the result. Errors: type_error "filter: expected ..., got ...".
Result<BoundOperator> bind_operator(const algebra3d::Registry& registry, const algebra3d::Operator& op,
                                    std::span<const ArgumentType> arguments, algebra3d::Context& context);
/// Whether `bind_operator` accepts the operator; all others are called with values.
bool takes_streams(const algebra3d::Operator& op);

/// A stream of the rows of a table operator: of tuples, or of values if the overload returns elements. `context`
/// outlives the stream.
Datum stream_of(algebra3d::RowSourcePtr rows, const algebra3d::Overload& overload, algebra3d::Context& context);

}  // namespace queries
