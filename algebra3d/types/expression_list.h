#pragma once

#include <string_view>

#include "algebra3d/types/nested_list.h"

namespace algebra3d {

/// `NestedList::parse` for a list that holds expressions, where an integer means an int: one beyond 64 bits does not
/// become a real but the symbol `N/1`, as it was written, so that the reader of expressions can refuse it.
Result<NestedList> parse_expression_list(std::string_view source, const SourcePlace& start = {{}, 1, 1});

/// Such integers again as `NestedList::parse` reads them: what stands in a constant is no expression.
/// Cost: linear, no recursion.
void read_large_integers_as_reals(NestedList& list);

}  // namespace algebra3d
