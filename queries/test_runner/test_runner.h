#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "algebra3d/registry/registry.h"

namespace queries {

struct TestOutcome {
  std::size_t passed = 0;
  std::size_t failed = 0;
  std::vector<std::string> failures;  ///< `<caseNo>@<line>` of each failed check
  std::string skipped;                ///< the reason of `#stop`, if the file was left out
};

struct TestOptions {
  /// Takes the report line by line; nothing else is printed.
  std::function<void(const std::string&)> print;
  const std::atomic<bool>* cancel = nullptr;
};

/// Runs a file of regression tests (language.md 5; docs/language.md lists what is ours). Databases lie in a scratch
/// folder that is removed afterwards; relative names of files are taken from the test file's folder; `$(SCRATCH)` in a
/// command stands for the scratch folder. A failed check prints command, expected and found.
/// Errors: file_missing if the test file cannot be read, interrupted.
algebra3d::Result<TestOutcome> run_test_file(const std::filesystem::path& file, const algebra3d::Registry& registry,
                                             const TestOptions& options);

}  // namespace queries
