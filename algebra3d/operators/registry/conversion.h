#pragma once

#include <optional>
#include <string_view>

#include "algebra3d/values/types/type_expr.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

// Implicit conversions: an int where a real is expected, a string where a text is expected, and a text where a string
// is expected.

/// The cost of converting a value of type `from` to `to`: 0 for the same type, nothing if it is impossible. Text to
/// string costs more than any number of conversions of strings to texts, so that both together become texts.
std::optional<std::size_t> conversion_cost(const TypeExpr& from, std::string_view to);

/// Converts a loaded value to type `to`; the conversion must exist. An int becomes the nearest real; undefined stays
/// undefined.
Value converted(const Value& value, const Type& to);

}  // namespace algebra3d
