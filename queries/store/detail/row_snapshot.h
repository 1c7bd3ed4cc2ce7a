#pragma once

#include <memory>
#include <set>

#include "queries/store/detail/relation_layout.h"
#include "queries/store/detail/sqlite_connection.h"

namespace queries {

/// Copies of rows as they were when the statement began. Needed for rows that an earlier statement of the same
/// transaction wrote and this one erases or overwrites: no connection shows them any more. They are kept in a temporary
/// database with the same tables, in memory or, if there are many, in a temporary file.
class RowSnapshot {
 public:
  /// Copies a row with its chunks. Errors: those of the two databases.
  algebra3d::Status keep(SqliteConnection& from, const RelationLayout& layout, std::int64_t tuple);
  /// The connection to the copies; null if there are none.
  SqliteConnection* connection() const { return connection_.get(); }
  void clear();

 private:
  algebra3d::Status prepare(const RelationLayout& layout);

  std::unique_ptr<SqliteConnection> connection_;
  std::set<std::int64_t> tables_;
};

}  // namespace queries
