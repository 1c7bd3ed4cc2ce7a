#pragma once

#include <cstdint>
#include <string_view>

#include "algebra3d/values/types/value.h"

namespace queries {

/// The type that a text from outside (a cell of a CSV file, a parameter of the command line) looks like.
enum class PlainKind : std::uint8_t { boolean, integer, real, text };

/// Classifies a text. Domain: any bytes. TRUE and FALSE (also `true`, `True`, ...) are booleans. Numbers are as JSON
/// writes them, and also `.5` and `5.`; an integer must fit the type int. Numbers that would lose characters are texts:
/// `007`, `+5`, and numbers beyond the range. Blanks at the ends are ignored.
PlainKind plain_kind(std::string_view text);

/// True for a number that is a text to plain_kind only because it is beyond the range of int or real.
bool is_number_beyond_range(std::string_view text);

/// Converts a text to a value list of `type`: the text itself for string, text, bytes (hexadecimal digits) and types
/// that are written as a string (instant); TRUE or FALSE for bool; a number, also `007` and `+5`, for int and real; a
/// nested list for all others. Errors: invalid_value "expected an int, found "x"".
algebra3d::Result<algebra3d::NestedList> list_of_text(const algebra3d::Type& type, std::string_view text);

/// The text for messages: in quotes, on one line, shortened if it is long.
std::string quoted_excerpt(std::string_view text);
/// The text without blanks and tabs at its ends.
std::string_view without_blanks(std::string_view text);

}  // namespace queries
