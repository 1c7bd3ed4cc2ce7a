#pragma once

#include <atomic>
#include <filesystem>
#include <utility>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// The path of a file that is to be written, and whether it may replace a file that is there.
class OutputPath {
 public:
  /// A file that may be replaced.
  // NOLINTNEXTLINE(google-explicit-constructor): a path alone is enough
  OutputPath(std::filesystem::path path) : path_(std::move(path)) {}
  /// A file that must be new.
  static OutputPath new_file(std::filesystem::path path);

  /// The path for writing that can be cancelled: it ends with the error interrupted once `*cancel` is set, which must
  /// outlive the writing.
  OutputPath with_cancel(const std::atomic<bool>* cancel) const;

  const std::filesystem::path& path() const { return path_; }
  const std::atomic<bool>* cancel() const { return cancel_; }
  bool may_replace() const { return may_replace_; }
  /// Errors: permission_denied if a file is there, of whatever kind, that must not be replaced; it calls the file
  /// `name`.
  Status check_free(const std::filesystem::path& name) const;
  Status check_free() const { return check_free(path_); }

 private:
  std::filesystem::path path_;
  bool may_replace_ = true;
  const std::atomic<bool>* cancel_ = nullptr;
};

/// The error permission_denied for a file that is there and must not be replaced.
Error not_replaced(const std::filesystem::path& name);

}  // namespace algebra3d
