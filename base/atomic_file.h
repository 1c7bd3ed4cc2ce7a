#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "base/byte_sink.h"
#include "base/draft_file.h"
#include "base/output_path.h"

namespace algebra3d {

/// A file that is written atomically: under another name in the same folder, then renamed. Owns the temporary file
/// until `commit`; if destroyed before, or if commit fails, the temporary file is removed and the file at the path
/// stays unchanged. The temporary file of a killed process is removed by the next process that writes to the folder.
/// Used by one thread; of several objects for one path the last to commit wins. Errors of all members: disk_full,
/// file_missing (no such folder, no name), io_error; all name the path and the reason; interrupted (see OutputPath).
/// `create` and `commit` also: wrong_usage for a database and the files beside it (see database_part);
/// permission_denied if there is a file that may not be replaced, also one that came meanwhile.
class AtomicFile final : public ByteSink {
 public:
  /// Begins to write the file at `path`. Domain: a new file, or, if it may be replaced, a writable regular file, also
  /// through a symbolic link; its permissions are kept.
  static Result<AtomicFile> create(const OutputPath& path);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() override;

  /// Appends `bytes`; buffered.
  Status append(std::string_view bytes) override;
  /// Writes the buffer, syncs the file to disk, and renames it. At most once.
  Status commit();

 private:
  AtomicFile() = default;

  Status check_replaceable() const;
  Status flush();
  Status give_name() const;

  std::filesystem::path path_;  // as given, for messages
  bool may_replace_ = true;
  Monitor monitor_;
  std::filesystem::path target_;    // symbolic links resolved
  std::optional<DraftFile> draft_;  // empty: nothing to remove
  std::unique_ptr<char[]> buffer_;
  std::size_t buffered_ = 0;
};

/// Writes the file at `path` by `write`, atomically. Errors: those of AtomicFile, and those of `write`, about the path.
Status write_file(const OutputPath& path, const std::function<Status(ByteSink&)>& write);

}  // namespace algebra3d
