#pragma once

#include <compare>
#include <cstdint>
#include <string>

#include "algebra3d/types/value.h"

namespace algebra3d {

/// The C++ classes of int, real and bool are std::int64_t, double and bool; that of string is std::string.
/// The class of text is its own, since the language keeps the two apart.
struct Text {
  std::string content;
};

template <>
struct TypeOf<std::int64_t> {
  static const Type& type();
};
template <>
struct TypeOf<double> {
  static const Type& type();
};
template <>
struct TypeOf<bool> {
  static const Type& type();
};
template <>
struct TypeOf<std::string> {
  static const Type& type();
};
template <>
struct TypeOf<Text> {
  static const Type& type();
};

/// The characters of a defined string or text.
const std::string& characters_of(const Value& value);

/// The exact order of an int and a finite real, although few large ints are reals.
std::strong_ordering compare(std::int64_t integer, double real);

}  // namespace algebra3d
