#pragma once

#include <string>
#include <string_view>

#include "queries/store/detail/database.h"

namespace queries {

/// Reads the bytes of an object that is neither relation, function nor index definition. Errors: database_corrupt.
Result<std::string> read_object_bytes(Database& database, const CatalogueEntry& entry);
/// Writes the bytes of such an object; updates checksum and presence of a value in `entry`.
Status write_object_bytes(Database& database, CatalogueEntry& entry, std::string_view bytes);

}  // namespace queries
