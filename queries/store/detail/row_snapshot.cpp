#include "queries/store/detail/row_snapshot.h"

#include "base/propagate.h"
#include "queries/store/detail/tables.h"

namespace queries {
namespace {

using algebra3d::Status;

/// Copies what `select` gives for its parameter or parameters, `columns` wide.
Status copy_rows(SqliteStatement& select, SqliteConnection& to, const std::string& insert_sql, std::size_t columns) {
  while (true) {
    A3D_ASSIGN(const bool has_row, select.step());
    if (!has_row) return {};
    A3D_ASSIGN(SqliteStatement insert, to.use(insert_sql));
    for (std::size_t i = 0; i < columns; ++i) insert.bind(static_cast<int>(i) + 1, select.column(static_cast<int>(i)));
    A3D_TRY(insert.run());
  }
}

}  // namespace

void RowSnapshot::clear() {
  connection_.reset();
  tables_.clear();
}

// Nothing of it outlives the statement, so that nothing need be certain to reach a disk.
Status RowSnapshot::prepare(const RelationLayout& layout) {
  if (connection_ == nullptr) {
    A3D_ASSIGN(auto connection, SqliteConnection::open_temporary());
    for (const char* sql : {"PRAGMA synchronous = OFF", "PRAGMA journal_mode = OFF", kCreateChunks, kCreateChunkIndex})
      A3D_TRY(connection->execute(sql));
    connection_ = std::move(connection);
  }
  if (!tables_.insert(layout.table_number()).second) return {};
  return connection_->execute(layout.create_sql());
}

Status RowSnapshot::keep(SqliteConnection& from, const RelationLayout& layout, std::int64_t tuple) {
  A3D_TRY(prepare(layout));
  {
    A3D_ASSIGN(SqliteStatement row, from.use(layout.row_sql()));
    row.bind(1, tuple);
    A3D_TRY(copy_rows(row, *connection_, layout.insert_sql(), layout.column_count()));
  }
  A3D_ASSIGN(SqliteStatement chunks,
             from.use("SELECT owner, tuple, attribute, part, bytes FROM chunks WHERE owner = ? AND tuple = ?"));
  chunks.bind(1, layout.table_number()).bind(2, tuple);
  return copy_rows(chunks, *connection_, "INSERT INTO chunks VALUES(?, ?, ?, ?, ?)", 5);
}

}  // namespace queries
