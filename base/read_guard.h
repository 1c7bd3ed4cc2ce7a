#pragma once

#include <filesystem>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// Decides which files a statement may read, where its text comes from somebody else (a saved file that is being
/// restored). It is asked before a file is touched; several threads may ask at the same time.
class ReadGuard {
 public:
  virtual ~ReadGuard() = default;
  ReadGuard() = default;
  ReadGuard(const ReadGuard&) = delete;
  ReadGuard& operator=(const ReadGuard&) = delete;
  /// Whether `file` may be read; a folder, whether its files may be listed. Errors: permission_denied.
  virtual Status check(const std::filesystem::path& file) = 0;
};

}  // namespace algebra3d
