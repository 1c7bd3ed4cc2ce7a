#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "algebra3d/registry/registry.h"

namespace queries {

/// How the checks of a file went when they were repeated in one way.
struct VariedChecks {
  std::string name;  ///< offset, axes or operands
  std::size_t passed = 0;
  std::size_t failed = 0;
  std::size_t left_out = 0;  ///< `#variation` excludes them
};

struct TestOutcome {
  std::size_t passed = 0;  ///< checks; those of variations included
  std::size_t failed = 0;
  std::size_t left_out = 0;           ///< checks that this variation does not hold for
  std::vector<std::string> failures;  ///< `<caseNo>@<line>` of each failed check
  std::string skipped;                ///< why the file was left out: `#stop`, or an algebra that is not there
  std::vector<VariedChecks> varied;   ///< one per variation
};

struct TestOptions {
  /// Takes the report line by line; nothing else is printed.
  std::function<void(const std::string&)> print = {};
  const std::atomic<bool>* cancel = nullptr;
  /// Only test cases whose name contains this are judged; `*` and `?` stand for any characters and any character. The
  /// commands of the others are run as well, because later ones may need what they make.
  std::string filter = {};
  bool keeps_scratch = false;  ///< the scratch folder stays, and the report says where
  bool varies = false;         ///< every case is repeated in several ways (docs/language.md, "Test files")
};

/// Runs a file of regression tests (language.md 5; docs/language.md lists what is ours); one that ends in `.examples`
/// is read in the format of 5.5. Databases lie in a scratch folder that is removed afterwards; relative names of files
/// are taken from the test file's folder; `$(SCRATCH)` in a command stands for the scratch folder. A failed check
/// prints command, expected and found. Several calls may run in parallel.
/// Errors: file_missing if the test file cannot be read, file_format for examples that are none, interrupted, io_error.
algebra3d::Result<TestOutcome> run_test_file(const std::filesystem::path& file, const algebra3d::Registry& registry,
                                             const TestOptions& options);

struct TestSummary {
  std::size_t passed = 0;
  std::size_t failed = 0;  ///< a file that cannot be run counts as one
  bool is_interrupted = false;
};

/// Runs files, `jobs` of them at a time (1 or more), and prints their reports in the order of the files; the last line
/// is `N passed, N failed`.
TestSummary run_test_files(const std::vector<std::string>& files, std::size_t jobs, const algebra3d::Registry& registry,
                           const TestOptions& options);

}  // namespace queries
