#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "algebra3d/base/error.h"
#include "base/output_path.h"

namespace algebra3d {

/// The folder in which relative file names of a statement begin, and what statements may do with files. Immutable; may
/// be copied and used by several threads.
class WorkingFolder {
 public:
  /// Rights of statements to write in a confined folder.
  enum class Writing : std::uint8_t {
    none,       ///< nothing
    new_files,  ///< files that do not exist yet
  };

  /// Names lead anywhere, and files may be replaced. An empty folder is the process's working directory.
  // NOLINTNEXTLINE(google-explicit-constructor): a folder alone is enough
  WorkingFolder(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}
  /// Names must stay in `folder`, also through symbolic links; absolute names, and names of hidden files, are refused.
  /// Names that begin with `uploads/` mean files in `uploads` instead, which they must not leave either.
  static WorkingFolder confined(std::filesystem::path folder, std::filesystem::path uploads, Writing writing);

  const std::filesystem::path& path() const { return folder_; }
  /// The file that `name` means, for reading. Errors: permission_denied for a name that leads out of a confined folder
  /// or to a hidden file.
  Result<std::filesystem::path> path_of(const std::filesystem::path& name) const;
  /// The file that `name` means, for writing. Errors: also permission_denied where nothing may be written, or not over
  /// this file.
  Result<OutputPath> output_path_of(const std::filesystem::path& name) const;
  /// Whether statements see nothing of files with this name, since a part of it begins with a point.
  bool hides(const std::filesystem::path& name) const;
  /// A message in which files are called by the names that lead to them: the path of the uploads is `uploads`.
  std::string with_names(std::string message) const;
  /// The error whose files are called so.
  Error with_names(Error error) const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path uploads_;
  bool is_confined_ = false;
  Writing writing_ = Writing::new_files;  // if confined
};

}  // namespace algebra3d
