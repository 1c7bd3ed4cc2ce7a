#include "queries/session/database_files.h"

#include <system_error>

#include "algebra3d/base/file_error.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Status;

// A link, and not a new name, so that a database that has come there meanwhile is not overwritten.
Status put_in_place(const std::filesystem::path& made, const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_hard_link(made, file, error);
  if (error == std::errc::file_exists)
    return Error{ErrorCode::database_exists, "there is a database {} already", file.string()};
  if (error) return algebra3d::write_error(file, error.value());
  std::filesystem::remove(made, error);
  return {};
}

}  // namespace queries
