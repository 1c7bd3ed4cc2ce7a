#pragma once

#include <string_view>

#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/moving_region.h"

namespace algebra3d {

// Shared by the types uregion and mregion.

/// Reads `(interval (face+))`. Errors: invalid_value, `what` begins the message; interrupted.
Result<Maybe<RegionUnit>> unit_from_nested(const NestedList& list, std::string_view what, const Monitor& monitor);
NestedList unit_to_nested(const RegionUnit& unit);

/// Writes a unit: docs/file_format.md, "A unit".
void write_unit(ByteWriter& writer, const RegionUnit& unit);
/// Reads a unit; proves it unless `trusted`. If the bytes are malformed, the reader records the failure. Errors:
/// database_corrupt with the reason for an invalid unit.
Result<Maybe<RegionUnit>> read_unit(ByteReader& reader, std::string_view what, bool trusted);

}  // namespace algebra3d
