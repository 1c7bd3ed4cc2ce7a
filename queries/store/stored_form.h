#pragma once

#include <string>

#include "algebra3d/base/error.h"
#include "algebra3d/values/types/value.h"

/// Values and their binary form (docs/file_format.md), for moving values between stores without encoding them again.
namespace queries {

/// The binary form of a value. That of a large value in a store is copied, after a check of its checksum, without being
/// decoded; any other is encoded. Errors: database_corrupt; limit_exceeded for too many digits.
algebra3d::Result<std::string> stored_form(const algebra3d::Value& value);

/// A value that a store writes in the given form. Requires a loaded value, and that `bytes` were decoded to it.
algebra3d::Value with_form(const algebra3d::Value& value, std::string bytes);

}  // namespace queries
