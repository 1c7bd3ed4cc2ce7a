#pragma once

#include "queries/language/typed_tree.h"
#include "queries/streams/batch.h"

namespace queries {

/// The function of one tuple or two with this body, in columns (Function::in_columns): null unless the body is made of
/// attributes, values that are the same for all tuples, and operators that have kernels. `outer`: the frames around the
/// function, valid as long as the body and the result, as is `context`.
ColumnFunctionPtr column_function(const TypedNode& body, std::size_t left_count, const Frame* outer, Context& context);

}  // namespace queries
