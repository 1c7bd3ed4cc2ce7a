#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "algebra3d/operators/registry/registry.h"
#include "queries/streams/ordered_index.h"

namespace queries {

/// The type of the keys of a btree object; null if it is unknown.
const algebra3d::Type* ordered_key_type(const algebra3d::Registry& registry, const TypeExpr& type);

/// Encodes the entries of an ordered tree, with a checksum: docs/file_format.md. Equal entries give equal bytes.
std::string encode_order(const OrderedTree& tree);
/// Decodes the bytes of `encode_order`; keys have the type `key_type`. Errors: database_corrupt.
Result<std::shared_ptr<OrderedTree>> decode_order(const algebra3d::Type& key_type, std::string_view bytes);

}  // namespace queries
