#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"

namespace queries {

/// The kind of a file named on the command line, by its content.
enum class FileKind {
  script,    ///< text, and everything that is no regular file: folders and devices have their own message
  database,  ///< a SQLite file
  mesh,      ///< STL, OBJ or OFF, or a file with such an ending
  other,     ///< what no script can be; `reason` says what it is
};

struct FileArgument {
  FileKind kind = FileKind::script;
  std::string reason;  ///< of `other`: "it is a ZIP archive; expected ..."
};

/// Looks at the beginning of the file; `-` is a script. Reads 64 kB at most.
FileArgument examine_file(const std::string& name);

/// "it is a mesh file; ..." or another reason why the file is no script; empty if it may be one.
std::string why_no_script(const std::string& name);

/// The files named on a command line, by what is done with them.
struct NamedFiles {
  std::string database;              ///< to be opened; empty if none was named
  std::vector<std::string> meshes;   ///< also missing files with such an ending, which have an error of their own
  std::vector<std::string> scripts;  ///< and everything else, which is refused when it is run
};

/// Errors: wrong_usage for two databases, or for mesh files beside other files.
algebra3d::Result<NamedFiles> sort_named_files(const std::vector<std::string>& names);

}  // namespace queries
