#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "queries/session/session.h"
#include "queries/test_runner/detail/expectation.h"
#include "queries/test_runner/detail/test_file.h"
#include "queries/test_runner/detail/variation.h"
#include "queries/test_runner/test_runner.h"

namespace queries {

/// A run of the steps of a test file: session, present section, and expectation. Everything that it refers to outlives
/// it. Used once.
class TestRun {
 public:
  /// `variation` may be null: then commands run as written.
  TestRun(TestFolders folders, const algebra3d::Registry& registry, const TestOptions& options,
          const Variation* variation);

  /// Errors: interrupted.
  Result<TestOutcome> run(const std::vector<TestStep>& steps);

 private:
  enum class Section : std::uint8_t { start, setup, cases, broken, teardown };

  void print(const std::string& line) const { options_.print(line); }
  /// Prints a note, except in variations, which would repeat it.
  void note(int line, const std::string& text) const;
  void fail(int line, const std::string& why);
  /// Reports a failure, unless the case is left out.
  void misuse(const Directive& directive, const std::string& why);

  void obey(const Directive& directive);
  void begin_setup(const Directive& directive);
  void begin_case(const Directive& directive);
  void set_tolerance(const Directive& directive);
  void set_variations(const Directive& directive);
  void set_expectation(const std::string& text);
  Expectation expectation_from_file(const std::string& name) const;
  Expectation expectation_from_object(const std::string& name);

  Result<NestedList> execute(const CommandText& command);
  void run_command(const CommandText& command);
  void check(const CommandText& command);
  void check_equal(const CommandText& command);
  NestedList comparable(NestedList list) const;
  void conclude(const CommandText& command, const Result<NestedList>& result, const Verdict& verdict);
  /// Whether the commands of this case are judged; they always run, since later cases may need their results.
  bool is_judged() const;

  TestFolders folders_;
  const TestOptions& options_;
  const Variation* variation_;
  Session session_;
  algebra3d::Diagnostics diagnostics_;
  Section section_ = Section::start;
  Expectation expectation_;
  Tolerance tolerance_;
  int case_number_ = 0;
  std::string case_name_;
  bool case_is_unjudged_ = false;
  bool case_is_left_out_ = false;
  std::set<VariationKind> file_variations_;  // variations that apply, unless a case says otherwise
  std::set<VariationKind> case_variations_;
  TestOutcome outcome_;
};

}  // namespace queries
