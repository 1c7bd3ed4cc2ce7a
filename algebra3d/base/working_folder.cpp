#include "algebra3d/base/working_folder.h"

#include <algorithm>
#include <system_error>

namespace algebra3d {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUploads = "uploads";

bool is_below(const fs::path& folder, const fs::path& file) {
  const auto [in_folder, in_file] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return in_folder == folder.end();
}

// Names with `..` are refused even where they would come back: what they pass through is nobody's business.
bool leads_out(const fs::path& name) {
  return name.is_absolute() || std::ranges::any_of(name, [](const fs::path& part) { return part == ".."; });
}

// A link whose target does not exist: what is written there would make the target.
bool is_dangling_link(const fs::path& file) {
  std::error_code ignored;
  return fs::is_symlink(fs::symlink_status(file, ignored)) && !fs::exists(file, ignored);
}

// A file that is to be made need not exist.
bool stays_below(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path root = fs::canonical(folder.empty() ? "." : folder, error);
  if (error) return false;
  const fs::path real = fs::weakly_canonical(file, error);
  return !error && is_below(root, real) && !is_dangling_link(file);
}

fs::path without_first(const fs::path& name) {
  fs::path rest;
  for (auto part = std::next(name.begin()); part != name.end(); ++part) rest /= *part;
  return rest;
}

}  // namespace

WorkingFolder WorkingFolder::confined(fs::path folder, fs::path uploads) {
  WorkingFolder result(std::move(folder));
  result.uploads_ = std::move(uploads);
  result.is_confined_ = true;
  return result;
}

Result<fs::path> WorkingFolder::path_of(const fs::path& name) const {
  if (!is_confined_) return folder_ / name;
  const bool is_upload = !name.empty() && *name.begin() == kUploads && !uploads_.empty();
  const fs::path& folder = is_upload ? uploads_ : folder_;
  const fs::path file = folder / (is_upload ? without_first(name) : name);
  if (!leads_out(name) && stays_below(folder, file)) return file;
  return Error{ErrorCode::permission_denied, "'{}' leads out of the working folder; expected a relative name within it",
               name.string()};
}

}  // namespace algebra3d
