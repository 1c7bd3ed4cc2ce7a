#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "algebra3d/base/error.h"

namespace queries {

/// A file without a name; it is deleted with this object, even if the process is killed. Written at its end, read
/// anywhere. Used by one thread.
class TemporaryFile {
 public:
  /// Creates the file in `folder`. Errors: disk_full, io_error, with what the user can do.
  static algebra3d::Result<std::unique_ptr<TemporaryFile>> make(const std::filesystem::path& folder);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  algebra3d::Status append(std::string_view bytes);
  std::uint64_t size() const { return size_; }
  /// Reads `bytes` from `offset` on. Domain: bytes that have been written.
  algebra3d::Status read(std::uint64_t offset, std::span<char> bytes) const;

 private:
  TemporaryFile(int descriptor, std::filesystem::path folder) : descriptor_(descriptor), folder_(std::move(folder)) {}

  int descriptor_;
  std::filesystem::path folder_;
  std::uint64_t size_ = 0;
};

}  // namespace queries
