#pragma once

#include <compare>
#include <cstdint>
#include <string>

#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// The C++ class of text. Those of int, real, bool and string are std::int64_t, double, bool and std::string; text has
/// its own class, since the language distinguishes it from string.
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

/// Compares an int and a finite real exactly, although most large ints are not reals.
std::strong_ordering compare(std::int64_t integer, double real);

}  // namespace algebra3d
