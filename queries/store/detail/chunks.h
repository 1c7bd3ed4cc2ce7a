#pragma once

#include <string>
#include <string_view>

#include "queries/store/detail/sqlite_connection.h"

namespace queries {

/// The owner of the chunks of a long value: an attribute of a tuple of a table, or (owner 0) an object.
struct ChunkPlace {
  std::int64_t owner = 0;
  std::int64_t tuple = 0;
  std::int64_t attribute = 0;
};

/// Writes `bytes` in chunks of at most `chunk_bytes`.
algebra3d::Status write_chunks(SqliteConnection& connection, const ChunkPlace& place, std::string_view bytes,
                               std::uint64_t chunk_bytes);
/// Reads and joins all chunks; `size` bytes in all. Errors: database_corrupt.
algebra3d::Result<std::string> read_chunks(SqliteConnection& connection, const ChunkPlace& place, std::int64_t size);
/// Erases the chunks of one value.
algebra3d::Status erase_chunks(SqliteConnection& connection, const ChunkPlace& place);
/// Erases the chunks of all attributes of a tuple.
algebra3d::Status erase_chunks(SqliteConnection& connection, std::int64_t owner, std::int64_t tuple);
algebra3d::Status erase_all_chunks(SqliteConnection& connection, std::int64_t owner);

}  // namespace queries
