#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include <sqlite3.h>

#include "algebra3d/base/open_databases.h"
#include "queries/store/sqlite_statement.h"

namespace queries {

/// One connection to a SQLite file, with its prepared statements. Members may be called by several threads at once; the
/// statements must all have been given back when it ends.
class SqliteConnection {
 public:
  enum class Access : std::uint8_t {
    read_write,
    create,      ///< read and write, makes the file
    recovering,  ///< changes nothing but what recovery after a crash needs: reads as read_only otherwise
    read_only,   ///< with the lock files of other processes
    immutable,   ///< reads the file alone, trusting that nobody changes it
  };

  static algebra3d::Result<std::unique_ptr<SqliteConnection>> open(const std::filesystem::path& file, Access access,
                                                                   int busy_milliseconds);
  /// A new database that is gone with its connection: in memory, or in a temporary file once it is large.
  static algebra3d::Result<std::unique_ptr<SqliteConnection>> open_temporary();
  ~SqliteConnection();
  SqliteConnection(const SqliteConnection&) = delete;
  SqliteConnection& operator=(const SqliteConnection&) = delete;

  const std::string& file() const { return file_; }
  /// Nobody writes through this connection: the system does not let it, or it was opened for reading.
  bool is_read_only() const { return access_ == Access::recovering || sqlite3_db_readonly(handle_, "main") == 1; }
  /// The file that this connection reads and writes no longer has its name: it was deleted or moved.
  bool has_moved() const;
  bool in_transaction() const { return sqlite3_get_autocommit(handle_) == 0; }

  /// Runs a statement whose rows are of no interest.
  algebra3d::Status execute(std::string_view sql);
  /// A statement of this text, prepared before or now.
  algebra3d::Result<SqliteStatement> use(std::string_view sql);
  /// The first column of the first row, an integer. Error if there is no row.
  algebra3d::Result<std::int64_t> integer(std::string_view sql);

  /// All bytes of the database, as a file would have them.
  algebra3d::Result<std::string> image();

  /// From now on a file that ends before its last page is read as far as it goes. For reading alone.
  void tolerate_missing_pages();

  /// While `cancel` is true, what runs ends with the error `interrupted`; null: nothing ends it.
  void end_when(const std::atomic<bool>* cancel);

  algebra3d::Error error(int code, std::string_view doing) const;
  /// For SqliteStatement alone.
  void give_back(sqlite3_stmt* statement, bool* in_use);

 private:
  struct Prepared {
    sqlite3_stmt* statement = nullptr;
    bool in_use = false;
  };

  SqliteConnection(sqlite3* handle, std::string file, Access access)
      : handle_(handle), file_(std::move(file)), access_(access) {}
  algebra3d::Result<sqlite3_stmt*> prepare(std::string_view sql);
  void forget_unused();

  sqlite3* handle_;
  std::string file_;
  std::optional<algebra3d::OpenDatabase> announcement_;  // none: a temporary file
  Access access_;
  std::mutex mutex_;  // guards prepared_
  std::unordered_map<std::string, std::unique_ptr<Prepared>> prepared_;
};

}  // namespace queries
