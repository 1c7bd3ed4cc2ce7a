#include "base/working_folder.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <system_error>

#include "base/propagate.h"
#include "base/text.h"

namespace algebra3d {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUploads = "uploads";

bool is_below(const fs::path& folder, const fs::path& file) {
  const auto [in_folder, in_file] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return in_folder == folder.end();
}

// Names with `..` are refused even where they would come back: the folders that they pass through must not be probed.
bool leads_out(const fs::path& name) {
  return name.is_absolute() || std::ranges::any_of(name, [](const fs::path& part) { return part == ".."; });
}

// A link whose target does not exist: writing there would create the target.
bool is_dangling_link(const fs::path& file) {
  std::error_code ignored;
  return fs::is_symlink(fs::symlink_status(file, ignored)) && !fs::exists(file, ignored);
}

bool is_hidden(const fs::path& name) {
  return std::ranges::any_of(name, [](const fs::path& part) { return part != "." && part.native().starts_with('.'); });
}

// A file that is to be made need not exist.
bool stays_below(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path root = fs::canonical(folder.empty() ? "." : folder, error);
  if (error) return false;
  const fs::path real = fs::weakly_canonical(fs::current_path(error) / file, error);
  return !error && is_below(root, real) && !is_dangling_link(file);
}

fs::path without_first(const fs::path& name) {
  fs::path rest;
  for (auto part = std::next(name.begin()); part != name.end(); ++part) rest /= *part;
  return rest;
}

}  // namespace

WorkingFolder WorkingFolder::confined(fs::path folder, fs::path uploads, Writing writing) {
  WorkingFolder result(std::move(folder));
  result.uploads_ = std::move(uploads);
  result.is_confined_ = true;
  result.writing_ = writing;
  return result;
}

Result<fs::path> WorkingFolder::path_of(const fs::path& name) const {
  if (!is_confined_) return folder_ / name;
  const bool is_upload = !name.empty() && *name.begin() == kUploads && !uploads_.empty();
  const fs::path& folder = is_upload ? uploads_ : folder_;
  const fs::path file = folder / (is_upload ? without_first(name) : name);
  if (leads_out(name) || !stays_below(folder, file))
    return Error{ErrorCode::permission_denied,
                 "'{}' leads out of the working folder; expected a relative name within it", name.string()};
  if (is_hidden(name))
    return Error{ErrorCode::permission_denied, "'{}' is a hidden file: a part of its name begins with a point",
                 name.string()};
  return file;
}

Result<OutputPath> WorkingFolder::output_path_of(const fs::path& name) const {
  A3D_ASSIGN(fs::path file, path_of(name));
  if (!is_confined_) return OutputPath(std::move(file));
  if (writing_ == Writing::none)
    return Error{ErrorCode::permission_denied, "'{}' cannot be written: files are only read here", name.string()};
  OutputPath output = OutputPath::new_file(std::move(file));
  A3D_TRY(output.check_free(name));
  return output;
}

bool WorkingFolder::hides(const fs::path& name) const {
  return is_confined_ && is_hidden(name);
}

std::string WorkingFolder::with_names(std::string message) const {
  return uploads_.empty() ? message : with_replaced(std::move(message), uploads_.string(), kUploads);
}

Error WorkingFolder::with_names(Error error) const {
  error.subject = with_names(std::move(error.subject));
  error.message = with_names(std::move(error.message));
  return error;
}

}  // namespace algebra3d
