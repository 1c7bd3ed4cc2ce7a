// getDirectory: the files of a folder.
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/utf8.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

// Every regular file in the folder and below whose name fits the pattern, as `folder/...`, sorted.
Result<std::vector<std::string>> files_below(const std::filesystem::path& folder, const std::string& shown,
                                             const std::string& pattern, const Context& context) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<std::string> files;
  auto entry = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
  if (error)
    return Error{ErrorCode::file_missing, "getDirectory: '{}': {}, expected a folder that can be read", shown,
                 error.message()};
  for (; entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (error) return Error{ErrorCode::io_error, "getDirectory: '{}': {}", shown, error.message()};
    A3D_TRY(context.check_cancelled());
    if (context.folder.hides(entry->path().filename())) {
      entry.disable_recursion_pending();
      continue;
    }
    std::error_code ignored;  // a file that has gone meanwhile, or a dangling link, is not a file
    if (!entry->is_regular_file(ignored)) continue;
    if (fnmatch(pattern.c_str(), entry->path().filename().c_str(), FNM_CASEFOLD) != 0) continue;
    const std::string name = (fs::path(shown) / entry->path().lexically_relative(folder)).string();
    files.push_back(shown_as_text(name));
    if (files.back() != name)
      context.diagnostics.report(
          "getDirectory: a file name is not UTF-8; its bytes are shown as \\xNN, and the name cannot be used to open "
          "the file",
          files.back());
  }
  std::ranges::sort(files);
  return files;
}

Result<std::vector<Text>> matching_files(Context& context, const Text& folder, const Text& pattern) {
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(folder.content));
  A3D_ASSIGN(std::vector<std::string> files, files_below(path, folder.content, pattern.content, context));
  std::vector<Text> names;
  names.reserve(files.size());
  for (std::string& file : files) names.push_back({std::move(file)});
  return names;
}

Result<std::vector<Text>> all_files(Context& context, const Text& folder) {
  return matching_files(context, folder, {"*"});
}

}  // namespace

void register_directories(OperatorGroup& group) {
  group.add({
      .name = "getDirectory",
      .syntax = "getDirectory(_ ...)",
      .doc = "The names of the files in a folder and its subfolders, sorted; with a pattern (such as '*.stl') only "
             "those that match it.",
      .detail =
          "The pattern is matched against the file name without its folder: `*` stands for any characters, `?` for "
          "one, brackets for one of those between them; case is ignored.",
      .is_pure = false,
      .reads_files = true,
      .overloads = {overload<&all_files>("folder"), overload<&matching_files>("folder", "pattern")},
      .examples = {{{"'.'", "'no such file*'"}, "0", "(count _)"}, {{"(text undefined)"}, "0", "(count _)"}},
      .errors = {{{"'/no/such/folder'"},
                  "getDirectory: '/no/such/folder': No such file or directory, expected a folder that can be read"},
                 {{"5"}, "getDirectory: expected (text) or (text text), got (int)"}},
  });
}

}  // namespace algebra3d
