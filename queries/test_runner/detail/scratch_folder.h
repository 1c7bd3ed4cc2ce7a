#pragma once

#include <filesystem>
#include <memory>

#include "algebra3d/base/error.h"

namespace queries {

/// A new folder among the system's temporary files, which is deleted with its content by the destructor.
class ScratchFolder {
 public:
  /// Creates the folder. Errors: io_error.
  static algebra3d::Result<std::unique_ptr<ScratchFolder>> make();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Keeps the folder.
  void keep() { is_kept_ = true; }

 private:
  explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
  bool is_kept_ = false;
};

}  // namespace queries
