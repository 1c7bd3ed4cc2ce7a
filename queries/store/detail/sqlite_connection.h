#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include <sqlite3.h>

#include "base/open_databases.h"
#include "queries/store/detail/checked_pages.h"
#include "queries/store/detail/sqlite_statement.h"

namespace queries {

/// A connection to a SQLite file, with its prepared statements. Several threads may call its members at the same time.
/// All statements must have been returned before it is destroyed.
class SqliteConnection {
 public:
  enum class Access : std::uint8_t {
    read_write,
    create,      ///< read and write; creates the file
    recovering,  ///< as read_only, but may recover the file after a crash
    read_only,   ///< uses the lock files of other processes
    immutable,   ///< without locks; the file must not change
  };

  /// `busy_milliseconds`: how long statements wait for locks of other connections, before the error database_busy.
  static algebra3d::Result<std::unique_ptr<SqliteConnection>> open(const std::filesystem::path& file, Access access,
                                                                   int busy_milliseconds);
  /// Opens a new database that is deleted with its connection: in memory, or in a temporary file once it is large. Its
  /// pages have room for checksums.
  static algebra3d::Result<std::unique_ptr<SqliteConnection>> open_temporary();
  ~SqliteConnection();
  SqliteConnection(const SqliteConnection&) = delete;
  SqliteConnection& operator=(const SqliteConnection&) = delete;

  const std::string& file() const { return file_; }
  Access access() const { return access_; }
  /// True if the connection cannot write: it was opened for reading, or the file is not writable.
  bool is_read_only() const { return access_ == Access::recovering || sqlite3_db_readonly(handle_, "main") == 1; }
  /// True if the file was deleted or moved since it was opened.
  bool has_moved() const;
  bool in_transaction() const { return sqlite3_get_autocommit(handle_) == 0; }

  /// Whether each page is proved by its checksum when it is read.
  bool proves_pages() const;

  /// Runs a statement and ignores its rows.
  algebra3d::Status execute(std::string_view sql);
  /// Runs a statement without rows that each transaction has, and keeps it prepared.
  algebra3d::Status execute_again(std::string_view sql);
  /// The prepared statement of this text; it is prepared at first use.
  algebra3d::Result<SqliteStatement> use(std::string_view sql);
  /// The first column of the first row, an integer. Error if there is no row.
  algebra3d::Result<std::int64_t> integer(std::string_view sql);

  /// All bytes of a temporary database, as a file would have them: with the checksums of pages.
  algebra3d::Result<std::string> image();

  /// Makes a truncated or damaged file readable as far as it goes: also pages with wrong checksums, which are noted.
  /// For read-only use.
  void tolerate_damaged_pages();
  /// Drops the pages that are in memory, so that they are read and proved again.
  void forget_pages();
  /// The pages with wrong checksums that were read since `forget_pages`.
  std::set<PageFault> page_faults() const;

  /// Sets the flag that ends running statements with the error `interrupted`; null for none.
  void end_when(const std::atomic<bool>* cancel);

  /// Sets the flag that ends waiting for locks with the error `interrupted`; null for none.
  void end_waiting_when(const std::atomic<bool>* cancel) { cancel_ = cancel; }

  /// Sets how long statements wait for locks of other connections.
  void wait_at_most(int milliseconds) { longest_wait_ = std::chrono::milliseconds(milliseconds); }

  algebra3d::Error error(int code, std::string_view doing) const;
  /// Only for SqliteStatement.
  void give_back(sqlite3_stmt* statement, bool* in_use);

 private:
  struct Prepared {
    sqlite3_stmt* statement = nullptr;
    bool in_use = false;
  };

  using Clock = std::chrono::steady_clock;

  SqliteConnection(sqlite3* handle, std::string file, Access access)
      : handle_(handle), file_(std::move(file)), access_(access) {}
  algebra3d::Result<sqlite3_stmt*> prepare(std::string_view sql);
  void forget_unused();
  bool is_cancelled() const;
  bool wait_for_lock(int attempt);

  sqlite3* handle_;
  std::string file_;
  std::optional<algebra3d::OpenDatabase> announcement_;  // none: a temporary file
  Access access_;
  std::chrono::milliseconds longest_wait_{};
  Clock::time_point wait_start_;  // guarded by SQLite's mutex of the connection
  std::atomic<const std::atomic<bool>*> cancel_ = nullptr;
  std::mutex mutex_;  // guards prepared_
  std::unordered_map<std::string, std::unique_ptr<Prepared>> prepared_;
};

}  // namespace queries
