#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "algebra3d/base/error.h"

namespace stl {

/// A regular file, mapped into memory for reading.
/// The bytes live as long as this object, which is their only owner; moving keeps their address. Reading them from
/// several threads is safe. If another process cuts the file short meanwhile, touching the lost part raises SIGBUS, as
/// with every mapping.
class MappedFile {
 public:
  /// Maps the file at `path`. Domain: a regular file, also an empty one; folders, pipes and devices are refused.
  /// Errors: file_missing (no such file), io_error (everything else); both name the path and the system's reason.
  static algebra3d::Result<MappedFile> open(const std::filesystem::path& path);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  [[nodiscard]] std::string_view bytes() const { return {data_, size_}; }

 private:
  MappedFile(const char* data, std::size_t size) : data_(data), size_(size) {}

  const char* data_ = nullptr;  // null exactly if the file is empty
  std::size_t size_ = 0;
};

}  // namespace stl
