#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "queries/test_runner/test_runner.h"
#include "unit/session/example_session.h"

namespace queries {

struct SampleRun {
  TestOutcome outcome;
  std::string report;
  std::string error;  ///< why the file could not be run
};

/// Runs a file with this name and content. Beside it lies `expected.txt` with `(int 3)`.
inline SampleRun run_sample(const std::string& content, TestOptions options = {},
                            const algebra3d::Registry& registry = test_registry(),
                            const std::string& name = "sample.test") {
  const TestFolder folder;
  std::ofstream(folder.path() / name) << content;
  std::ofstream(folder.path() / "expected.txt") << "(int 3)\n";
  std::ofstream(folder.path() / "plus_2.result") << "(int 3)\n";
  SampleRun result;
  options.print = [&](const std::string& line) { result.report += line + "\n"; };
  auto outcome = run_test_file(folder.path() / name, registry, options);
  if (outcome)
    result.outcome = std::move(outcome).value();
  else
    result.error = outcome.error().text();
  return result;
}

/// `PASSED/FAILED` of the cases below `#setup`.
inline std::string verdict(const std::string& cases, const TestOptions& options = {}) {
  const SampleRun result = run_sample("#setup sample\n" + cases, options);
  EXPECT_EQ(result.error, "");
  return fmt::format("{}/{}", result.outcome.passed, result.outcome.failed);
}

}  // namespace queries
