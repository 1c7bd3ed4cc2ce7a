#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include "algebra3d/base/error.h"
#include "base/input_file.h"

namespace algebra3d {

/// Releases bytes that were mapped, or allocated by `operator new` (if 0 bytes are mapped).
struct ReleaseBytes {
  std::size_t mapped_bytes = 0;
  bool is_counted = false;  ///< as memory of the process: not what maps a file
  void operator()(char* data) const;
};

/// A private copy of the bytes of a file. This object owns the bytes; moving keeps their address. Concurrent reading is
/// safe. A mapping of the file itself would not be enough: if another process truncates the file, access raises SIGBUS,
/// and checked bytes may change later.
class FileContent {
 public:
  /// Reads the whole file. A file of more than `most_in_memory` bytes is copied to an unnamed temporary file, which is
  /// mapped; the default is a third of what the memory limit leaves (memory_limit.h). Errors: those of
  /// InputFile::for_each_block; out_of_memory; disk_full or io_error of the temporary file, with its folder. Cost:
  /// linear; 30 ms for 100 MB in the page cache.
  static Result<FileContent> read(const InputFile& file, const std::atomic<bool>* cancel = nullptr);
  static Result<FileContent> read(const InputFile& file, const std::atomic<bool>* cancel, std::size_t most_in_memory);
  /// Reads the whole file at `path`. Errors: also those of InputFile::open.
  static Result<FileContent> read(const std::filesystem::path& path, const std::atomic<bool>* cancel = nullptr);

  [[nodiscard]] std::string_view bytes() const { return {data_.get(), size_}; }

 private:
  using Data = std::unique_ptr<char, ReleaseBytes>;

  FileContent(Data data, std::size_t size) : data_(std::move(data)), size_(size) {}
  static Data allocated(std::size_t size);
  static Result<FileContent> in_memory(const InputFile& file, const std::atomic<bool>* cancel);
  static Result<FileContent> in_temporary_file(const InputFile& file, const std::atomic<bool>* cancel);

  Data data_;  // null if and only if the file is empty
  std::size_t size_ = 0;
};

}  // namespace algebra3d
