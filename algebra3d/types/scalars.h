#pragma once

#include <cstdint>
#include <string>

#include "algebra3d/types/value.h"

namespace algebra3d {

/// The C++ classes of int, real and bool are std::int32_t, double and bool; that of string is std::string.
/// The class of text is its own, since the language keeps the two apart.
struct Text {
  std::string content;
};

template <>
struct TypeOf<std::int32_t> {
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

}  // namespace algebra3d
