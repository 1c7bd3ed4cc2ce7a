#include "base/file_error.h"

#include <cerrno>
#include <system_error>

#include <sys/statvfs.h>
#include <unistd.h>

namespace algebra3d {
namespace {

namespace fs = std::filesystem;

/// The first part of the path that is not there, or is there and no folder.
fs::path first_bad_folder(const fs::path& folder) {
  fs::path walked;
  for (const fs::path& part : folder) {
    walked /= part;
    std::error_code error;
    if (!fs::is_directory(walked, error)) return walked;
  }
  return folder;
}

std::string missing_folder(const fs::path& folder) {
  const fs::path bad = first_bad_folder(folder);
  std::error_code error;
  if (fs::is_directory(bad, error)) return fmt::format("the folder '{}' takes no new files", bad.string());
  if (!fs::exists(bad, error)) return fmt::format("there is no folder '{}'", bad.string());
  return fmt::format("'{}' is a file, not a folder", bad.string());
}

/// The part of a path that no file system takes, and the limit.
std::string too_long(const fs::path& file) {
  struct statvfs facts {};
  const fs::path folder = folder_of(file);
  const std::size_t most = ::statvfs(folder.c_str(), &facts) == 0 ? facts.f_namemax : 255;
  for (const fs::path& part : file)
    if (part.string().size() > most)
      return fmt::format("a name in it has {} bytes; at most {} are possible", part.string().size(), most);
  return fmt::format("the path is too long, with {} bytes", file.string().size());
}

std::string no_permission(const fs::path& file) {
  std::error_code error;
  if (fs::exists(file, error) && ::access(file.c_str(), W_OK) != 0) return "there is no permission to write this file";
  return fmt::format("there is no permission to write to the folder '{}'", folder_of(file).string());
}

}  // namespace

std::filesystem::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

std::string write_obstacle(const fs::path& file, int reason) {
  switch (reason) {
    case ENOENT:
    case ENOTDIR:
      return missing_folder(folder_of(file));
    case ENAMETOOLONG:
      return too_long(file);
    case EISDIR:
      return "it is a folder, not a file";
    case EACCES:
      return no_permission(file);
    case EPERM:
      return fmt::format("the system does not permit it; perhaps the file or the folder '{}' is marked as immutable",
                         folder_of(file).string());
    case EROFS:
      return fmt::format("the folder '{}' is mounted read-only", folder_of(file).string());
    case ENOSPC:
      return "the disk is full";
    case EDQUOT:
      return "the quota of disk space is used up";
    case EFBIG:
      return "the file would exceed the limit on the size of files";
    case ELOOP:
      return "its symbolic links form a cycle";
    case EMFILE:
    case ENFILE:
      return "too many files are open";
    default:
      return std::generic_category().message(reason);
  }
}

Error write_error(const fs::path& file, int reason) {
  ErrorCode code = ErrorCode::io_error;
  if (reason == ENOSPC || reason == EDQUOT || reason == EFBIG) code = ErrorCode::disk_full;
  if (reason == ENOENT || reason == ENOTDIR) code = ErrorCode::file_missing;
  return Error{code, write_obstacle(file, reason)}.about(file.string());
}

Status check_file_name(const fs::path& file) {
  if (file.empty()) return Error{ErrorCode::file_missing, "the file name is empty"};
  const std::string& name = file.native();
  if (const std::size_t zero = name.find('\0'); zero != std::string::npos)
    return Error{ErrorCode::file_missing, "the file name has a zero byte behind '{}'", name.substr(0, zero)};
  return {};
}

Error interrupted_reading(std::string_view file_name) {
  return Error{ErrorCode::interrupted, "interrupted"}.about(file_name);
}

int folder_obstacle(const fs::path& file) {
  return ::access(folder_of(file).c_str(), W_OK | X_OK) == 0 ? 0 : errno;
}

}  // namespace algebra3d
