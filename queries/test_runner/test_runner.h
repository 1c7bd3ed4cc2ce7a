#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"

namespace queries {

/// The results of the checks of a file in one variation.
struct VariedChecks {
  std::string name;  ///< offset, axes or operands
  std::size_t passed = 0;
  std::size_t failed = 0;
  std::size_t left_out = 0;  ///< `#variation` excludes them
};

struct TestOutcome {
  std::size_t passed = 0;  ///< number of checks, with those of variations
  std::size_t failed = 0;
  std::size_t left_out = 0;           ///< checks to which this variation does not apply
  std::vector<std::string> failures;  ///< `<caseNo>@<line>` of each failed check
  std::string skipped;                ///< why the file was skipped: `#stop`, or a missing algebra
  std::vector<VariedChecks> varied;   ///< one per variation
};

struct TestOptions {
  /// Receives the report line by line.
  std::function<void(const std::string&)> print = {};
  const std::atomic<bool>* cancel = nullptr;
  /// Only test cases whose name contains this are judged; `*` and `?` are wildcards. The other commands run as well,
  /// since later ones may need their results.
  std::string filter = {};
  bool keeps_scratch = false;  ///< keep the scratch folder; the report names it
  bool varies = false;         ///< repeat every case in variations (docs/language.md, "Test files")
};

/// Runs a file of regression tests (docs/language.md, "Test files"); a name that ends with `.examples` means a file of
/// examples. Databases are in a scratch folder that is deleted afterwards; relative file names start at the test file's
/// folder; `$(SCRATCH)` in a command is the scratch folder. A failed check prints command, expectation and result.
/// Concurrent calls are safe. Errors: file_missing if the test file cannot be read, file_format for malformed examples,
/// interrupted, io_error.
algebra3d::Result<TestOutcome> run_test_file(const std::filesystem::path& file, const algebra3d::Registry& registry,
                                             const TestOptions& options);

struct TestSummary {
  std::size_t passed = 0;
  std::size_t failed = 0;  ///< a file that cannot be run counts as one failure
  bool is_interrupted = false;
};

/// Runs files, `jobs` of them at a time (1 or more), and prints their reports in the order of the files; the last line
/// is `N passed, N failed`.
TestSummary run_test_files(const std::vector<std::string>& files, std::size_t jobs, const algebra3d::Registry& registry,
                           const TestOptions& options);

}  // namespace queries
