#include "queries/shell/file_arguments.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/base/open_databases.h"
#include "algebra3d/types/utf8.h"
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

/// How files of other programs begin.
constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kOtherFiles{{
    {"PK\x03\x04", "a ZIP archive (as .3mf and .xlsx files are)"},
    {"\x1f\x8b", "compressed by gzip"},
    {"\x28\xb5\x2f\xfd", "compressed by zstd"},
    {"\xfd"
     "7zXZ",
     "compressed by xz"},
    {"BZh", "compressed by bzip2"},
    {"7z\xbc\xaf", "a 7z archive"},
    {"\x7f"
     "ELF",
     "a program"},
    {"\x89PNG", "a PNG image"},
    {"\xff\xd8\xff", "a JPEG image"},
    {"%PDF", "a PDF document"},
    {"glTF", "a binary glTF model"},
    {"Kaydara FBX", "an FBX model"},
    {"\xff\xfe", "text in UTF-16; scripts are UTF-8"},
    {"\xfe\xff", "text in UTF-16; scripts are UTF-8"},
}};

bool has_mesh_ending(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".stl" || ending == ".obj" || ending == ".off";
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
  for (const auto& [begin, what] : kOtherFiles)
    if (head.starts_with(begin)) return {FileKind::other, fmt::format("it is {}; {}", what, kExpected)};
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
    if (kind == FileKind::mesh) {
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
