#include "queries/store/detail/chunks.h"

#include "base/propagate.h"

namespace queries {

using algebra3d::Result;
using algebra3d::Status;

Status write_chunks(SqliteConnection& connection, const ChunkPlace& place, std::string_view bytes,
                    std::uint64_t chunk_bytes) {
  for (std::int64_t part = 0; !bytes.empty(); ++part) {
    const std::string_view chunk = bytes.substr(0, chunk_bytes);
    bytes.remove_prefix(chunk.size());
    A3D_ASSIGN(SqliteStatement statement, connection.use("INSERT INTO chunks VALUES(?, ?, ?, ?, ?)"));
    statement.bind(1, place.owner).bind(2, place.tuple).bind(3, place.attribute).bind(4, part);
    A3D_TRY(statement.bind(5, Cell::blob(chunk)).run());
  }
  return {};
}

Result<std::string> read_chunks(SqliteConnection& connection, const ChunkPlace& place, std::int64_t size) {
  A3D_ASSIGN(SqliteStatement statement,
             connection.use("SELECT bytes FROM chunks WHERE owner = ? AND tuple = ? AND attribute = ? "
                            "ORDER BY part"));
  statement.bind(1, place.owner).bind(2, place.tuple).bind(3, place.attribute);
  std::string bytes;
  while (true) {
    A3D_ASSIGN(const bool has_row, statement.step());
    if (!has_row) break;
    bytes += statement.column(0).bytes;
  }
  if (size >= 0 && bytes.size() == static_cast<std::uint64_t>(size)) return bytes;
  return algebra3d::Error{algebra3d::ErrorCode::database_corrupt, "a long value has {} bytes, expected {}",
                          bytes.size(), size}
      .about(connection.file());
}

Status erase_chunks(SqliteConnection& connection, const ChunkPlace& place) {
  A3D_ASSIGN(SqliteStatement statement,
             connection.use("DELETE FROM chunks WHERE owner = ? AND tuple = ? AND attribute = ?"));
  return statement.bind(1, place.owner).bind(2, place.tuple).bind(3, place.attribute).run();
}

Status erase_chunks(SqliteConnection& connection, std::int64_t owner, std::int64_t tuple) {
  A3D_ASSIGN(SqliteStatement statement, connection.use("DELETE FROM chunks WHERE owner = ? AND tuple = ?"));
  return statement.bind(1, owner).bind(2, tuple).run();
}

Status erase_all_chunks(SqliteConnection& connection, std::int64_t owner) {
  A3D_ASSIGN(SqliteStatement statement, connection.use("DELETE FROM chunks WHERE owner = ?"));
  return statement.bind(1, owner).run();
}

}  // namespace queries
