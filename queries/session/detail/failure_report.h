#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/operators/registry/failed_calls.h"
#include "base/context.h"
#include "queries/language/session_parameters.h"

namespace queries {

/// A statement that ended with the error internal. Refers to what its user owns.
struct FailedStatement {
  std::string_view text;
  const algebra3d::Error& error;
  const algebra3d::FailedCalls& calls;
  const SessionParameters& parameters;
  std::filesystem::path database;  ///< the file that is open; empty: none
  std::filesystem::path folder;    ///< where relative names of files start
};

/// A script that repeats the failure, with comments that say what failed. It calls the operator that failed with its
/// arguments as constants, exactly. Where there is no such operator, or its arguments are not known, it is the
/// statement, which needs the database. A constant that does not read back as the argument is named in a comment.
std::string failure_report(const FailedStatement& statement, const algebra3d::Context& context);

/// Writes the report to a new file in the first of the folders that takes it, and gives its absolute path. Nothing is
/// overwritten; a folder with a hundred reports takes no more.
/// Errors: io_error, with the reason of each folder.
algebra3d::Result<std::filesystem::path> write_failure_report(std::string_view report,
                                                              const std::vector<std::filesystem::path>& folders);

}  // namespace queries
