#pragma once

#include "queries/streams/batch.h"
#include "queries/streams/stream_operator.h"

namespace queries {

// Streams of tuples that are made in columns where the stream before them is and where the functions are made for
// columns (Function::in_columns); else tuple by tuple.

/// Lists the rows whose value is a defined TRUE.
void select_true(const SelectedRows& rows, const ValueColumn& holds, std::vector<std::uint32_t>& selected);

/// The tuples for which the predicate is TRUE.
TupleStreamPtr selected_tuples(TupleStreamPtr tuples, std::shared_ptr<const Function> predicate,
                               const algebra3d::Context& context);

/// A new tuple for each, whose attributes are of the old one or made by functions. It has no id.
TupleStreamPtr made_tuples(TupleStreamPtr tuples, AttributeSources sources, const DatumList& functions);

/// The first `count` tuples.
TupleStreamPtr first_tuples(TupleStreamPtr tuples, std::size_t count);

}  // namespace queries
