#include "queries/test_runner/test_runner.h"

#include <gtest/gtest.h>

#include <fstream>

#include "unit/test_runner/sample_run.h"

namespace queries {
namespace {

SampleRun run(const std::string& content) {
  SampleRun result = run_sample(content);
  EXPECT_EQ(result.error, "");
  return result;
}

TEST(TestRunner, a_value_is_compared_with_its_type) {
  EXPECT_EQ(verdict("#testcase a\n#yields (int 3)\nquery 1 + 2;"), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields (int 4)\nquery 1 + 2;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#yields (real 3.0)\nquery 1 + 2;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#yields (int 3.0)\nquery 1 + 2;"), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields (int 3.5)\nquery 1 + 2;"), "0/1");
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

TEST(TestRunner, equality_is_asked_of_queries_only) {
  EXPECT_EQ(verdict("#testcase a\n#yields equal 4\nquery(4);"), "1/0");
  const SampleRun result = run("#setup s\n#testcase a\n#yields equal 4\nlist databases;");
  EXPECT_NE(result.report.find("#yields equal: expected a query"), std::string::npos) << result.report;
}

TEST(TestRunner, a_difference_of_sets_is_shown_in_sorted_order) {
  const SampleRun result =
      run("#setup s\n#testcase a\n#yields set ((rel (tuple ((Elem int)))) ((2) (9)))\n"
          "query intstream(1, 2) transformstream consume;");
  EXPECT_NE(result.report.find("at /2/1/1: expected 2, found 1"), std::string::npos) << result.report;
  EXPECT_NE(result.report.find("expected: ((rel (tuple ((Elem int)))) ((2) (9)))"), std::string::npos) << result.report;
}

TEST(TestRunner, tolerances_hold_until_they_are_changed) {
  EXPECT_EQ(verdict("#testcase a\n#yields (real 1.0)\nquery 1.1;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#tolerance_real 0.2\n#yields (real 1.0)\nquery 1.1;\n"
                    "#testcase b\n#yields (real 1.0)\nquery 1.1;\n"
                    "#testcase c\n#tolerance_real 0\n#yields (real 1.0)\nquery 1.1;"),
            "2/1");
}

TEST(TestRunner, what_is_wrong_in_a_case_that_is_left_out_does_not_count) {
  const std::string cases =
      "#testcase first\n#tolerance_real much\n#variation some\n#yields (int 1)\nquery 1;\n"
      "#testcase second\n#yields (int 1)\nquery 1;\n";
  TestOptions options;
  options.filter = "second";
  EXPECT_EQ(verdict(cases, options), "1/0");
  options.filter = "first";
  EXPECT_EQ(verdict(cases, options), "1/2");
}

TEST(TestRunner, a_literal_that_is_not_closed_ends_with_its_case) {
  const SampleRun result =
      run("#setup s\n#testcase open\n#yields (int 1)\nquery \"1;\n#testcase next\n#yields (int 1)\nquery 1;\n"
          "#testcase last\n#yields (int 1)\nquery (1;\n#teardown\nquery 1;");
  EXPECT_EQ(result.outcome.failures, (std::vector<std::string>{"1@4", "3@10"})) << result.report;
  EXPECT_EQ(result.outcome.passed, 1U);
}

TEST(TestRunner, a_tuple_number_beyond_ints_is_the_one_of_the_file) {
  EXPECT_EQ(verdict("#testcase a\n#yields (tid 3000000000)\nquery [const tid value 3000000000];"), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields (tid 3000000001)\nquery [const tid value 3000000000];"), "0/1");
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

TEST(TestRunner, an_error_without_a_text_takes_any) {
  EXPECT_EQ(verdict("#testcase a\n#yields error\nquery;\nquery 1 +;\nclose database;"), "3/0");
}

TEST(TestRunner, the_text_of_an_error_is_used_up) {
  EXPECT_EQ(verdict("#testcase a\n#yields error \"unknown name 'x'\"\nquery x;\nquery 1 +;"), "2/0");
}

TEST(TestRunner, a_let_between_testcase_and_yields_is_a_check_of_its_own) {
  EXPECT_EQ(verdict("create database d;\nopen database d;\n#testcase a\n#yields (int 1)\nquery 1;\n"
                    "#testcase b\nlet x = 1;\n#yields (int 1)\nquery x;"),
            "3/0");
  EXPECT_EQ(verdict("create database d;\nopen database d;\n#testcase a\n#yields error\nquery y;\n"
                    "#testcase b\nlet x = 1;\n#yields (int 1)\nquery x;"),
            "2/1");
}

TEST(TestRunner, words_that_only_begin_like_an_expectation_are_unknown) {
  for (const char* word : {"errors", "successful", "undefinedness", "sets (a b)", "5", ""}) {
    const SampleRun result = run(std::string("#setup s\n#testcase a\n#yields ") + word + "\nquery 1;");
    EXPECT_EQ(result.outcome.failed, 1U) << word;
    EXPECT_NE(result.report.find(std::string("unknown yields value: ") + word), std::string::npos) << result.report;
  }
}

TEST(TestRunner, expected_values_from_files_take_variables) {
  ASSERT_EQ(setenv("ALGEBRA3D_TEST_EXPECTED", "expected", 1), 0);  // NOLINT(concurrency-mt-unsafe)
  EXPECT_EQ(verdict("#testcase a\n#yields @$(ALGEBRA3D_TEST_EXPECTED).txt\nquery 3;"), "1/0");
  EXPECT_EQ(verdict("#testcase a\n#yields @$(ALGEBRA3D_TEST_NO_SUCH).txt\nquery 3;"), "0/1");
  EXPECT_EQ(verdict("#testcase a\n#yields @$(unclosed.txt\nquery 3;"), "0/1");
}

TEST(TestRunner, a_tolerance_that_is_no_number_fails) {
  EXPECT_EQ(verdict("#testcase a\n#tolerance_real much\n#yields (int 1)\nquery 1;"), "1/1");
}

TEST(TestRunner, directives_of_a_case_mean_nothing_before_it) {
  const SampleRun result =
      run("#setup s\n#tolerance_real 5\n#yields (int 1)\n#testcase a\n#yields (real 1.0)\nquery 2.0;");
  EXPECT_EQ(result.outcome.failed, 1U);
  EXPECT_NE(result.report.find("line 2: #tolerance_real before a test case"), std::string::npos) << result.report;
}

TEST(TestRunner, blanks_may_stand_after_the_number_sign) {
  EXPECT_EQ(verdict("#  testcase a\n# yields (int 1)\nquery 1;"), "1/0");
}

TEST(TestRunner, the_mark_of_utf8_and_line_ends_of_windows_do_not_matter) {
  const SampleRun result = run("\xEF\xBB\xBF#setup s\r\n#testcase a\r\n#yields (int\\\r\n 1)\r\nquery 1;\r\n");
  EXPECT_EQ(result.outcome.passed, 1U) << result.report;
  EXPECT_EQ(result.outcome.failed, 0U) << result.report;
}

TEST(TestRunner, a_second_setup_fails) {
  EXPECT_EQ(run("#setup s\n#testcase a\n#yields (int 1)\nquery 1;\n#setup t\n").outcome.failed, 1U);
}

TEST(TestRunner, the_failure_of_a_setup_says_which_command) {
  const SampleRun result = run("#setup s\nlet a = 1;\n#testcase a\nquery 1;\n#teardown\nquery z;");
  EXPECT_EQ(result.outcome.failures, std::vector<std::string>{"0@2"});
  EXPECT_NE(result.report.find("the setup failed: no database is open"), std::string::npos) << result.report;
  EXPECT_NE(result.report.find("command: let a = 1"), std::string::npos) << result.report;
  EXPECT_NE(result.report.find("unknown name 'z'"), std::string::npos) << result.report;
}

TEST(TestRunner, a_file_that_needs_an_unknown_algebra_is_left_out) {
  const SampleRun result = run("#setup s Standard-C++ NoSuchAlgebra\n#testcase a\nquery x;");
  EXPECT_EQ(result.outcome.skipped, "there is no algebra 'NoSuchAlgebra'");
  EXPECT_EQ(result.outcome.failed, 0U);
}

TEST(TestRunner, algebras_may_be_written_with_and_without_their_endings) {
  EXPECT_EQ(run("#setup s Spatial3D ExtRelation-C++ RTreeAlgebra FTextAlgebra\n#testcase a\n#yields (int 1)\nquery 1;")
                .outcome.passed,
            1U);
}

TEST(TestRunner, description_and_coverage_change_nothing) {
  const SampleRun result =
      run("#setup s\n#description what it is about\n#testcase a\n#yields (int 1)\n"
          "#coverage Spatial3D\nquery 1;");
  EXPECT_EQ(result.outcome.passed, 1U);
  EXPECT_NE(result.report.find("what it is about"), std::string::npos);
}

TEST(TestRunner, a_failure_shows_command_expected_and_found) {
  const SampleRun result =
      run("#setup s\n#testcase a\n#yields error \"one\"\nquery two;\n"
          "#testcase b\n#yields equal 2 + 2\nquery 5;\n#testcase c\n#yields success\nquery x;");
  EXPECT_EQ(result.outcome.failed, 3U);
  for (const char* part :
       {"FAILED 1@4 a: expected an error that contains \"one\"", "command: query two",
        "found: error: unknown name 'two'", "FAILED 2@7 b: expected an equal value, but at /2: expected 4, found 5",
        "expected: the value of 2 + 2", "found: (int 5)", "expected: no error"})
    EXPECT_NE(result.report.find(part), std::string::npos) << part << "\n" << result.report;
}

TEST(TestRunner, of_a_long_result_the_neighbourhood_is_shown) {
  std::string expected = "((rel (tuple ((Elem int)))) (";
  for (int i = 1; i <= 500; ++i) expected += fmt::format("({}) ", i == 300 ? 7 : i);
  const SampleRun result =
      run("#setup s\n#testcase a\n#yields " + expected + "))\nquery intstream(1, 500) transformstream consume;");
  EXPECT_NE(result.report.find("at /2/300/1: expected 7, found 300"), std::string::npos) << result.report;
  EXPECT_NE(result.report.find("found: at /2/300: (300)"), std::string::npos) << result.report;
  EXPECT_LT(result.report.size(), 1000U);
}

TEST(TestRunner, a_filter_judges_some_cases_and_runs_all) {
  const std::string cases =
      "create database d;\nopen database d;\n#testcase make_x\nlet x = 5;\n"
      "#testcase use_x\n#yields (int 5)\nquery x;\n#testcase wrong\n#yields (int 6)\nquery x;";
  EXPECT_EQ(verdict(cases, {.filter = "use"}), "1/0");
  EXPECT_EQ(verdict(cases, {.filter = "*_x"}), "2/0");
  EXPECT_EQ(verdict(cases, {.filter = "wr?ng"}), "0/1");
  EXPECT_EQ(verdict(cases, {.filter = "nothing"}), "0/0");
}

TEST(TestRunner, the_scratch_folder_may_be_kept) {
  const SampleRun result = run_sample("#setup s\ncreate database kept;\n", {.keeps_scratch = true});
  const std::size_t begin = result.report.find("kept: ");
  ASSERT_NE(begin, std::string::npos) << result.report;
  const std::filesystem::path folder = result.report.substr(begin + 6, result.report.find('\n', begin) - begin - 6);
  EXPECT_TRUE(std::filesystem::exists(folder / "kept.db")) << folder;
  std::filesystem::remove_all(folder);
}

TEST(TestRunner, several_files_at_once_are_reported_in_their_order) {
  const TestFolder folder;
  std::vector<std::string> files;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    files.push_back((folder.path() / (std::string(name) + ".test")).string());
    std::ofstream(files.back()) << "#setup s\n#description about " << name
                                << "\n#testcase a\n#yields (int 1)\nquery 1;\nquery 2;\n";
  }
  files.push_back("/no/such.test");
  const auto report_of = [&](std::size_t jobs) {
    std::string report;
    const auto summary = run_test_files(files, jobs, test_registry(),
                                        {.print = [&](const std::string& line) { report += line + "\n"; }});
    EXPECT_EQ(summary.passed, 5U);
    EXPECT_EQ(summary.failed, 6U);
    return report;
  };
  const std::string report = report_of(1);
  EXPECT_EQ(report, report_of(3));
  EXPECT_LT(report.find("about a"), report.find("about e"));
  EXPECT_NE(report.find("failed 1@6\n"), std::string::npos) << report;
  EXPECT_NE(report.find("error: cannot read '/no/such.test'"), std::string::npos) << report;
  EXPECT_TRUE(report.ends_with("5 passed, 6 failed\n")) << report;
}

TEST(TestRunner, an_interrupted_run_says_so) {
  const TestFolder folder;
  const auto file = folder.path() / "sample.test";
  std::ofstream(file) << "#setup s\n#testcase a\n#yields (int 1)\nquery 1;\n";
  const std::atomic<bool> cancel = true;
  const auto summary = run_test_files({file.string()}, 1, test_registry(), {[](const std::string&) {}, &cancel});
  EXPECT_TRUE(summary.is_interrupted);
}

}  // namespace
}  // namespace queries
