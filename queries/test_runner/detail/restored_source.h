#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "queries/test_runner/detail/motion.h"
#include "queries/test_runner/detail/test_folders.h"

namespace queries {

/// The parts of the command `restore [database] NAME from FILE`.
struct RestoredSource {
  std::string command;  ///< `restore database NAME from`
  std::string file;     ///< as written, without quotes
};

/// Parses the command; nothing for any other command.
std::optional<RestoredSource> restored_source(std::string_view command);

/// The command with a copy of the file in which all constants are moved. A file in the scratch folder, which was saved
/// moved by this run, and a file that is not a nested list are not copied. Errors: io_error if the copy cannot be
/// written.
algebra3d::Result<std::string> with_moved_source(const RestoredSource& source, const Motion& motion,
                                                 const TestFolders& folders);

}  // namespace queries
