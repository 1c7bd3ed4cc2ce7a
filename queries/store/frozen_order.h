#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "algebra3d/registry/registry.h"
#include "queries/streams/ordered_index.h"

namespace queries {

/// The type of the values in a btree object; null if it is none that is known.
const algebra3d::Type* ordered_key_type(const algebra3d::Registry& registry, const TypeExpr& type);

/// The entries of an ordered tree as bytes, checksummed: docs/file_format.md. The same entries give the same bytes.
std::string encode_order(const OrderedTree& tree);
/// Keys are of type `key_type`. Errors: database_corrupt.
Result<std::shared_ptr<OrderedTree>> decode_order(const algebra3d::Type& key_type, std::string_view bytes);

}  // namespace queries
