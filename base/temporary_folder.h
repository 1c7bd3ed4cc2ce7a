#pragma once

#include <filesystem>

#include "algebra3d/base/error.h"
#include "base/input_file.h"
#include "base/work_memory.h"

namespace algebra3d {

/// A new, empty folder for temporary files, which the destructor removes with all that is in it. Folders that killed
/// processes have left are removed by the next process that makes such a folder beside them: a living owner has a lock
/// on a file beside the content, as with DraftFile.
class TemporaryFolder {
 public:
  /// Makes a folder below `parent`. Errors: io_error.
  static Result<TemporaryFolder> make(const std::filesystem::path& parent = WorkMemory::default_folder());

  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept;
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return content_; }
  /// Leaves the folder to the user: it is never removed.
  void keep();
  /// Removes the folders below `parent` whose owner has died without removing them. `make` does this once per process
  /// and parent.
  static void remove_leftovers(const std::filesystem::path& parent);

 private:
  TemporaryFolder(std::filesystem::path outer, Descriptor lock);

  std::filesystem::path outer_;  // holds the lock file and the content; empty: nothing to remove
  std::filesystem::path content_;
  Descriptor lock_;
};

}  // namespace algebra3d
