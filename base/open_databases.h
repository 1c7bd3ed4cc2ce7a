#pragma once

#include <filesystem>
#include <optional>

namespace algebra3d {

/// Registers a database as open in this process, during the lifetime of the object. Thread-safe.
///
/// Call `open_database_with` before opening a file named by a user: SQLite's locks are POSIX locks, and closing any
/// descriptor of a file releases all locks of the process on it.
class OpenDatabase {
 public:
  explicit OpenDatabase(const std::filesystem::path& file);
  ~OpenDatabase();
  OpenDatabase(const OpenDatabase&) = delete;
  OpenDatabase& operator=(const OpenDatabase&) = delete;

 private:
  std::filesystem::path file_;
};

/// Name endings of SQLite's files beside a database.
inline constexpr const char* kSidecarEndings[] = {"-wal", "-shm", "-journal"};

/// The open database to which the file at `path` belongs, as the database itself or a file beside it, also through
/// links, or to which it would belong if it were created. Files are compared by device and inode and never opened.
std::optional<std::filesystem::path> open_database_with(const std::filesystem::path& path);

}  // namespace algebra3d
