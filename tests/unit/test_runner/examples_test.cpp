#include <gtest/gtest.h>

#include "queries/test_runner/detail/test_file.h"
#include "unit/test_runner/sample_run.h"

namespace queries {
namespace {

SampleRun run_examples(const std::string& content) {
  return run_sample(content, {}, test_registry(), "sample.examples");
}

/// One block of an examples file.
std::string block(const std::string& example, const std::string& result, const std::string& more = "") {
  return "Operator : + alias plus\nNumber : 2\nSignature: int x int -> int\nExample : " + example +
         "\nResult : " + result + "\n" + more;
}

std::string verdict_of(const std::string& example, const std::string& result, const std::string& more = "") {
  const SampleRun run = run_examples(block(example, result, more));
  EXPECT_EQ(run.error, "");
  return fmt::format("{}/{}", run.outcome.passed, run.outcome.failed);
}

TEST(Examples, an_atom_is_compared_with_its_type_and_a_number_by_its_value) {
  EXPECT_EQ(verdict_of("query 1 + 2", "3"), "1/0");
  EXPECT_EQ(verdict_of("query 1 + 2.0", "3.0"), "1/0");
  EXPECT_EQ(verdict_of("query 1 + 2.0", "3"), "1/0");
  EXPECT_EQ(verdict_of("query 1 + 2", "3.0"), "1/0");
  EXPECT_EQ(verdict_of("query 1 + 2", "4.0"), "0/1");
  EXPECT_EQ(verdict_of("query 1 = 1", "1"), "0/1");
  EXPECT_EQ(verdict_of("query \"3\"", "3"), "0/1");
  EXPECT_EQ(verdict_of("query \"a\" + \"b\";", "\"ab\""), "1/0");
  EXPECT_EQ(verdict_of("query 'a' + 'b'", "'ab'"), "1/0");
  EXPECT_EQ(verdict_of("query 1 = 1", "TRUE"), "1/0");
}

TEST(Examples, a_list_is_type_and_value) {
  EXPECT_EQ(verdict_of("query makePoint3D(1, 2, 3)", "(point3d (1.0 2.0 3.0))"), "1/0");
  EXPECT_EQ(verdict_of("query 1 / 0", "(real undefined)"), "1/0");
  EXPECT_EQ(verdict_of("query [const points3d value ((1 2 3))]", "(points3d\n ((1.0 2.0 3.0)))"), "1/0");
}

TEST(Examples, a_file_holds_the_result) {
  EXPECT_EQ(verdict_of("query 1 + 2", "file"), "1/0");
  EXPECT_EQ(verdict_of("query 1 + 3", "file"), "0/1");
}

TEST(Examples, a_bug_is_run_and_not_judged) {
  EXPECT_EQ(verdict_of("query 1 + 2", "bug"), "0/0");
  EXPECT_EQ(verdict_of("query x", "bug"), "0/0");
}

TEST(Examples, an_unpredictable_result_needs_no_value_but_a_remark) {
  EXPECT_EQ(verdict_of("query 1 + 2", "unpredictable", "Remark : it depends\n"), "1/0");
  EXPECT_EQ(verdict_of("query x", "unpredictable", "Remark : it depends\n"), "0/1");
  EXPECT_NE(run_examples(block("query 1", "unpredictable")).error.find("needs a Remark"), std::string::npos);
}

TEST(Examples, what_crashes_is_not_run) {
  const SampleRun run = run_examples(block("query x", "crashes", "Remark : too deep\n"));
  EXPECT_EQ(run.outcome.passed + run.outcome.failed, 0U);
  EXPECT_NE(run.report.find("+ 2 is not run: it crashes. too deep"), std::string::npos) << run.report;
}

TEST(Examples, the_result_of_this_platform_is_taken) {
  EXPECT_EQ(verdict_of("query 1 + 2", "(platform (win32 4) (linux 3))"), "1/0");
  EXPECT_EQ(verdict_of("query 1 + 2", "(platform (linux (int 3)))"), "1/0");
  EXPECT_EQ(verdict_of("query 1 + 2", "(platform (linux file))"), "1/0");
  EXPECT_NE(run_examples(block("query 1", "(platform (win32 1))")).error.find("no result for the platform linux"),
            std::string::npos);
}

TEST(Examples, tolerance_is_relative_and_tiny_unless_given) {
  EXPECT_EQ(verdict_of("query 1.0000000000000002", "1.0"), "1/0");
  EXPECT_EQ(verdict_of("query 1.000000000000001", "1.0"), "0/1");
  EXPECT_EQ(verdict_of("query 1.1", "1.0", "Tolerance: 0.2\n"), "1/0");
  EXPECT_EQ(verdict_of("query 110.0", "100.0", "Tolerance: %11\n"), "1/0");
  EXPECT_EQ(verdict_of("query 112.0", "100.0", "Tolerance: %11\n"), "0/1");
}

TEST(Examples, a_tolerance_ends_with_its_block) {
  const SampleRun run = run_examples(block("query 1.1", "1.0", "Tolerance : 0.2\n") +
                                     "\nOperator:-\nNumber:1\nSignature: any\nExample:query 1.1\nResult:1.0\n");
  EXPECT_EQ(run.outcome.passed, 1U);
  EXPECT_EQ(run.outcome.failed, 1U);
}

TEST(Examples, the_database_is_there_and_open) {
  const SampleRun run = run_examples("Sequential: yes\nDatabase: scratch\nRestore : no\n\n" + block("let x = 1", "()") +
                                     "Operator : -\nNumber : 1\nSignature : any\nExample : query x - 1\nResult : 0\n");
  EXPECT_EQ(run.outcome.passed, 2U) << run.report << run.error;
}

TEST(Examples, a_database_is_restored_by_its_name) {
  const auto steps = read_example_steps("Database: towns\nRestore : YES\n" + block("query 1", "1"), "towns.examples");
  ASSERT_TRUE(steps.ok());
  EXPECT_EQ(std::get<CommandText>((*steps)[1]).text, "restore database towns from towns");
}

TEST(Examples, a_database_that_cannot_be_restored_fails_by_name) {
  const SampleRun run = run_examples("Database: towns\nRestore : YES\n" + block("query 1", "1"));
  EXPECT_EQ(run.outcome.failures, std::vector<std::string>{"0@1"});
  EXPECT_NE(run.report.find("command: restore database towns from towns"), std::string::npos) << run.report;
}

TEST(Examples, what_is_malformed_is_named_with_its_line) {
  const auto error_of = [](const std::string& content) { return run_examples(content).error; };
  EXPECT_NE(error_of("hello\n").find("sample.examples:1: expected `Database: NAME` or `Operator : NAME`"),
            std::string::npos);
  EXPECT_NE(error_of("Restore : maybe\n").find(":1: expected `Restore : YES` or `Restore : no`"), std::string::npos);
  EXPECT_NE(error_of("Number : 1\n").find(":1: 'Number' stands before the first Operator"), std::string::npos);
  EXPECT_NE(error_of("Operator : x\nNumber : 1\n").find(":1: operator x: 'Signature' is missing"), std::string::npos);
  EXPECT_NE(error_of(block("query 1", "1", "Number : 3\n")).find(":6: duplicate 'Number'"), std::string::npos);
  EXPECT_NE(error_of(block("query 1", "1") + block("query 2", "2")).find(":7: operator + has two examples"),
            std::string::npos);
  EXPECT_NE(error_of(block("query 1", "maybe")).find(":5: expected an atom, a list"), std::string::npos);
  EXPECT_NE(error_of(block("query 1", "(1")).find(":5: Result: "), std::string::npos);
  EXPECT_NE(error_of("Operator : a b\n").find("alias"), std::string::npos);
  EXPECT_NE(error_of("Operator : a\nNumber : one\nSignature : s\nExample : e\nResult : 1\n").find("expected a number"),
            std::string::npos);
}

}  // namespace
}  // namespace queries
