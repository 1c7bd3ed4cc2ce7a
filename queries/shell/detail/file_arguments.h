#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"

namespace queries {

/// The kind of a file named on the command line, by its content.
enum class FileKind {
  script,    ///< text; also folders and devices, which have their own message
  database,  ///< a SQLite file
  mesh,      ///< a mesh file, or a file with the ending of one
  other,     ///< a file that cannot be a script; `reason` says what it is
};

struct FileArgument {
  FileKind kind = FileKind::script;
  std::string reason;  ///< of `other`: "it is a ZIP archive; expected ..."
};

/// Determines the kind from the first 64 kB of the file; `-` is a script.
FileArgument examine_file(const std::string& name);

/// The reason why the file is not a script, such as "it is a mesh file; ..."; empty if it may be one.
std::string why_no_script(const std::string& name);

/// The files named on a command line, by their use.
struct NamedFiles {
  std::string database;              ///< to be opened; empty if none was named
  std::vector<std::string> meshes;   ///< also missing files with such an ending, which have their own error
  std::vector<std::string> scripts;  ///< and all other files, which are refused when run
};

/// Sorts the files named on the command line. Errors: wrong_usage for two databases, or for mesh files together with
/// other files.
algebra3d::Result<NamedFiles> sort_named_files(const std::vector<std::string>& names);

}  // namespace queries
