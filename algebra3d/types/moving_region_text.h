#pragma once

#include <string_view>

#include "algebra3d/types/binary_io.h"
#include "algebra3d/types/moving_region.h"

namespace algebra3d {

// The parts that the types uregion and mregion share.

/// Reads `(interval (face+))`. Errors: invalid_value, `what` begins the message; interrupted.
Result<Maybe<RegionUnit>> unit_from_nested(const NestedList& list, std::string_view what, const Monitor& monitor);
NestedList unit_to_nested(const RegionUnit& unit);

/// docs/file_format.md, "A unit".
void write_unit(ByteWriter& writer, const RegionUnit& unit);
/// Nothing if the bytes are no unit, which the reader then knows. Without `trusted` it is proved. Errors:
/// database_corrupt with the reason, where it is not valid.
Result<Maybe<RegionUnit>> read_unit(ByteReader& reader, std::string_view what, bool trusted);

}  // namespace algebra3d
