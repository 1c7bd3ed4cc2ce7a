#include "base/open_databases.h"

#include <mutex>
#include <set>
#include <string>
#include <system_error>

namespace algebra3d {
namespace {

namespace fs = std::filesystem;

/// The database files that this process has open; one list for the process, as its locks are.
struct OpenFiles {
  std::mutex mutex;
  std::multiset<fs::path> files;  // canonical
};

OpenFiles& open_files() {
  static OpenFiles files;
  return files;
}

fs::path real_path(const fs::path& file) {
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error);
  fs::path result = fs::weakly_canonical(absolute, error);
  return error ? absolute : result;
}

bool is_same_file(const fs::path& kept, const fs::path& path, const fs::path& canonical_path) {
  std::error_code error;
  return kept == canonical_path || fs::equivalent(kept, path, error);
}

}  // namespace

OpenDatabase::OpenDatabase(const fs::path& file) : file_(real_path(file)) {
  const std::lock_guard lock(open_files().mutex);
  open_files().files.insert(file_);
}

OpenDatabase::~OpenDatabase() {
  const std::lock_guard lock(open_files().mutex);
  open_files().files.erase(open_files().files.find(file_));
}

std::optional<fs::path> open_database_with(const fs::path& path) {
  const fs::path where = real_path(path);
  const std::lock_guard lock(open_files().mutex);
  for (const fs::path& file : open_files().files) {
    if (is_same_file(file, path, where)) return file;
    for (const char* ending : kSidecarEndings)
      if (is_same_file(file.string() + ending, path, where)) return file;
  }
  return std::nullopt;
}

}  // namespace algebra3d
