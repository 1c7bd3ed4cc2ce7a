#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace algebra3d {

/// Appends the shortest decimal text that reads back as the same double, with `.0` if it has neither point nor
/// exponent. Infinities and NaN become `inf`, `-inf`, `nan`. Independent of the locale.
void append_real(std::string& text, double value);
std::string real_text(double value);

/// Appends the shortest decimal text that reads back as the same double, without `.0`.
void append_number(std::string& text, double value);
void append_number(std::string& text, std::uint32_t value);

/// Parses a decimal number (`-1`, `.5`, `5.`, `1e-3`, `+2`) to the nearest double. Nothing for other texts and beyond
/// the range of doubles. Independent of the locale. Source: [lemire2021].
std::optional<double> parse_real(std::string_view text);

/// Parses an integer. Nothing for other texts and beyond the range.
std::optional<std::int64_t> parse_int(std::string_view text);

}  // namespace algebra3d
