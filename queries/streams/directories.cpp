// getDirectory: the files of a folder as a stream.
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "algebra3d/types/scalars.h"
#include "algebra3d/types/utf8.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
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
    RETURN_IF_ERROR(context.check_cancelled());
    std::error_code ignored;  // a file that has gone meanwhile, or a dangling link, is no file
    if (!entry->is_regular_file(ignored)) continue;
    if (fnmatch(pattern.c_str(), entry->path().filename().c_str(), FNM_CASEFOLD) != 0) continue;
    const std::string name = (fs::path(shown) / entry->path().lexically_relative(folder)).string();
    files.push_back(algebra3d::shown_as_text(name));
    if (files.back() != name)
      context.diagnostics.report(
          "getDirectory: the name of a file is no UTF-8; its bytes are given as \\xff, and it cannot be opened by them",
          files.back());
  }
  std::ranges::sort(files);
  return files;
}

Result<Plan> map_get_directory(std::span<const ArgumentType> arguments) {
  const MappingCheck check("getDirectory", arguments);
  RETURN_IF_ERROR(check.argument_count(1, 2));
  for (std::size_t place = 0; place < check.count(); ++place) RETURN_IF_ERROR(check.characters(place));
  return Plan{
      TypeExpr::stream("text"), [](const std::vector<Datum>& given, Context& context) -> Result<Datum> {
        std::vector<std::string> words;
        for (const Datum& word : given)
          if (word.value().is_defined()) words.push_back(algebra3d::characters_of(word.value()));
        std::vector<std::string> files;
        if (words.size() == given.size()) {
          const std::string pattern = words.size() == 2 ? words[1] : "*";
          ASSIGN_OR_RETURN(files, files_below(context.resolve(words[0]), words[0], pattern, context));
        }
        return Datum{make_value_stream([files, position = std::size_t{0}]() mutable -> Result<std::optional<Value>> {
          if (position == files.size()) return std::optional<Value>();
          return std::optional(Value::of<algebra3d::Text>({files[position++]}));
        })};
      }};
}

}  // namespace

void register_directories(algebra3d::Registry& registry) {
  registry.add({
      .name = "getDirectory",
      .syntax = "getDirectory(_ ...)",
      .doc = "The names of the files in a folder and below, sorted; with a pattern (such as '*.stl') only those that "
             "fit it.",
      .detail = "The pattern is matched against the file's own name: `*` any characters, `?` one, `[...]` one of a "
                "set; upper "
                "and lower case are the same to it, as for `algebra3d import`.",
      .stream = stream_operator(map_get_directory),
      .signatures = {"(text) -> stream(text)", "(text text) -> stream(text)"},
      .handles_undefined = true,
      .examples = {{"getDirectory('.', 'no such file*') count", "0"},
                   {"getDirectory([const text value undefined]) count", "0"}},
      .errors = {{"query getDirectory('/no/such/folder') count",
                  "getDirectory: '/no/such/folder': No such file or directory, expected a folder that can be read"},
                 {"query getDirectory(5) count", "getDirectory: expected text, got int"}},
  });
}

}  // namespace queries
