#pragma once

#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

/// A place for one file, which is removed at the end.
class RemovedFile {
 public:
  explicit RemovedFile(std::filesystem::path path) : path_(std::move(path)) {}
  RemovedFile(const RemovedFile&) = delete;
  RemovedFile& operator=(const RemovedFile&) = delete;
  ~RemovedFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }
  bool is_written() const { return is_written_; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(std::filesystem::file_size(path_)); }

 protected:
  void set_written(bool is_written) { is_written_ = is_written; }

 private:
  std::filesystem::path path_;
  bool is_written_ = false;
};
