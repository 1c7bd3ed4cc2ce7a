#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "queries/streams/spatial_index.h"

namespace queries {

/// The entries of a tree as bytes, checksummed: docs/file_format.md. The same entries give the same bytes.
std::string encode_tree(const SpatialIndex::Tree& tree);
/// Errors: database_corrupt.
Result<std::shared_ptr<SpatialIndex::Tree>> decode_tree(std::string_view bytes);

}  // namespace queries
