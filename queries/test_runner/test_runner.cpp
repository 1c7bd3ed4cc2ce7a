#include "queries/test_runner/test_runner.h"

#include <algorithm>
#include <future>
#include <iterator>
#include <memory>
#include <thread>

#include "base/file_content.h"
#include "base/propagate.h"
#include "base/temporary_folder.h"
#include "base/without_exceptions.h"
#include "queries/test_runner/detail/test_file.h"
#include "queries/test_runner/detail/test_run.h"
#include "queries/test_runner/detail/text_of_file.h"

namespace queries {
namespace {

using algebra3d::Registry;
namespace fs = std::filesystem;

Result<std::vector<TestStep>> read_steps(const fs::path& file, const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const std::string content, read_text(file, cancel));
  if (file.extension() == ".examples") return read_example_steps(content, file.string());
  return read_test_steps(content, file.string());
}

/// One test file, and how it is to be run.
struct PlannedRun {
  const fs::path& file;
  const std::vector<TestStep>& steps;
  const Registry& registry;
  const TestOptions& options;
};

Result<TestOutcome> run_once(const PlannedRun& plan, const Variation* variation) {
  A3D_ASSIGN(algebra3d::TemporaryFolder scratch, algebra3d::TemporaryFolder::make());
  if (plan.options.keeps_scratch) {
    scratch.keep();
    plan.options.print("  kept: " + scratch.path().string());
  }
  const TestFolders folders{fs::absolute(plan.file).parent_path(), scratch.path()};
  return TestRun(folders, plan.registry, plan.options, variation).run(plan.steps);
}

Status add_variation(const PlannedRun& plan, VariationKind kind, TestOutcome& outcome) {
  const Variation variation(kind, plan.registry);
  A3D_ASSIGN(TestOutcome varied, run_once(plan, &variation));
  outcome.varied.push_back({std::string(name_of(kind)), varied.passed, varied.failed, varied.left_out});
  outcome.passed += varied.passed;
  outcome.failed += varied.failed;
  std::ranges::move(varied.failures, std::back_inserter(outcome.failures));
  return {};
}

/// The report of one file, as far as it goes: its lines and its counts.
struct Report {
  std::vector<std::string> lines;
  TestSummary summary;
  std::vector<VariedChecks> varied;
};

Report run_and_report(const std::string& file, const Registry& registry, TestOptions options, bool prints_at_once) {
  Report report;
  const auto print = options.print;
  options.print = [&](const std::string& line) {
    if (prints_at_once)
      print(line);
    else
      report.lines.push_back(line);
  };
  options.print("== " + file);
  auto outcome = algebra3d::without_exceptions([&] { return run_test_file(file, registry, options); });
  if (!outcome) {
    options.print("error: " + outcome.error().text());
    report.summary.failed = 1;
    report.summary.is_interrupted = outcome.error().code == ErrorCode::interrupted;
    return report;
  }
  if (!outcome->skipped.empty()) options.print("left out: " + outcome->skipped);
  for (const std::string& failure : outcome->failures) options.print("failed " + failure);
  report.summary = {outcome->passed, outcome->failed, false};
  report.varied = std::move(outcome->varied);
  return report;
}

void add_up(std::vector<VariedChecks>& total, const std::vector<VariedChecks>& more) {
  for (const VariedChecks& checks : more) {
    auto found = std::ranges::find(total, checks.name, &VariedChecks::name);
    if (found == total.end()) found = total.insert(total.end(), {checks.name});
    found->passed += checks.passed;
    found->failed += checks.failed;
    found->left_out += checks.left_out;
  }
}

}  // namespace

Result<TestOutcome> run_test_file(const fs::path& file, const Registry& registry, const TestOptions& options) {
  A3D_ASSIGN(const std::vector<TestStep> steps, read_steps(file, options.cancel));
  const PlannedRun plan{file, steps, registry, options};
  A3D_ASSIGN(TestOutcome outcome, run_once(plan, nullptr));
  if (!options.varies || !outcome.skipped.empty()) return outcome;
  for (const VariationKind kind : kVariationKinds) A3D_TRY(add_variation(plan, kind, outcome));
  return outcome;
}

TestSummary run_test_files(const std::vector<std::string>& files, std::size_t jobs, const Registry& registry,
                           const TestOptions& options) {
  const bool prints_at_once = jobs <= 1;
  std::vector<std::promise<Report>> reports(files.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < files.size(); i = next++)
      reports[i].set_value(run_and_report(files[i], registry, options, prints_at_once));
  };
  std::vector<std::jthread> workers;
  for (std::size_t i = 0; i < std::min(jobs, files.size()); ++i) workers.emplace_back(work);
  TestSummary summary;
  std::vector<VariedChecks> varied;
  for (std::promise<Report>& promise : reports) {
    const Report report = promise.get_future().get();
    for (const std::string& line : report.lines) options.print(line);
    summary.passed += report.summary.passed;
    summary.failed += report.summary.failed;
    summary.is_interrupted = summary.is_interrupted || report.summary.is_interrupted;
    add_up(varied, report.varied);
  }
  for (const VariedChecks& checks : varied)
    options.print(fmt::format("varied by {}: {} passed, {} failed, {} left out", checks.name, checks.passed,
                              checks.failed, checks.left_out));
  options.print(fmt::format("{} passed, {} failed", summary.passed, summary.failed));
  return summary;
}

}  // namespace queries
