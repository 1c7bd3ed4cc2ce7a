#pragma once

#include <filesystem>
#include <utility>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// The folder in which relative file names of a statement begin, and whether names may lead out of it. Immutable; may
/// be copied and used by several threads.
class WorkingFolder {
 public:
  /// Names lead anywhere. An empty folder is the process's working directory.
  // NOLINTNEXTLINE(google-explicit-constructor): a folder alone is enough
  WorkingFolder(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}
  /// Names must stay in `folder`, also through symbolic links; absolute names are refused. Names that begin with
  /// `uploads/` mean files in `uploads` instead, which they must not leave either.
  static WorkingFolder confined(std::filesystem::path folder, std::filesystem::path uploads);

  const std::filesystem::path& path() const { return folder_; }
  /// The file that `name` means. Errors: permission_denied for a name that leads out of a confined folder.
  Result<std::filesystem::path> path_of(const std::filesystem::path& name) const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path uploads_;
  bool is_confined_ = false;
};

}  // namespace algebra3d
