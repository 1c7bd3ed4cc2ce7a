#include "queries/shell/detail/file_arguments.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"
#include "base/input_file.h"
#include "base/open_databases.h"
#include "mesh_formats/foreign_file.h"
#include "mesh_formats/mesh_format.h"
#include "mesh_formats/mesh_formats.h"
#include "queries/shell/detail/screen.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;

namespace {

constexpr std::size_t kSampleBytes = std::size_t{64} << 10U;

std::string expected_text() {
  return fmt::format("expected a script of commands, a database of algebra3d, or an {} file",
                     mesh_formats::known_mesh_formats().names("or"));
}

bool has_mesh_ending(const std::string& name) {
  return mesh_formats::known_mesh_formats().of_name(name) != nullptr;
}

std::vector<std::string> importing_operators() {
  std::vector<std::string> operators;
  for (const mesh_formats::MeshFormat& format : mesh_formats::known_mesh_formats())
    operators.push_back("import" + std::string(format.name));
  return operators;
}

/// The operator for the ending of the file's name, or the first, since each reads what the content is.
std::string importing_operator(const std::string& name) {
  const mesh_formats::MeshFormat* const format = mesh_formats::known_mesh_formats().of_name(name);
  return format == nullptr ? importing_operators().front() : "import" + std::string(format->name);
}

/// A file that is not there is known by its name alone.
bool is_missing_mesh(const std::string& name) {
  std::error_code error;
  return has_mesh_ending(name) && !std::filesystem::exists(name, error);
}

/// Zero bytes are in no text. Other bytes that are not UTF-8 have a message with their place when the script is run.
bool is_binary(std::string_view head) {
  return head.find('\0') != std::string_view::npos;
}

/// Advice on a file of another program.
std::string advice_for(mesh_formats::ForeignContent content, const std::string& name) {
  switch (content) {
    case mesh_formats::ForeignContent::shapes:
      return fmt::format(
          "algebra3d reads {} files (`algebra3d FILE` shows one, `query {}('FILE')` and `algebra3d import` read it "
          "into "
          "a database): save it as one of these in the program that made it",
          mesh_formats::known_mesh_formats().names("and"), importing_operators().front());
    case mesh_formats::ForeignContent::regions:
      return fmt::format("`query importGeoJSON('{}') consume` reads such files", name);
    case mesh_formats::ForeignContent::rows:
      return fmt::format("`query importJSON('{}') consume` reads such files", name);
    case mesh_formats::ForeignContent::other:
      break;
  }
  return expected_text();
}

FileArgument kind_of(std::string_view head, std::size_t size, const std::string& name) {
  if (head.starts_with("SQLite format 3")) return {FileKind::database, {}};
  if (has_mesh_ending(name) || mesh_formats::known_mesh_formats().of_content(head, size) != nullptr)
    return {FileKind::mesh, {}};
  if (const auto kind = mesh_formats::foreign_kind(head); !kind.name.empty())
    return {FileKind::other, fmt::format("it is {}; {}", kind.name, advice_for(kind.content, name))};
  if (const auto kind = mesh_formats::foreign_kind_of_name(name); !kind.name.empty())
    return {FileKind::other, fmt::format("by its name it is {}; {}", kind.name, advice_for(kind.content, name))};
  if (is_binary(head))
    return {FileKind::other, fmt::format("it is a binary file of an unknown kind; {}", expected_text())};
  return {};
}

}  // namespace

FileArgument examine_file(const std::string& name) {
  std::error_code error;
  if (name == "-" || !std::filesystem::is_regular_file(name, error)) return {};
  const auto file = algebra3d::InputFile::open(name);
  if (!file) return {};  // the message comes when it is run
  const auto head = file->head(kSampleBytes);
  return head ? kind_of(*head, file->size(), name) : FileArgument{};
}

std::string why_no_script(const std::string& name) {
  if (algebra3d::open_database_with(name)) return "it holds the open database";
  const FileArgument argument = examine_file(name);
  if (argument.kind == FileKind::mesh)
    return fmt::format("it is a mesh file; `query {}('{}')` reads such files", importing_operator(name), name);
  if (argument.kind == FileKind::database)
    return "it is a database; `algebra3d --db " + shell_word(name) + "` opens it";
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
               "'{}' is a mesh file, and '{}' is not; mesh files are shown without a database, or read by scripts "
               "({})",
               files.meshes.front(), files.scripts.empty() ? files.database : files.scripts.front(),
               fmt::join(importing_operators(), ", ")};
}

}  // namespace queries
