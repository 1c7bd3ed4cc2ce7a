#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace algebra3d {

/// Appends the shortest decimal text that reads back to the same double; `.0` follows where neither `.` nor an exponent
/// stands. Infinities and NaN give `inf`, `-inf`, `nan`. Independent of the locale.
void append_real(std::string& text, double value);
std::string real_text(double value);

/// The double nearest to the decimal number that is all of `text` (`-1`, `.5`, `5.`, `1e-3`, `+2`), or nothing.
/// Numbers beyond the range of doubles give nothing. Independent of the locale. Source: [lemire2021].
std::optional<double> parse_real(std::string_view text);

/// The integer that is all of `text`, or nothing if it is none or does not fit.
std::optional<std::int64_t> parse_int(std::string_view text);

}  // namespace algebra3d
