#pragma once

#include <string_view>

#include "algebra3d/values/types/nested_list.h"

namespace algebra3d {

/// `NestedList::parse` for a list with expressions, in which integers are ints: an integer beyond 64 bits becomes the
/// symbol `N/1` and not a real, so that the reader of expressions can refuse it.
Result<NestedList> parse_expression_list(std::string_view source, const SourcePlace& start = {{}, 1, 1});

/// Converts such integers to reals, as `NestedList::parse` does, for lists in constants. Cost: linear, no recursion.
void read_large_integers_as_reals(NestedList& list);

}  // namespace algebra3d
