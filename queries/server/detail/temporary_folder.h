#pragma once

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "algebra3d/base/error.h"
#include "algebra3d/base/work_memory.h"

namespace queries {

/// A new folder for large temporary files, removed with all that is in it.
class TemporaryFolder {
 public:
  /// Errors: io_error.
  static algebra3d::Result<TemporaryFolder> make() {
    std::string name = (algebra3d::WorkMemory::default_folder() / "algebra3d-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      return algebra3d::Error{algebra3d::ErrorCode::io_error, "the temporary folder '{}' cannot be made: {}", name,
                              std::strerror(errno)};
    return TemporaryFolder(std::move(name));
  }
  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept {
    std::swap(path_, other.path_);
    return *this;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
};

}  // namespace queries
