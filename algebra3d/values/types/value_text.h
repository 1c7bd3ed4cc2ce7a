#pragma once

#include <string>

#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// A type that prints its values without their nested list, which takes many times the memory of the text.
class DirectText {
 public:
  virtual ~DirectText() = default;
  DirectText() = default;
  DirectText(const DirectText&) = delete;
  DirectText& operator=(const DirectText&) = delete;
  /// Appends what `to_nested(value).print_to(text)` would.
  virtual void append_text(const Value& value, std::string& text) const = 0;
};

/// Appends the value list of a loaded value, or `undefined`, as `value.to_nested().print_to(text)` does.
void append_text(const Value& value, std::string& text);

}  // namespace algebra3d
