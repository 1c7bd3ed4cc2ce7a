#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "queries/test_runner/motion.h"
#include "queries/test_runner/test_folders.h"

namespace queries {

/// The command `restore [database] NAME from FILE`, taken apart.
struct RestoredSource {
  std::string command;  ///< `restore database NAME from`
  std::string file;     ///< as it was written, without quotes
};

/// Nothing for any other command.
std::optional<RestoredSource> restored_source(std::string_view command);

/// The command, reading a copy of the file in which all constants are moved. It reads the file itself if that lies in
/// the scratch folder, and so was saved by this run and is moved already, or if it cannot be read as a nested list.
/// Errors: io_error if the copy cannot be written.
algebra3d::Result<std::string> with_moved_source(const RestoredSource& source, const Motion& motion,
                                                 const TestFolders& folders);

}  // namespace queries
