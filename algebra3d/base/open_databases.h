#pragma once

#include <filesystem>
#include <optional>

namespace algebra3d {

/// The announcement that this process has a database open, as long as the object lives. Safe to use from several
/// threads.
///
/// Whatever opens files by names that users give asks `open_database_with` first: SQLite's locks are POSIX locks, and
/// closing any descriptor of a file gives up all locks that the process has on it.
class OpenDatabase {
 public:
  explicit OpenDatabase(const std::filesystem::path& file);
  ~OpenDatabase();
  OpenDatabase(const OpenDatabase&) = delete;
  OpenDatabase& operator=(const OpenDatabase&) = delete;

 private:
  std::filesystem::path file_;
};

/// Endings of the names of the files that SQLite keeps beside a database.
inline constexpr const char* kSidecarEndings[] = {"-wal", "-shm", "-journal"};

/// The database open in this process that is kept in the file at `path` or in one beside it, be it by way of links, or
/// that would be if the file were made. Files are compared by device and inode; never opened.
std::optional<std::filesystem::path> open_database_with(const std::filesystem::path& path);

}  // namespace algebra3d
