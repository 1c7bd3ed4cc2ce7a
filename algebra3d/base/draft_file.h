#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// A new, empty file that its owner writes under an interim name: `PREFIX` + process id + `-N` + `ENDING`. It is locked
/// as long as this object lives and removed by `remove`, not by the destructor. The lock, and not the process id, which
/// other hosts and containers use as well, tells it from a leftover of a process that was killed.
///
/// The lock is one of an open file description (F_OFD_SETLK) on a byte that no other lock uses. As with every file,
/// closing it gives up the POSIX locks that this process has on it: where SQLite has the file open too, this object
/// outlives the connection.
class DraftFile {
 public:
  /// A file in the folder of `target`, for which it is made and which errors name; `prefix` is that of its name.
  /// Errors: those of write_error.
  static Result<DraftFile> create(const std::filesystem::path& target, std::string_view prefix,
                                  std::string_view ending);

  DraftFile(DraftFile&& other) noexcept;
  DraftFile& operator=(DraftFile&& other) noexcept;
  DraftFile(const DraftFile&) = delete;
  DraftFile& operator=(const DraftFile&) = delete;
  ~DraftFile();

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }
  /// Takes the lock of a draft on another descriptor of its file; false: its owner has it, or there are no locks.
  static bool lock(int descriptor);
  /// Removes the name, if the file still has it.
  void remove();

 private:
  DraftFile(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  std::filesystem::path path_;  // empty: removed, or renamed by its owner
  int descriptor_ = -1;
};

/// Removes a file with the name of a draft, and what SQLite keeps beside it, if its owner is gone: if nobody holds its
/// lock, nobody has it open as a database, and `is_draft` says that its content is that of a draft, which neither the
/// name nor the lock proves. Everything else is left alone.
void remove_if_abandoned(const std::filesystem::path& draft, const std::function<bool(int descriptor)>& is_draft);

/// Whether all of `text` is a process id and perhaps a number, as in names of drafts: `123` or `123-4`.
bool is_draft_number(std::string_view text);

}  // namespace algebra3d
