#include "queries/server/detail/database_identity.h"

#include <sys/stat.h>

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;

algebra3d::Result<DatabaseIdentity> DatabaseIdentity::of(const std::filesystem::path& file) {
  struct stat status = {};
  if (stat(file.c_str(), &status) != 0)
    return Error{ErrorCode::database_missing, "there is no database '{}'", file.string()};
  DatabaseIdentity identity;
  identity.file_ = std::filesystem::absolute(file);
  identity.device_ = status.st_dev;
  identity.number_ = status.st_ino;
  return identity;
}

algebra3d::Status DatabaseIdentity::check() const {
  struct stat status = {};
  if (stat(file_.c_str(), &status) != 0)
    return Error{ErrorCode::database_missing, "the database '{}' was deleted while it was served; restart the server",
                 file_.filename().string()};
  if (status.st_dev != device_ || status.st_ino != number_)
    return Error{ErrorCode::database_missing,
                 "the database '{}' was replaced by another file while it was served; restart the server",
                 file_.filename().string()};
  return {};
}

}  // namespace queries
