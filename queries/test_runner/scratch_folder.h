#pragma once

#include <filesystem>
#include <memory>

#include "algebra3d/base/error.h"

namespace queries {

/// A new, empty folder in the system's folder for temporary files, which is removed afterwards with everything in it.
class ScratchFolder {
 public:
  /// Errors: io_error.
  static algebra3d::Result<std::unique_ptr<ScratchFolder>> make();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// The folder stays.
  void keep() { is_kept_ = true; }

 private:
  explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
  bool is_kept_ = false;
};

}  // namespace queries
