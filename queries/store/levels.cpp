#include "queries/store/levels.h"

#include <memory>
#include <utility>

#include "base/propagate.h"
#include "queries/store/detail/shape_levels.h"
#include "queries/store/detail/stored_value.h"

namespace queries {
namespace {

using algebra3d::ErrorCode;

/// How long keeping a level waits for another writer.
constexpr int kLongestWait = 2000;

std::shared_ptr<const StoredBytes> stored_bytes(const Value& value) {
  return std::dynamic_pointer_cast<const StoredBytes>(value.deferred());
}

/// True if the file holds this very value. Call within a transaction.
Result<bool> is_there(SqliteConnection& connection, const StoredBytes& value) {
  auto statement = connection.use(value.presence_sql());
  // The table of a relation may be gone.
  if (!statement) return statement.error().code == ErrorCode::database_busy ? Result<bool>(statement.error()) : false;
  statement->bind(1, value.level_place().tuple).bind(2, as_signed(value.checksum()));
  return statement->step();
}

/// Writes within a transaction. False if the value is gone.
Result<bool> write_checked(SqliteConnection& connection, const StoredBytes& value, std::uint64_t number,
                           std::string_view bytes) {
  A3D_TRY(connection.execute("BEGIN IMMEDIATE"));
  A3D_ASSIGN(const bool can_be_kept, is_there(connection, value));
  if (!can_be_kept) return false;
  A3D_TRY(write_level(connection, {value.level_place(), value.checksum(), number}, bytes));
  A3D_TRY(connection.execute("COMMIT"));
  return true;
}

}  // namespace

bool is_stored(const Value& value) {
  return stored_bytes(value) != nullptr;
}

Result<std::optional<std::string>> level_of(const Value& value, std::uint64_t number) {
  std::string copy;
  A3D_ASSIGN(const bool is_there, with_level(value, number, [&](std::string_view bytes) -> Status {
               copy = bytes;
               return {};
             }));
  return is_there ? std::optional(std::move(copy)) : std::nullopt;
}

Result<bool> with_level(const Value& value, std::uint64_t number,
                        const std::function<Status(std::string_view bytes)>& visit) {
  const auto stored = stored_bytes(value);
  if (stored == nullptr) return false;
  A3D_ASSIGN(const auto connection, stored->database()->another_connection(false, kLongestWait));
  Status visited;
  const auto found = read_level(*connection, {stored->level_place(), stored->checksum(), number},
                                [&](std::string_view bytes) { visited = visit(bytes); });
  if (!found && found.error().code == ErrorCode::database_corrupt) return false;
  A3D_TRY(visited);
  return found;
}

Result<bool> keep_level(const Value& value, std::uint64_t number, std::string_view bytes) {
  const auto stored = stored_bytes(value);
  if (stored == nullptr || stored->database()->is_read_only() || bytes.size() > kMaxLevelBytes) return false;
  A3D_ASSIGN(const auto connection, stored->database()->another_connection(true, kLongestWait));
  auto kept = write_checked(*connection, *stored, number, bytes);
  if (connection->in_transaction()) static_cast<void>(connection->execute("ROLLBACK"));
  if (!kept && (kept.error().code == ErrorCode::database_busy || kept.error().code == ErrorCode::database_corrupt))
    return false;
  return kept;
}

}  // namespace queries
