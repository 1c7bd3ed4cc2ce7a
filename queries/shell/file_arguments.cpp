#include "queries/shell/file_arguments.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/base/open_databases.h"
#include "algebra3d/types/utf8.h"
#include "stl/foreign_file.h"
#include "stl/input_file.h"
#include "stl/mesh_format.h"
#include "stl/stl_binary_reader.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;

namespace {

constexpr std::size_t kSampleBytes = std::size_t{64} << 10U;
constexpr std::string_view kExpected =
    "expected a script of commands, a database of algebra3d, or an STL, OBJ or OFF file";

bool has_mesh_ending(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".stl" || ending == ".obj" || ending == ".off";
}

/// A file that is not there is known by its name alone.
bool is_missing_mesh(const std::string& name) {
  std::error_code error;
  return has_mesh_ending(name) && !std::filesystem::exists(name, error);
}

bool is_binary_stl(std::string_view head, std::size_t size) {
  return head.size() >= stl::kBinaryPrefixBytes &&
         size == stl::kBinaryPrefixBytes + stl::announced_facet_count(head) * stl::kBinaryFacetBytes;
}

/// Zero bytes are in no text. Other bytes that are no UTF-8 have a message with their place when the script is run.
bool is_binary(std::string_view head) {
  return head.find('\0') != std::string_view::npos;
}

FileArgument kind_of(std::string_view head, std::size_t size, const std::string& name) {
  if (head.starts_with("SQLite format 3")) return {FileKind::database, {}};
  if (is_binary_stl(head, size) || has_mesh_ending(name) || stl::format_of_content(head)) return {FileKind::mesh, {}};
  if (const std::string_view kind = stl::foreign_kind(head); !kind.empty())
    return {FileKind::other, fmt::format("it is {}; {}", kind, kExpected)};
  if (is_binary(head)) return {FileKind::other, fmt::format("it is a binary file of an unknown kind; {}", kExpected)};
  return {};
}

}  // namespace

FileArgument examine_file(const std::string& name) {
  std::error_code error;
  if (name == "-" || !std::filesystem::is_regular_file(name, error)) return {};
  const auto file = stl::InputFile::open(name);
  if (!file) return {};  // what runs it has the message
  const auto head = file->head(kSampleBytes);
  return head ? kind_of(*head, file->size(), name) : FileArgument{};
}

std::string why_no_script(const std::string& name) {
  if (algebra3d::open_database_with(name)) return "it holds the open database";
  const FileArgument argument = examine_file(name);
  if (argument.kind == FileKind::mesh) return "it is a mesh file; `query importSTL('" + name + "')` reads such files";
  if (argument.kind == FileKind::database) return "it is a database; `algebra3d --db " + name + "` opens it";
  return argument.reason;
}

Result<NamedFiles> sort_named_files(const std::vector<std::string>& names) {
  NamedFiles files;
  for (const std::string& name : names) {
    const FileKind kind = examine_file(name).kind;
    if (kind == FileKind::mesh || is_missing_mesh(name)) {
      files.meshes.push_back(name);
    } else if (kind != FileKind::database) {
      files.scripts.push_back(name);
    } else if (files.database.empty()) {
      files.database = name;
    } else {
      return Error{ErrorCode::wrong_usage, "'{}' and '{}' are databases; one can be open", files.database, name};
    }
  }
  if (files.meshes.empty() || files.meshes.size() == names.size()) return files;
  return Error{ErrorCode::wrong_usage,
               "'{}' is a mesh file, and '{}' is none; mesh files are looked at without a database, or read by scripts "
               "(importSTL, importOBJ, importOFF)",
               files.meshes.front(), files.scripts.empty() ? files.database : files.scripts.front()};
}

}  // namespace queries
