#pragma once

#include <string>
#include <string_view>

#include "algebra3d/operators/json_tree.h"
#include "algebra3d/types/value.h"

namespace queries {

/// The value of `type` that a JSON value means: null is undefined; a string is the text itself for string and text, and
/// what it says for all others (list_of_text); numbers and booleans are those; arrays are value lists, as in `[1, 2,
/// 3]` for `(1 2 3)`. Anything can be a text or a string: objects and arrays are JSON without white space there.
/// Errors: invalid_value with what was found and expected.
algebra3d::Result<algebra3d::Value> value_of_json(const algebra3d::Type& type, std::string_view json,
                                                  algebra3d::Context& context);

}  // namespace queries
