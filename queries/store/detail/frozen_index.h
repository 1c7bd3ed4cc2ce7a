#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "queries/streams/spatial_index.h"

namespace queries {

/// Encodes the entries of a tree, with a checksum: docs/file_format.md. Equal entries give equal bytes.
std::string encode_tree(const SpatialIndex::Tree& tree);
/// Decodes the bytes of `encode_tree`. Errors: database_corrupt.
Result<std::shared_ptr<SpatialIndex::Tree>> decode_tree(std::string_view bytes);

}  // namespace queries
