#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace queries {

/// The header of a stored index: its kind, the version of the encoding, the number of entries, and their checksum. See
/// docs/file_format.md.
struct IndexFrame {
  std::string_view magic;  ///< four bytes
  std::uint32_t version;
};

/// The frame followed by `body`, the encoded entries.
std::string framed(const IndexFrame& frame, std::uint64_t count, std::string_view body);

struct FramedEntries {
  std::uint64_t count = 0;
  std::string_view body;
};
/// Checks frame and checksum of `bytes` and returns the encoded entries. `count` is not checked. Errors:
/// database_corrupt, database_version.
algebra3d::Result<FramedEntries> unframed(const IndexFrame& frame, std::string_view bytes);

/// The error "stored index: expected EXPECTATION".
algebra3d::Error corrupt_index(std::string_view expectation);
/// The error for entries that were changed after writing.
algebra3d::Error changed_index();

}  // namespace queries
