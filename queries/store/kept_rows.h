#pragma once

#include <memory>
#include <set>

#include "queries/store/relation_layout.h"
#include "queries/store/sqlite_connection.h"

namespace queries {

/// Copies of rows, as they stood when a statement began, that no connection to the database shows any more: those that
/// an earlier statement of the same transaction wrote and this one erases or overwrites. They lie in a temporary
/// database with the same tables, in memory first and in a file of the system's once there are many.
class KeptRows {
 public:
  /// Copies a row and its chunks. Errors: those of the two databases.
  algebra3d::Status keep(SqliteConnection& from, const RelationLayout& layout, std::int64_t tuple);
  /// From which they are read; null if none was kept.
  SqliteConnection* connection() const { return connection_.get(); }
  void clear();

 private:
  algebra3d::Status prepare(const RelationLayout& layout);

  std::unique_ptr<SqliteConnection> connection_;
  std::set<std::int64_t> tables_;
};

}  // namespace queries
