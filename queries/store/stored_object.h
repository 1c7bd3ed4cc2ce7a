#pragma once

#include <string>
#include <string_view>

#include "queries/store/database.h"

namespace queries {

/// The bytes of an object that is neither relation, function nor index definition. Errors: database_corrupt.
Result<std::string> read_object_bytes(Database& database, const CatalogueEntry& entry);
/// Gives it other bytes; checksum and presence of a value go to `entry`.
Status write_object_bytes(Database& database, CatalogueEntry& entry, std::string_view bytes);

}  // namespace queries
