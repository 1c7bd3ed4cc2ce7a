#pragma once

#include <string>
#include <utility>

#include "algebra3d/database/value.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d::database::detail {

/// The shared content of a value: the loaded value of the engine, and the reason if it is undefined.
struct ValueContent {
  algebra3d::Value value;
  std::string reason;
};

/// Converts between the values of the interface and those of the engine.
struct ValueAccess {
  /// `value` must be loaded. `reason` is used if it is undefined.
  static Value outer(const algebra3d::Value& value, std::string reason = {});
  static algebra3d::Value inner(const Value& value);
  /// An undefined value of the type string.
  static Value missing(std::string reason);
};

}  // namespace algebra3d::database::detail
