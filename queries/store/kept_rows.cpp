#include "queries/store/kept_rows.h"

#include "queries/store/tables.h"

namespace queries {
namespace {

using algebra3d::Status;

/// Copies what `select` gives for its parameter or parameters, `columns` wide.
Status copy_rows(SqliteStatement& select, SqliteConnection& to, const std::string& insert_sql, std::size_t columns) {
  while (true) {
    ASSIGN_OR_RETURN(const bool has_row, select.step());
    if (!has_row) return {};
    ASSIGN_OR_RETURN(SqliteStatement insert, to.use(insert_sql));
    for (std::size_t i = 0; i < columns; ++i) insert.bind(static_cast<int>(i) + 1, select.column(static_cast<int>(i)));
    RETURN_IF_ERROR(insert.run());
  }
}

}  // namespace

void KeptRows::clear() {
  connection_.reset();
  tables_.clear();
}

// Nothing of it outlives the statement, so that nothing need be certain to reach a disk.
Status KeptRows::prepare(const RelationLayout& layout) {
  if (connection_ == nullptr) {
    ASSIGN_OR_RETURN(auto connection, SqliteConnection::open_temporary());
    for (const char* sql : {"PRAGMA synchronous = OFF", "PRAGMA journal_mode = OFF", kCreateChunks, kCreateChunkIndex})
      RETURN_IF_ERROR(connection->execute(sql));
    connection_ = std::move(connection);
  }
  if (!tables_.insert(layout.table_number()).second) return {};
  return connection_->execute(layout.create_sql());
}

Status KeptRows::keep(SqliteConnection& from, const RelationLayout& layout, std::int64_t tuple) {
  RETURN_IF_ERROR(prepare(layout));
  {
    ASSIGN_OR_RETURN(SqliteStatement row, from.use(layout.row_sql()));
    row.bind(1, tuple);
    RETURN_IF_ERROR(copy_rows(row, *connection_, layout.insert_sql(), layout.column_count()));
  }
  ASSIGN_OR_RETURN(SqliteStatement chunks,
                   from.use("SELECT owner, tuple, attribute, part, bytes FROM chunks WHERE owner = ? AND tuple = ?"));
  chunks.bind(1, layout.table_number()).bind(2, tuple);
  return copy_rows(chunks, *connection_, "INSERT INTO chunks VALUES(?, ?, ?, ?, ?)", 5);
}

}  // namespace queries
