#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "queries/session/session.h"
#include "queries/test_runner/expectation.h"
#include "queries/test_runner/test_file.h"
#include "queries/test_runner/test_runner.h"
#include "queries/test_runner/variation.h"

namespace queries {

/// One run through the steps of a test file: a session, the section that has been reached, what is expected next.
/// Everything that it refers to outlives it. Used once.
class TestRun {
 public:
  /// `variation` may be null: then the questions are asked as they are written.
  TestRun(TestFolders folders, const algebra3d::Registry& registry, const TestOptions& options,
          const Variation* variation);

  /// Errors: interrupted.
  Result<TestOutcome> run(const std::vector<TestStep>& steps);

 private:
  enum class Section : std::uint8_t { start, setup, cases, broken, teardown };

  void print(const std::string& line) const { options_.print(line); }
  /// Prints what is of no use twice: not when the file is repeated.
  void note(int line, const std::string& text) const;
  void fail(int line, const std::string& why);
  /// A failure, unless the case is left out.
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
  /// Whether the commands of this case count; they are run anyway, since later cases may need what they make.
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
  std::set<VariationKind> file_variations_;  // those that hold, unless a case says otherwise
  std::set<VariationKind> case_variations_;
  TestOutcome outcome_;
};

}  // namespace queries
