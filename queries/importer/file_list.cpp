#include "queries/importer/file_list.h"

#include <fnmatch.h>
#include <glob.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"
#include "base/propagate.h"
#include "mesh_formats/mesh_formats.h"

namespace queries {
namespace {

namespace fs = std::filesystem;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

/// In lower case, with its point.
std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

bool has_mesh_ending(const fs::path& path) {
  return mesh_formats::known_mesh_formats().of_name(path.string()) != nullptr;
}

fs::path without_last_slash(const fs::path& path) {
  return path.has_filename() || !path.has_relative_path() ? path : path.parent_path();
}

bool is_below(const fs::path& file, const fs::path& folder) {
  const auto [in_folder, in_file] = std::ranges::mismatch(folder, file);
  return in_folder == folder.end() && in_file != file.end();
}

Result<fs::path> normal_path(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  if (error) return Error{ErrorCode::io_error, error.message()}.about(path_text(path));
  return absolute.lexically_normal();
}

/// The files that the pattern matches, in no particular order.
std::vector<fs::path> matches_of(const std::string& pattern) {
  glob_t found{};
  const std::unique_ptr<glob_t, decltype(&globfree)> owner(&found, &globfree);
  std::vector<fs::path> paths;
  if (glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) != 0) return paths;
  for (std::size_t i = 0; i < found.gl_pathc; ++i) paths.emplace_back(found.gl_pathv[i]);
  return paths;
}

class FileLister {
 public:
  Status add(const std::string& given);
  FileList finish() &&;

 private:
  Status add_existing(const fs::path& path, fs::file_status status);
  Status add_matches(const std::string& pattern);
  Status add_file(const fs::path& path);
  Status add_folder(const fs::path& folder);
  void add_entries(const fs::path& folder, std::vector<fs::path>& waiting);
  void add_entry(const fs::directory_entry& entry, std::vector<fs::path>& waiting);

  FileList list_;
  std::set<fs::path> seen_folders_;
};

Status FileLister::add(const std::string& given) {
  std::error_code error;
  const fs::file_status status = fs::status(given, error);
  if (fs::exists(status)) return add_existing(given, status);
  // An error other than "not found", such as a folder on the way that may not be entered, is the user's answer.
  if (status.type() != fs::file_type::not_found)
    return Error{ErrorCode::io_error, error.message()}.about(path_text(given));
  if (given.find_first_of("*?[") != std::string::npos) return add_matches(given);
  return Error{ErrorCode::file_missing, "no such file or folder"}.about(path_text(given));
}

Status FileLister::add_existing(const fs::path& path, fs::file_status status) {
  if (fs::is_directory(status)) return add_folder(path);
  if (fs::is_regular_file(status)) return add_file(path);
  return Error{ErrorCode::wrong_usage, "is neither a file nor a folder"}.about(path_text(path));
}

Status FileLister::add_matches(const std::string& pattern) {
  bool any = false;
  A3D_ASSIGN(fs::path normal, normal_path(pattern));
  list_.patterns.push_back(std::move(normal));
  for (const fs::path& path : matches_of(pattern)) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::is_directory(status) && !fs::is_regular_file(status)) continue;
    any = true;
    A3D_TRY(add_existing(path, status));
  }
  if (!any)
    return Error{ErrorCode::file_missing, "no such file, and no file matches this pattern"}.about(path_text(pattern));
  return {};
}

Status FileLister::add_file(const fs::path& path) {
  A3D_ASSIGN(fs::path normal, normal_path(path));
  std::error_code error;
  const std::uintmax_t size = fs::file_size(normal, error);
  list_.files.push_back({std::move(normal), error ? 0 : std::uint64_t{size}});
  return {};
}

Status FileLister::add_folder(const fs::path& folder) {
  A3D_ASSIGN(fs::path normal, normal_path(folder));
  list_.folders.push_back(without_last_slash(normal));
  std::vector<fs::path> waiting{list_.folders.back()};
  while (!waiting.empty()) {
    const fs::path next = std::move(waiting.back());
    waiting.pop_back();
    add_entries(next, waiting);
  }
  return {};
}

void FileLister::add_entry(const fs::directory_entry& entry, std::vector<fs::path>& waiting) {
  std::error_code unknown;  // a file whose kind or size cannot be found out is listed: loading it gives the reason
  const bool is_link = entry.is_symlink(unknown);
  if (entry.is_directory(unknown)) {
    if (is_link)
      ++list_.skipped["link to a folder"];
    else
      waiting.push_back(entry.path());
    return;
  }
  if (!has_mesh_ending(entry.path())) {
    const std::string ending = ending_of(entry.path());
    ++list_.skipped[ending.empty() ? "no ending" : path_text(ending)];
    return;
  }
  const std::uintmax_t size = entry.file_size(unknown);
  list_.files.push_back({entry.path(), unknown ? 0 : std::uint64_t{size}});
}

void FileLister::add_entries(const fs::path& folder, std::vector<fs::path>& waiting) {
  if (!seen_folders_.insert(folder).second) return;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) add_entry(*entry, waiting);
  if (error) list_.unread_folders.push_back(fmt::format("{}: {}", path_text(folder), error.message()));
}

FileList FileLister::finish() && {
  const auto before = [](const ListedFile& a, const ListedFile& b) { return a.path.native() < b.path.native(); };
  const auto same = [](const ListedFile& a, const ListedFile& b) { return a.path.native() == b.path.native(); };
  std::sort(list_.files.begin(), list_.files.end(), before);
  list_.files.erase(std::unique(list_.files.begin(), list_.files.end(), same), list_.files.end());
  auto& folders = list_.unread_folders;
  std::sort(folders.begin(), folders.end());
  folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
  return std::move(list_);
}

}  // namespace

Result<FileList> list_files(std::span<const std::string> paths) {
  FileLister lister;
  for (const std::string& path : paths) A3D_TRY(lister.add(path));
  FileList list = std::move(lister).finish();
  if (!list.files.empty()) return list;
  if (!list.unread_folders.empty())
    return Error{ErrorCode::io_error, "{}, and there is no other file to import", list.unread_folders.front()};
  return Error{ErrorCode::file_missing, "there is no file to import: no file below {} ends in {}{}",
               paths.size() == 1 ? path_text(paths.front()) : "the given folders",
               mesh_formats::known_mesh_formats().endings("or"),
               list.skipped.empty() ? "" : fmt::format(" (but {})", skipped_text(list.skipped))};
}

bool FileList::covers(const std::filesystem::path& file) const {
  return std::ranges::any_of(folders, [&](const fs::path& folder) { return is_below(file, folder); }) ||
         std::ranges::any_of(patterns, [&](const fs::path& pattern) {
           return fnmatch(pattern.c_str(), file.c_str(), FNM_PATHNAME | FNM_PERIOD | FNM_LEADING_DIR) == 0;
         });
}

std::string skipped_text(const std::map<std::string, std::uint64_t>& skipped) {
  constexpr std::size_t kShown = 8;
  std::vector<std::pair<std::string, std::uint64_t>> kinds(skipped.begin(), skipped.end());
  std::ranges::stable_sort(kinds, std::ranges::greater(), &std::pair<std::string, std::uint64_t>::second);
  std::string text;
  for (std::size_t i = 0; i < std::min(kinds.size(), kShown); ++i)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", kinds[i].second, kinds[i].first);
  if (kinds.size() > kShown) text += fmt::format(" and {} other endings", kinds.size() - kShown);
  return text;
}

std::string path_text(const std::filesystem::path& path) {
  return algebra3d::shown_as_text(path.native());
}

}  // namespace queries
