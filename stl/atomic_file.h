#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "algebra3d/base/draft_file.h"
#include "algebra3d/base/error.h"

namespace stl {

/// A file that appears whole or not at all: written under another name in the same folder, then renamed.
/// Owns the temporary file until `commit`; if destroyed before, or if commit fails, the temporary is removed and what
/// was at the path stays as it was; one that a killed process has left is removed by the next that writes into its
/// folder. Not for use by several threads at once; several objects for one path are fine, the last to commit wins.
/// Errors of all members: disk_full, file_missing (no such folder), io_error; all name the path and the reason.
/// `create` and `commit` also: wrong_usage for a file that is a database or is kept beside one (see database_part).
class AtomicFile {
 public:
  /// Begins a file for `path`. Domain: a new file, or a regular file that may be written, also behind a symbolic link;
  /// its permissions are kept.
  static algebra3d::Result<AtomicFile> create(const std::filesystem::path& path);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// Adds `bytes` at the end; buffered.
  algebra3d::Status append(std::string_view bytes);
  /// Writes what is buffered, waits until the disk has it, and puts the file in its place. At most once.
  algebra3d::Status commit();

 private:
  AtomicFile() = default;

  algebra3d::Status check_replaceable() const;
  algebra3d::Status flush();

  std::filesystem::path path_;                 // as given, for messages
  std::filesystem::path target_;               // symbolic links resolved
  std::optional<algebra3d::DraftFile> draft_;  // none: nothing to remove
  std::unique_ptr<char[]> buffer_;
  std::size_t buffered_ = 0;
};

}  // namespace stl
