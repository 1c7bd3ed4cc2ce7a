#include "queries/session/database_files.h"

#include <system_error>

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Status;

Status remove_database_files(const std::filesystem::path& file) {
  for (const char* suffix : {"-wal", "-shm", ""}) {
    std::error_code error;
    std::filesystem::remove(file.string() + suffix, error);
    if (error) return Error{ErrorCode::io_error, "{}{} cannot be removed: {}", file.string(), suffix, error.message()};
  }
  return {};
}

// A link, and not a new name, so that a database that has come there meanwhile is not overwritten.
Status put_in_place(const std::filesystem::path& made, const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_hard_link(made, file, error);
  if (error == std::errc::file_exists)
    return Error{ErrorCode::database_exists, "there is a database {} already", file.string()};
  if (error) return Error{ErrorCode::io_error, "{} cannot be made: {}", file.string(), error.message()};
  std::filesystem::remove(made, error);
  return {};
}

}  // namespace queries
