#pragma once

#include <string>
#include <string_view>

#include "algebra3d/values/conversions/json_tree.h"
#include "algebra3d/values/types/value.h"

namespace queries {

/// Converts a JSON value to a value of `type`. null is undefined; a string is itself for string and text, and is parsed
/// by list_of_text for other types; arrays are value lists, `[1, 2, 3]` for `(1 2 3)`. The tuples of a nested relation
/// are objects or arrays. Every JSON value can become a text or a string: objects and arrays are then JSON without
/// white space. Errors: invalid_value with what was found and expected.
algebra3d::Result<algebra3d::Value> value_of_json(const algebra3d::Type& type, std::string_view json,
                                                  algebra3d::Context& context);

}  // namespace queries
