#pragma once

#include <optional>
#include <string_view>

#include "algebra3d/types/type_expr.h"
#include "algebra3d/types/value.h"

namespace algebra3d {

// Implicit conversions: an int where a real is expected, a string where a text is expected, and a text where a string
// is expected.

/// The cost of taking a value of type `from` for one of type `to`: 0 for the same type, nothing if it is impossible.
/// A text for a string costs more than any number of strings for texts, so that both together are texts.
std::optional<std::size_t> conversion_cost(const TypeExpr& from, std::string_view to);

/// A loaded value as one of type `to`, to which its type can be converted. An int becomes the nearest real; undefined
/// stays undefined.
Value converted(const Value& value, const Type& to);

}  // namespace algebra3d
