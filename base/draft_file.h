#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// A new, empty file with an interim name: `PREFIX` + process id + `-N` + `ENDING`. It is locked during the lifetime of
/// this object and removed by `remove`, not by the destructor. The lock distinguishes it from a leftover of a killed
/// process; the process id does not, since other hosts and containers use the same ids.
///
/// The lock belongs to the open file description (F_OFD_SETLK), on a byte that no other lock uses. Closing a file
/// releases all POSIX locks of the process on it; so if SQLite has the file open too, this object must outlive the
/// connection.
class DraftFile {
 public:
  /// Creates a file in the folder of `target`, the final name, which errors mention. Errors: those of write_error.
  static Result<DraftFile> create(const std::filesystem::path& target, std::string_view prefix,
                                  std::string_view ending);

  DraftFile(DraftFile&& other) noexcept;
  DraftFile& operator=(DraftFile&& other) noexcept;
  DraftFile(const DraftFile&) = delete;
  DraftFile& operator=(const DraftFile&) = delete;
  ~DraftFile();

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }
  /// Tries to lock a draft on another descriptor; false if its owner has the lock, or locks are not available.
  static bool lock(int descriptor);
  /// Removes the file, if it still has the interim name.
  void remove();

 private:
  DraftFile(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  std::filesystem::path path_;  // empty: removed or renamed
  int descriptor_ = -1;
};

/// Removes a file with the name of a draft, and SQLite's files beside it, if it is abandoned: it is not locked, not
/// open as a database, and `is_draft` recognises its content. Other files are left alone.
void remove_if_abandoned(const std::filesystem::path& draft, const std::function<bool(int descriptor)>& is_draft);

/// True if `text` is a process id with an optional number, as in names of drafts: `123` or `123-4`.
bool is_draft_number(std::string_view text);

}  // namespace algebra3d
