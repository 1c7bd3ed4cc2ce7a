// A statement that ends with the error internal leaves a script that repeats the failure.
#include <fstream>
#include <sstream>

#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "queries/language/command_reader.h"
#include "unit/session/example_session.h"

namespace queries {
namespace {

using algebra3d::Overload;
using algebra3d::Registry;
using algebra3d::Volume3d;

Error broken(const std::string& where) {
  return {ErrorCode::internal, "broken here: {}", where};
}

// The operators of these tests. Those of values are broken for 7 alone, so that a report must hold the value.

Result<std::int64_t> broken_scalar(std::int64_t value) {
  if (value == 7) return broken("a scalar");
  return value;
}
Result<double> broken_of_two(double value, const std::string& text) {
  if (value == 1.0 / 3 && text == "a\n\"b\"") return broken("two arguments");
  return value;
}
Result<bool> broken_solid(const Volume3d& a, const Volume3d& b) {
  if (a.mesh().face_count() != 12 || b.mesh().face_count() != 12) return true;
  return broken("solids of 12 triangles");
}
Result<bool> broken_text(const std::string&) {
  return broken("a string");
}
std::int64_t throwing(std::int64_t value) {
  if (value == 7) throw std::out_of_range("no such place");
  return value;
}
Result<std::vector<std::int64_t>> broken_table(std::int64_t value) {
  if (value == 7) return broken("a table");
  return std::vector{value};
}
algebra3d::Elements<std::int64_t> broken_row(std::int64_t last) {
  using Cell = std::optional<std::tuple<std::int64_t>>;
  return algebra3d::Elements<std::int64_t>([last, next = std::int64_t{0}](Context&) mutable -> Result<Cell> {
    if (++next > last) return Cell();
    if (next == 7) return broken("row 7");
    return Cell(next);
  });
}

/// Ends with the error internal for a sum of 7.
class BrokenSum {
 public:
  void step(const std::int64_t& value) { sum_ += value; }
  void combine(BrokenSum&& later) { sum_ += later.sum_; }
  Result<std::int64_t> finish() const {
    if (sum_ == 7) return broken("an aggregate");
    return sum_;
  }

 private:
  std::int64_t sum_ = 0;
};

const Registry& broken_registry() {
  static Registry& registry = *[] {
    auto* made = new Registry(algebra3d::make_registry());
    register_stream_operators(*made);
    const auto add = [&](const std::string& name, const std::string& places, Overload overload) {
      made->add({.name = name, .syntax = name + "(" + places + ")", .overloads = {std::move(overload)}});
    };
    add("brokenScalar", "_", algebra3d::overload<&broken_scalar>("value"));
    add("brokenOfTwo", "_, _", algebra3d::overload<&broken_of_two>("value", "text"));
    add("brokenSolid", "_, _", algebra3d::overload<&broken_solid>("a", "b"));
    add("brokenText", "_", algebra3d::overload<&broken_text>("text"));
    add("throwing", "_", algebra3d::overload<&throwing>("value"));
    add("brokenTable", "_", algebra3d::overload<&broken_table>("value"));
    add("brokenRow", "_", algebra3d::overload<&broken_row>("last"));
    made->add({.name = "brokenSum", .overloads = {algebra3d::aggregate<BrokenSum>("values")}});
    return made;
  }();
  return registry;
}

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class FailureReport : public testing::Test {
 protected:
  std::filesystem::path report(int number = 1) const {
    return folder_.path() / ("algebra3d-failure-" + std::to_string(number) + ".q");
  }
  /// What a new session without a database answers to the script, whose own report is `next`.
  std::string repeated(const std::filesystem::path& script) const {
    TestFolder elsewhere;
    TestSession session(elsewhere.path(), broken_registry());
    CommandReader reader;
    std::ifstream lines(script);
    std::string answers;
    for (std::string line; std::getline(lines, line);)
      for (const CommandText& command : reader.add_line(line)) answers += session.run(command.text);
    if (const auto command = reader.finish()) answers += session.run(command->text);
    return answers;
  }
  /// Runs a command that ends with this message, and the report that it leaves.
  void expect_repeatable(const std::string& command, const std::string& message) {
    EXPECT_EQ(session_.run(command),
              "error: " + message + "; a script that repeats the failure is in " + report().string());
    EXPECT_EQ(repeated(report()), "error: " + message) << content(report());
    EXPECT_EQ(content(report()).find("Not exact"), std::string::npos) << content(report());
    std::filesystem::remove(report());
  }

  TestFolder folder_;
  TestSession session_{folder_.path(), broken_registry(), {folder_.path()}};
};

TEST_F(FailureReport, repeats_a_call_with_its_arguments) {
  expect_repeatable("query brokenScalar(3 + 4)", "broken here: a scalar");
  expect_repeatable("query brokenOfTwo(1 / 3, \"a\n\\\"b\\\"\")", "broken here: two arguments");
  expect_repeatable("query throwing(7)", "throwing: unexpected exception: no such place");
}

TEST_F(FailureReport, repeats_a_call_with_solids) {
  expect_repeatable(
      "query brokenSolid(createCube(makePoint3D(0, 0, 0), makePoint3D(1 / 3, 1, 1)), "
      "createCube(makePoint3D(0, 0, 0), makePoint3D(0.1, 1e-300, 1)))",
      "broken here: solids of 12 triangles");
  // Coordinates that are not doubles.
  expect_repeatable(
      "query brokenSolid(createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1)), "
      "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1)) translate[[const vector3d value (1/3 -2/7 0)]])",
      "broken here: solids of 12 triangles");
}

TEST_F(FailureReport, repeats_a_table_and_its_rows) {
  expect_repeatable("query brokenTable(7) count", "broken here: a table");
  expect_repeatable("query brokenRow(9) count", "broken here: row 7");
}

TEST_F(FailureReport, repeats_an_aggregate_with_its_values) {
  expect_repeatable("query intstream(3, 4) transformstream brokenSum[Elem]", "broken here: an aggregate");
}

TEST_F(FailureReport, repeats_the_call_that_failed_within_a_stream) {
  expect_repeatable("query intstream(1, 10000) transformstream filter[brokenScalar(.Elem) > 0] count",
                    "broken here: a scalar");
  EXPECT_EQ(session_.run("query intstream(1, 6) transformstream filter[brokenScalar(.Elem) > 0] count"), "6");
  EXPECT_FALSE(std::filesystem::exists(report()));
}

TEST_F(FailureReport, says_what_failed) {
  session_.run("query brokenScalar(7)");
  const std::string text = content(report());
  EXPECT_TRUE(text.starts_with("# algebra3d ")) << text;
  EXPECT_NE(text.find(": the operator brokenScalar ended with the error internal.\n"
                      "# Message: broken here: a scalar\n"
                      "# To repeat the failure: algebra3d THIS_FILE\n"),
            std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with("(query (brokenScalar\n  (const int value 7)))\n")) << text;
}

TEST_F(FailureReport, loads_what_lies_in_the_database) {
  ASSERT_TRUE(session_.session().open_file(folder_.path() / "own.db").ok());
  session_.run(
      "let R = [const rel(tuple([No: int])) value ((1) (2))] feed "
      "extend[Solid: createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, .No))] consume");
  expect_repeatable("query R feed filter[brokenSolid(.Solid, .Solid)] count", "broken here: solids of 12 triangles");
}

TEST_F(FailureReport, is_the_statement_where_no_operator_over_values_failed) {
  ASSERT_TRUE(session_.session().open_file(folder_.path() / "own.db").ok());
  session_.run("let R = [const rel(tuple([No: int])) value ((7))]");
  // More than 16 MiB of values of 24 bytes.
  const std::string many = "query intstream(1, 700000) transformstream brokenSum[Elem]";
  EXPECT_EQ(session_.run(many), "245000350000");
  // 7 is the sum of 700,001 numbers.
  const std::string command =
      "query intstream(-350000, 350000) transformstream extend[N: ifthenelse(.Elem = 0, 7, .Elem)] brokenSum[N]";
  const std::string answer = session_.run(command);
  EXPECT_NE(answer.find(report().string()), std::string::npos) << answer;
  const std::string text = content(report());
  EXPECT_NE(text.find("This is the statement, and not the call that failed: of the operator brokenSum, its values were "
                      "too many to be kept.\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("algebra3d --db " + (folder_.path() / "own.db").string() + " THIS_FILE\n"), std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with("\n" + command + "\n")) << text;
}

TEST_F(FailureReport, overwrites_nothing_and_is_one_for_a_statement) {
  std::ofstream(report(1)) << "mine";
  session_.run("query intstream(7, 7) transformstream extend[A: brokenScalar(.Elem), B: brokenScalar(.Elem)] consume");
  EXPECT_EQ(content(report(1)), "mine");
  EXPECT_TRUE(std::filesystem::exists(report(2)));
  EXPECT_FALSE(std::filesystem::exists(report(3)));
  for (int count = 0; count < 110; ++count) session_.run("query brokenScalar(7)");
  EXPECT_TRUE(std::filesystem::exists(report(100)));
  EXPECT_FALSE(std::filesystem::exists(report(101)));
  EXPECT_EQ(session_.run("query brokenScalar(7)"), "error: broken here: a scalar; a report could not be written: " +
                                                       folder_.path().string() + ": there are 100 reports already");
}

TEST_F(FailureReport, goes_to_the_next_folder_or_says_why_there_is_none) {
  const std::filesystem::path missing = folder_.path() / "gone";
  TestSession second(folder_.path(), broken_registry(), {missing, folder_.path()});
  EXPECT_EQ(second.run("query brokenScalar(7)"),
            "error: broken here: a scalar; a script that repeats the failure is in " + report().string());
  TestSession nowhere(folder_.path(), broken_registry(), {missing});
  EXPECT_EQ(nowhere.run("query brokenScalar(7)"), "error: broken here: a scalar; a report could not be written: " +
                                                      (missing / "algebra3d-failure-1.q").string() +
                                                      ": there is no folder '" + missing.string() + "'");
}

TEST_F(FailureReport, has_a_folder_that_is_made_or_refused_before_anything_runs) {
  const std::filesystem::path made = folder_.path() / "reports" / "here";
  EXPECT_TRUE(prepare_failure_folder(made).ok());
  EXPECT_TRUE(std::filesystem::is_directory(made));
  EXPECT_TRUE(prepare_failure_folder(made).ok());
  const std::filesystem::path file = folder_.path() / "file";
  std::ofstream(file) << "a file";
  for (const std::filesystem::path& wrong : {file, file / "below"}) {
    const Status status = prepare_failure_folder(wrong);
    ASSERT_FALSE(status.ok()) << wrong;
    EXPECT_EQ(status.error().code, ErrorCode::io_error);
    EXPECT_EQ(status.error().text(),
              "no reports can be written to '" + wrong.string() + "': '" + file.string() + "' is a file, not a folder");
  }
}

TEST_F(FailureReport, says_what_a_script_cannot_hold) {
  TestSession given(folder_.path(), broken_registry(), {folder_.path()});
  SessionParameters parameters;
  parameters.values.emplace("s", Value::of(std::string("a\n# b")));
  given.session().set_parameters(parameters);
  given.run("query brokenText($s)");
  EXPECT_NE(content(report()).find("Not exact: a string has a line"), std::string::npos) << content(report());
}

}  // namespace
}  // namespace queries
