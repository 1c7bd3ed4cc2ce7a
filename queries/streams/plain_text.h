#pragma once

#include <cstdint>
#include <string_view>

#include "algebra3d/types/value.h"

namespace queries {

/// What a text from outside (a cell of a CSV file, a parameter of the command line) says without a stated type.
enum class PlainKind : std::uint8_t { boolean, integer, real, text };

/// Domain: any bytes. TRUE and FALSE (also `true`, `True`, ...) are booleans. Numbers are as JSON writes them, and also
/// `.5` and `5.`; an integer must fit the type int. Digits that would be lost keep a text a text: `007`, `+5`, and
/// numbers beyond the range. Blanks at the ends do not count.
PlainKind plain_kind(std::string_view text);

/// The value list of `type` that the text means: the text itself for string, text and the types that are written as a
/// string (instant); TRUE or FALSE for bool; a number, also `007` and `+5`, for int and real; a nested list for all
/// others. Errors: invalid_value "expected an int, found "x"".
algebra3d::Result<algebra3d::NestedList> list_of_text(const algebra3d::Type& type, std::string_view text);

/// The text in quotes, on one line and cut where it is long: for messages.
std::string quoted_excerpt(std::string_view text);
/// Without the blanks and tabulators at its ends.
std::string_view without_blanks(std::string_view text);

}  // namespace queries
