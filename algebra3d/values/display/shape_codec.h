#pragma once

#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/values/display/shape.h"

namespace algebra3d {

/// A shape as bytes, for keeping it: its arrays one after the other, as they are in memory (docs/file_format.md,
/// "Database files"). Cost: a copy.
std::string encode_shape(const DrawnShape& shape);

/// Decodes the bytes of `encode_shape`. Safe for any bytes; that corners are positions is not checked. Errors:
/// database_corrupt, database_version for a newer form. Cost: a copy.
Result<DrawnShape> decode_shape(std::string_view bytes);

}  // namespace algebra3d
