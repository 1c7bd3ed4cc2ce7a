#pragma once

#include <sys/types.h>

#include <filesystem>

#include "algebra3d/base/error.h"

namespace queries {

/// Which file a database is, to notice that it was deleted or replaced while it is open: later writes would be lost.
class DatabaseIdentity {
 public:
  /// Errors: database_missing.
  static algebra3d::Result<DatabaseIdentity> of(const std::filesystem::path& file);
  /// The error database_missing if there is no such file any more, or another one of its name.
  algebra3d::Status check() const;
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  dev_t device_ = 0;
  ino_t number_ = 0;
};

}  // namespace queries
