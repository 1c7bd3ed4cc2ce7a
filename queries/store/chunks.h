#pragma once

#include <string>
#include <string_view>

#include "queries/store/sqlite_connection.h"

namespace queries {

/// Where the chunks of a long value belong: to an attribute of a tuple of a table, or (owner 0) to an object.
struct ChunkPlace {
  std::int64_t owner = 0;
  std::int64_t tuple = 0;
  std::int64_t attribute = 0;
};

/// Cuts `bytes` into chunks of at most `chunk_bytes`.
algebra3d::Status write_chunks(SqliteConnection& connection, const ChunkPlace& place, std::string_view bytes,
                               std::uint64_t chunk_bytes);
/// All chunks in a row; `size` bytes. Errors: database_corrupt.
algebra3d::Result<std::string> read_chunks(SqliteConnection& connection, const ChunkPlace& place, std::int64_t size);
algebra3d::Status erase_chunks(SqliteConnection& connection, std::int64_t owner, std::int64_t tuple);
algebra3d::Status erase_all_chunks(SqliteConnection& connection, std::int64_t owner);

}  // namespace queries
