#include "queries/test_runner/test_runner.h"

#include <gtest/gtest.h>

#include <fstream>

#include "unit/session/example_session.h"

namespace queries {
namespace {

struct SampleRun {
  TestOutcome outcome;
  std::string report;
};

/// Runs a test file with this content.
SampleRun run(const std::string& content) {
  const TestFolder folder;
  const auto file = folder.path() / "sample.test";
  std::ofstream(file) << content;
  std::ofstream(folder.path() / "expected.txt") << "(int 3)\n";
  SampleRun result;
  auto outcome = run_test_file(file, test_registry(), {[&](const std::string& line) { result.report += line + "\n"; }});
  EXPECT_TRUE(outcome.ok());
  if (outcome) result.outcome = std::move(outcome).value();
  return result;
}

/// `PASSED/FAILED` of the cases below `#setup`.
std::string verdict(const std::string& cases) {
  const SampleRun result = run("#setup sample\n" + cases);
  return fmt::format("{}/{}", result.outcome.passed, result.outcome.failed);
}

TEST(TestRunner, a_value_is_compared_with_its_type) {
  EXPECT_EQ(verdict("#testcase a\n#yields (int 3)\nquery 1 + 2;"), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields (int 4)\nquery 1 + 2;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#yields (real 3.0)\nquery 1 + 2;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#yields (int 3.0)\nquery 1 + 2;"), "0/1");
}

TEST(TestRunner, a_value_is_used_up_by_a_command) {
  EXPECT_EQ(verdict("#testcase a\n#yields (int 3)\nquery 3;\nquery 3;"), "1/1");
}

TEST(TestRunner, without_a_value_the_empty_list_is_expected) {
  EXPECT_EQ(verdict("#testcase a\ncreate database d;\nopen database d;\nlet x = 1;"), "3/0");
  EXPECT_EQ(verdict("#testcase a\nquery 1;"), "0/1");
}

TEST(TestRunner, success_and_error_persist) {
  EXPECT_EQ(verdict("#testcase a\n#yields success\nquery 1;\nquery 2;\n#testcase b\nquery 3;"), "3/0");
  EXPECT_EQ(verdict("#testcase a\n#yields error\nquery x;\nquery y;\n#testcase b\nquery z;"), "3/0");
  EXPECT_EQ(verdict("#testcase a\n#yields error\nquery 1;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#yields success\nquery x;"), "0/1");
}

TEST(TestRunner, an_error_text_must_be_contained) {
  EXPECT_EQ(verdict("#testcase a\n#yields error \"unknown name 'x'\"\nquery x;"), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields error \"unknown name 'y'\"\nquery x;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#yields error unquoted words\nquery x;"), "0/1");
}

TEST(TestRunner, an_undefined_value_needs_its_reason) {
  EXPECT_EQ(verdict("#testcase a\n#yields undefined \"division by zero\"\nquery 1 / 0;"), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields undefined \"division by one\"\nquery 1 / 0;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#yields undefined \"\"\nquery 1 / 2;"), "0/1");
}

TEST(TestRunner, expected_value_from_a_file_and_from_an_object) {
  EXPECT_EQ(verdict("#testcase a\n#yields @expected.txt\nquery 3;"), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields @missing.txt\nquery 3;"), "0/1");
  const std::string setup = "create database d;\nopen database d;\nlet three = 3;\n";
  EXPECT_EQ(verdict(setup + "#testcase a\n#yields *three\nquery 1 + 2;"), "1/0");
  EXPECT_EQ(verdict(setup + "#testcase a\n#yields *four\nquery 1 + 2;"), "0/1");
}

TEST(TestRunner, relations_are_compared_in_order_or_as_sets) {
  const std::string two = "query intstream(1, 2) transformstream consume;";
  const std::string type = "((rel (tuple ((Elem int)))) ";
  EXPECT_EQ(verdict("#testcase a\n#yields " + type + "((1) (2)))\n" + two), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields " + type + "((2) (1)))\n" + two), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#yields set " + type + "((2) (1)))\n" + two), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields set " + type + "((2) (2)))\n" + two), "0/1");
}

TEST(TestRunner, values_are_compared_by_the_equality_of_their_type) {
  EXPECT_EQ(verdict("#testcase a\n#yields equal 2 + 1\nquery 3.0;"), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields equal 4\nquery 3;"), "0/1");
}

TEST(TestRunner, tolerances_hold_until_they_are_changed) {
  EXPECT_EQ(verdict("#testcase a\n#yields (real 1.0)\nquery 1.1;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#tolerance_real 0.2\n#yields (real 1.0)\nquery 1.1;\n"
                    "#testcase b\n#yields (real 1.0)\nquery 1.1;\n"
                    "#testcase c\n#tolerance_real 0\n#yields (real 1.0)\nquery 1.1;"),
            "2/1");
}

TEST(TestRunner, relative_tolerances_are_in_percent) {
  EXPECT_EQ(verdict("#testcase a\n#tolerance_real %1\n#yields (real 100.0)\nquery 100.9;"), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#tolerance_real %1\n#yields (real 100.0)\nquery 101.1;"), "0/1");
}

TEST(TestRunner, tolerances_are_for_reals_only) {
  EXPECT_EQ(verdict("#testcase a\n#tolerance_real 5\n#yields (int 3)\nquery 4;"), "0/1");
}

TEST(TestRunner, an_unknown_expectation_fails) {
  EXPECT_EQ(verdict("#testcase a\n#yields something\nquery 1;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#yields (int\nquery 1;"), "0/1");
}

TEST(TestRunner, directives_may_be_continued) {
  EXPECT_EQ(verdict("#testcase a\n#yields (int\\\n  3)\nquery 3;"), "1/0");
}

TEST(TestRunner, other_lines_with_a_number_sign_are_comments) {
  EXPECT_EQ(verdict("# a remark\n#testcase a\n#yields (int 3)\n#\n# another: yields\nquery 1\n# in between\n + 2;"),
            "1/0");
}

TEST(TestRunner, errors_before_the_setup_and_in_the_teardown_do_not_count) {
  const SampleRun result =
      run("delete database d;\n#setup s\n#testcase a\n#yields (int 1)\nquery 1;\n#teardown\nquery x;");
  EXPECT_EQ(result.outcome.passed, 1U);
  EXPECT_EQ(result.outcome.failed, 0U);
  EXPECT_NE(result.report.find("line 7: unknown name 'x'"), std::string::npos) << result.report;
}

TEST(TestRunner, an_error_in_the_setup_skips_to_the_teardown) {
  EXPECT_EQ(verdict("query x;\n#testcase a\n#yields (int 1)\nquery 1;"), "0/1");
}

TEST(TestRunner, a_file_without_a_setup_fails) {
  EXPECT_EQ(run("query 1;").outcome.failed, 1U);
}

TEST(TestRunner, stop_before_the_setup_leaves_the_file_out) {
  const SampleRun result = run("#stop not today\n#setup s\n#testcase a\nquery x;");
  EXPECT_EQ(result.outcome.skipped, "not today");
  EXPECT_EQ(result.outcome.failed, 0U);
}

TEST(TestRunner, a_failure_shows_case_line_name_command_and_difference) {
  const SampleRun result =
      run("#setup s\n#testcase first\n#yields (int 1)\nquery 1;\n#testcase sum_holds\n#yields (int 4)\n"
          "query 1\n + 2;\n#testcase reason_shown\n#yields (real 0.0)\nquery 1 / 0;");
  ASSERT_EQ(result.outcome.failures.size(), 2U);
  EXPECT_EQ(result.outcome.failures[0], "2@7");
  EXPECT_EQ(result.outcome.failures[1], "3@11");
  for (const char* part :
       {"FAILED 2@7 sum_holds: at /2: expected 4, found 3", "command: query 1\n + 2", "note: /: division by zero"})
    EXPECT_NE(result.report.find(part), std::string::npos) << part << "\n" << result.report;
}

TEST(TestRunner, scratch_folder_is_there_and_goes) {
  EXPECT_EQ(verdict("#testcase a\n#yields (int 0)\nquery getDirectory('$(SCRATCH)') count;"), "1/0");
}

TEST(TestRunner, a_missing_file_is_an_error) {
  const auto outcome = run_test_file("/no/such.test", test_registry(), {[](const std::string&) {}});
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, algebra3d::ErrorCode::file_missing);
}

}  // namespace
}  // namespace queries
