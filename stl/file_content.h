#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include "algebra3d/base/error.h"
#include "stl/input_file.h"

namespace stl {

/// Gives back bytes that were mapped, or allocated by malloc (0 mapped bytes).
struct ReleaseBytes {
  std::size_t mapped_bytes = 0;
  void operator()(char* data) const;
};

/// The bytes of a file, as a copy that no other process can change or cut short.
/// The bytes live as long as this object, which is their only owner; moving keeps their address. Reading them from
/// several threads is safe. A mapping of the file itself would be no such copy: touching what another process has cut
/// off raises SIGBUS, and what was checked may be something else when it is read again.
class FileContent {
 public:
  /// Reads the whole of `file`. A file of more than `most_in_memory` bytes is copied into a temporary file without a
  /// name, which is mapped; the default is a quarter of the machine's memory, so that larger files than that can be
  /// read as well. Errors: those of InputFile::for_each_block; out_of_memory; disk_full or io_error of the temporary
  /// file, which name its folder. Cost: linear; 30 ms for 100 MB that the system has in its cache.
  static algebra3d::Result<FileContent> read(const InputFile& file, const std::atomic<bool>* cancel = nullptr);
  static algebra3d::Result<FileContent> read(const InputFile& file, const std::atomic<bool>* cancel,
                                             std::size_t most_in_memory);
  /// The same of the file at `path`. Errors: also those of InputFile::open.
  static algebra3d::Result<FileContent> read(const std::filesystem::path& path,
                                             const std::atomic<bool>* cancel = nullptr);

  [[nodiscard]] std::string_view bytes() const { return {data_.get(), size_}; }

 private:
  using Data = std::unique_ptr<char, ReleaseBytes>;

  FileContent(Data data, std::size_t size) : data_(std::move(data)), size_(size) {}
  static Data room_for(std::size_t size);
  static algebra3d::Result<FileContent> in_memory(const InputFile& file, const std::atomic<bool>* cancel);
  static algebra3d::Result<FileContent> in_temporary_file(const InputFile& file, const std::atomic<bool>* cancel);

  Data data_;  // null exactly if the file is empty
  std::size_t size_ = 0;
};

}  // namespace stl
