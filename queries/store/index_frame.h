#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace queries {

/// What a stored index says before its entries: which kind it is, the version of its form, how many entries follow,
/// and their checksum. docs/file_format.md.
struct IndexFrame {
  std::string_view magic;  ///< four bytes
  std::uint32_t version;
};

/// The entries, encoded one after the other in `body`, with the frame before them.
std::string framed(const IndexFrame& frame, std::uint64_t count, std::string_view body);

struct FramedEntries {
  std::uint64_t count = 0;
  std::string_view body;
};
/// The entries in `bytes`, whose checksum has been found right. `count` is as it was written, and may be wrong.
/// Errors: database_corrupt, database_version.
algebra3d::Result<FramedEntries> unframed(const IndexFrame& frame, std::string_view bytes);

/// The error of a stored index: "stored index: expected EXPECTATION".
algebra3d::Error corrupt_index(std::string_view expectation);
/// The error of entries that are not those that were written.
algebra3d::Error changed_index();

}  // namespace queries
