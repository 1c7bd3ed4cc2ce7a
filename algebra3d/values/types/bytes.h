#pragma once

#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// bytes: any bytes, such as the content of a file. As long as a text may be.
struct Bytes {
  std::string content;
};

template <>
struct TypeOf<Bytes> {
  static const Type& type();
};

/// Two hexadecimal digits for each byte, in lower case. Cost: linear.
std::string hex_digits(std::string_view bytes);

/// The bytes that hexadecimal digits stand for, in upper or lower case; a prefix `\x`, as PostgreSQL writes it, is
/// skipped. Errors: invalid_value with the character, from 1, what was found and what was expected. Cost: linear.
Result<std::string> bytes_of_hex(std::string_view digits);

}  // namespace algebra3d
