#pragma once

#include <string>
#include <string_view>

#include "algebra3d/values/types/nested_list.h"

namespace queries {

/// Appends `text` as a JSON string in quotes. Control characters, also U+0080 to U+009F, are escaped, so that a
/// terminal does not execute them. Domain: UTF-8. Source: [rfc8259], section 7.
void append_json_string(std::string& json, std::string_view text);

/// Appends a value list as JSON: lists are arrays, numbers are numbers with all their digits, strings, texts and
/// symbols (fractions such as `1/3`) are strings, `undefined` is null.
void append_json(std::string& json, const algebra3d::NestedList& list);

}  // namespace queries
