#include "algebra3d/database/database.h"

#include <algorithm>
#include <cfenv>
#include <fstream>
#include <limits>
#include <sstream>
#include <unordered_set>

#include <gtest/gtest.h>

namespace algebra3d::database {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

Database numbers() {
  Database database = *Database::temporary();
  const Status status = database.execute(
      "let Numbers = intstream(1, 5) transformstream extend[Square: .Elem * .Elem, Half: .Elem / 2] consume;");
  EXPECT_TRUE(status.ok()) << status.error().text();
  return database;
}

std::string all_rows(Result<Rows> rows) {
  if (!rows) return "error: " + rows.error().text();
  std::ostringstream text;
  const Status status = rows->for_each([&](const Row& row) { text << row; });
  return status ? text.str() : text.str() + "error: " + status.error().text();
}

std::string shown(const Result<Value>& value) {
  return value ? value->text() : "error: " + value.error().text();
}

/// A folder of its own, which goes with the test.
class DatabaseFile : public ::testing::Test {
 protected:
  DatabaseFile() : folder_(fs::temp_directory_path() / ("database_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~DatabaseFile() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name = "parts.db") const { return folder_ / name; }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

TEST(Database, gives_the_tuples_of_a_relation_with_names_and_types) {
  Database database = numbers();
  Result<Rows> rows = database.query("query Numbers");
  ASSERT_TRUE(rows.ok()) << rows.error().text();
  EXPECT_EQ(rows->columns(), (std::vector<Column>{{"Elem", "int"}, {"Square", "int"}, {"Half", "real"}}));
  const std::vector<Row> all = *rows->all();
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[2].text(), "(3 9 1.5)");
  EXPECT_EQ(*all[3]["Square"].get<std::int64_t>(), 16);
  EXPECT_EQ(all[3][2], Value(2.0));
  EXPECT_EQ(all[3]["Sqare"].get<std::int64_t>().error().text(),
            "the value is undefined: there is no column 'Sqare', did you mean 'Square'?");
  EXPECT_FALSE(rows->next()->has_value());
}

TEST(Database, pulls_a_stream_without_consume) {
  Database database = numbers();
  EXPECT_EQ(all_rows(database.query("query Numbers feed filter[.Elem > 3] project[Elem]")), "(4)(5)");
  EXPECT_EQ(all_rows(database.query("query intstream(1, 3)")), "(1)(2)(3)");
  // Far more than could be kept: only what is asked for is computed.
  Result<Rows> rows = database.query("query intstream(1, 1000000000000)");
  ASSERT_TRUE(rows.ok());
  EXPECT_EQ((**rows->next())[0], Value(1));
  EXPECT_EQ((**rows->next())[0], Value(2));
}

TEST(Database, gives_single_values) {
  Database database = numbers();
  EXPECT_EQ(shown(database.value("query 1 + 2 * 3;")), "7");
  EXPECT_EQ(shown(database.value("query Numbers feed sum[Square]")), "55");
  EXPECT_EQ(shown(database.value("query Numbers feed extract[Elem]")), "1");
  EXPECT_EQ(*database.value("query Numbers count")->get<std::int64_t>(), 5);
  EXPECT_EQ(shown(database.value("query Numbers")), "error: expected a single value, got several rows");
  EXPECT_EQ(shown(database.value("query Numbers feed head[1]")),
            "error: expected a single value, got a row of several values");
  EXPECT_EQ(shown(database.value("query Numbers feed head[0]")), "error: expected a single value, got no row");
}

TEST(Database, changes_nothing_when_it_is_asked_for_a_value_that_is_none) {
  Database database = numbers();
  for (const char* statement : {"let b = 2", "delete Numbers", "list objects", "{ let b = 2 | query b }"}) {
    const Result<Value> value = database.value(statement);
    ASSERT_FALSE(value.ok()) << statement;
    EXPECT_EQ(value.error().code, ErrorCode::type_error);
    EXPECT_EQ(value.error().text(), "expected a query; other commands have no value");
  }
  EXPECT_EQ(database.value("query b").error().code, ErrorCode::unknown_name);
  // Queries may change something, too.
  EXPECT_FALSE(database.value("query Numbers feed Numbers deletedirect").ok());
  EXPECT_FALSE(database.value("query Numbers feed head[1] Numbers deletedirect").ok());
  EXPECT_FALSE(database.value("query Numbers feed Numbers deletedirect filter[.Elem > 9] project[Elem]").ok());
  EXPECT_EQ(shown(database.value("query Numbers count")), "5");
  EXPECT_EQ(shown(database.value("query Numbers feed Numbers deletedirect count")), "5");
  EXPECT_EQ(shown(database.value("query Numbers count")), "0");
}

TEST(Database, gives_values_of_each_type) {
  Database database = *Database::temporary();
  const std::vector<std::pair<std::string, Value>> cases = {
      {"TRUE", Value(true)},
      {"-3", Value(-3)},
      {"2.5", Value(2.5)},
      {"\"part\"", Value("part")},
      {"'part'", Value::text("part")},
      {"makePoint3D(1, 2, 3)", Value::point({1, 2, 3})},
      {"makeVector3D(1, 2, 3)", Value::vector({1, 2, 3})},
      {"rectangle3(0.0, 3.0, 1.0, 4.0, 2.0, 5.0)", Value(Box3{{0, 1, 2}, {3, 4, 5}})},
      {"createCube(makePoint3D(0, 0, 0), makePoint3D(1, 2, 3))", Value(*Solid::box({0, 0, 0}, {1, 2, 3}))},
      {"[const surface3d value (((0 0 0) (1 0 0) (0 1 0)))]",
       Value(*Surface::of_triangles(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                    std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}))},
      {"[const points3d value ((1 2 3) (0 0 0))]", Value::points(std::vector<Vec3>{{1, 2, 3}, {0, 0, 0}})},
      {"[const instant value \"1969-07-20-20:17\"]",
       Value(Instant(std::chrono::sys_days{std::chrono::July / 20 / 1969} + 20h + 17min))},
      {"[const duration value (1 500)]", Value(Duration(24h + 500ms))},
      {"[const plane3d value (1 0 0 1)]", *Value::parse("plane3d", "(1 0 0 1)")},
  };
  for (const auto& [expression, expected] : cases) {
    const Result<Value> value = database.value("query " + expression);
    ASSERT_TRUE(value.ok()) << expression << ": " << value.error().text();
    EXPECT_EQ(*value, expected) << expression;
    // The value, given back as a parameter, stored and read.
    EXPECT_EQ(shown(database.value("query $v", {{"v", *value}})), expected.text()) << expression;
    ASSERT_TRUE(database.execute("let_ Kept = $v", {{"v", *value}}).ok()) << expression;
    EXPECT_EQ(*database.value("query Kept"), expected) << expression;
  }
}

TEST(Database, takes_parameters_as_values_and_never_as_text) {
  Database database = numbers();
  const std::string quotes = "\"; delete Numbers; query \"";
  EXPECT_EQ(*database.value("query $text", {{"text", quotes}})->get<std::string>(), quotes);
  EXPECT_EQ(all_rows(database.query("query Numbers feed filter[.Elem >= $low and .Half < $high] project[Elem]",
                                    {{"low", 2}, {"high", 2.5}})),
            "(2)(3)(4)");
  EXPECT_EQ(
      shown(database.value("query Numbers feed filter[isdefined($none)] count", {{"none", *Value::undefined("int")}})),
      "0");
  EXPECT_EQ(shown(database.value("query volume($solid)", {{"solid", *Solid::box({0, 0, 0}, {1, 2, 3})}})), "6.0");
}

TEST(Database, names_a_parameter_that_is_missing_or_cannot_be_given) {
  Database database = *Database::temporary();
  EXPECT_EQ(shown(database.value("query 1 + $n")), "error: there is no parameter '$n'; the statement was given none");
  EXPECT_EQ(shown(database.value("query $n", {{"m", 1}})), "error: there is no parameter '$n'; the parameters are $m");
  EXPECT_EQ(shown(database.value("query 1", {{"a b", 1}})),
            "error: parameter 'a b': expected a name of letters, digits and '_'");
  EXPECT_EQ(shown(database.value("query 1", {{"s", std::string("ab\xff")}})),
            "error: parameter 's', byte 3: expected UTF-8, found the byte 0xff");
  // Those of a statement are not there for the next.
  EXPECT_EQ(shown(database.value("query $n", {{"n", 1}})), "1");
  EXPECT_EQ(database.value("query $n").error().code, ErrorCode::unknown_name);
}

TEST(Database, keeps_a_parameter_in_a_function_that_it_stores) {
  Database database = *Database::temporary();
  const Status status = database.execute("let without = fun(s: volume3d) volume(s minus $solid)",
                                         {{"solid", *Solid::box({0, 0, 0}, {1, 1, 1})}});
  ASSERT_TRUE(status.ok()) << status.error().text();
  EXPECT_EQ(shown(database.value("query without($s)", {{"s", *Solid::box({0, 0, 0}, {2, 2, 2})}})), "7.0");
}

TEST(Database, tells_where_an_error_is) {
  Database database = numbers();
  const Result<Value> unknown = database.value("query\n  Nubers count");
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().code, ErrorCode::unknown_name);
  EXPECT_EQ(unknown.error().place.line, 2);
  EXPECT_EQ(unknown.error().place.column, 3);
  const Status status = database.execute("let a = 1;\nlet b = a +;\nlet c = 3;");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::syntax_error);
  EXPECT_EQ(status.error().place.line, 2);
  // The commands before it have run, and none behind it.
  EXPECT_EQ(shown(database.value("query a")), "1");
  EXPECT_EQ(database.value("query c").error().code, ErrorCode::unknown_name);
}

TEST(Database, takes_one_statement_where_it_gives_rows) {
  Database database = *Database::temporary();
  EXPECT_EQ(shown(database.value("query 1; query 2;")), "error: expected one statement, found 2");
  EXPECT_EQ(shown(database.value("")), "error: expected one statement, found 0");
  EXPECT_EQ(database.value("@file").error().code, ErrorCode::wrong_usage);
  EXPECT_TRUE(database.execute("").ok());
}

TEST(Database, reports_what_was_changed) {
  Database database = numbers();
  EXPECT_EQ(database.report().inserted, 0U);
  ASSERT_TRUE(database
                  .execute("query Numbers feed filter[.Elem < 3] Numbers insert count;"
                           "query Numbers feed filter[.Elem = 5] Numbers deletedirect count;")
                  .ok());
  EXPECT_EQ(database.report().inserted, 2U);
  EXPECT_EQ(database.report().deleted, 1U);
  EXPECT_EQ(shown(database.value("query Numbers feed Numbers updatedirect[Half: 0.0] count")), "6");
  EXPECT_EQ(database.report().updated, 6U);
  EXPECT_EQ(database.report().inserted, 0U);
}

TEST(Database, tells_why_values_are_undefined) {
  Database database = numbers();
  const Result<Value> quotient = database.value("query 1 div 0");
  ASSERT_TRUE(quotient.ok());
  EXPECT_FALSE(quotient->is_defined());
  EXPECT_NE(quotient->reason().find("division by zero"), std::string_view::npos) << quotient->reason();
  ASSERT_EQ(database.report().notes.size(), 1U);
  Result<Rows> rows = database.query("query Numbers feed projectextend[Elem; Q: 6 div (.Elem - 2)]");
  const std::vector<Row> all = *rows->all();
  EXPECT_EQ(all[0][1], Value(-6));
  EXPECT_EQ(all[0][1].reason(), "");
  EXPECT_NE(all[1]["Q"].reason().find("division by zero"), std::string_view::npos);
  EXPECT_EQ(all[2][1], Value(6));
}

TEST(Database, passes_on_why_a_parameter_is_undefined) {
  Database database = numbers();
  const Parameters wrong = {{"x", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_EQ(database.value("query $x", wrong)->reason(), "parameter '$x': not a finite number");
  EXPECT_EQ(database.value("query 2.0 * $x", wrong)->reason(), "parameter '$x': not a finite number");
  const std::vector<Row> rows = *database.query("query Numbers feed projectextend[; P: .Half * $x]", wrong)->all();
  ASSERT_EQ(rows.size(), 5U);
  for (const Row& row : rows) EXPECT_EQ(row["P"].reason(), "parameter '$x': not a finite number");
  ASSERT_TRUE(database.execute("let kept = $x", wrong).ok());
  EXPECT_EQ(database.report().notes, std::vector<std::string>{"parameter '$x': not a finite number"});
  // Where it is not used, there is no note.
  ASSERT_TRUE(database.execute("let one = 1", wrong).ok());
  EXPECT_TRUE(database.report().notes.empty());
}

TEST(Database, points_at_a_name_that_cannot_be_given) {
  Database database = numbers();
  const auto column = [&](const char* statement) { return database.execute(statement).error().place.column; };
  EXPECT_EQ(column("let Numbers = 1"), 5);
  EXPECT_EQ(column("let fun = 1"), 5);
  EXPECT_EQ(column("let_ fun = 1"), 6);
  EXPECT_EQ(column("derive Numbers = 1"), 8);
  EXPECT_EQ(column("create Numbers : int"), 8);
  EXPECT_EQ(column("create fun : int"), 8);
  EXPECT_EQ(column("changename Numbers to fun"), 23);
  EXPECT_EQ(column("type int = real"), 6);
  ASSERT_TRUE(database.execute("let other = 1").ok());
  EXPECT_EQ(column("changename Numbers to other"), 23);
}

TEST(Database, tells_that_it_was_closed_by_a_statement) {
  Database database = numbers();
  ASSERT_TRUE(database.execute("close database").ok());
  const Result<Value> count = database.value("query Numbers count");
  ASSERT_FALSE(count.ok());
  EXPECT_EQ(count.error().code, ErrorCode::no_database);
  EXPECT_EQ(count.error().text(), "unknown name 'Numbers': no database is open");
  EXPECT_EQ(shown(database.value("query 1 + 1")), "2");
}

TEST(Database, rows_are_read_in_a_range_based_for) {
  Database database = numbers();
  Result<Rows> rows = database.query("query Numbers feed project[Elem]");
  std::string text;
  for (const Result<Row>& row : *rows) text += row->text();
  EXPECT_EQ(text, "(1)(2)(3)(4)(5)");
  EXPECT_TRUE(rows->begin() == Rows::end());
  // An error is the last element. A key that occurs twice is not seen before the second tuple.
  Result<Rows> long_rows = database.query("query intstream(1, 1000000000000)");
  int good = 0;
  ErrorCode last = ErrorCode::internal;
  for (const Result<Row>& row : *long_rows) {
    if (row) ++good;
    if (!row) last = row.error().code;
    database.cancel();
  }
  EXPECT_GE(good, 1);
  EXPECT_EQ(last, ErrorCode::interrupted);
}

TEST(Database, results_do_not_follow_the_rounding_mode_of_the_caller) {
  Database database = *Database::temporary();
  const std::string tenth = database.value("query 1.0 / 10.0")->text();
  const int before = std::fegetround();
  std::fesetround(FE_UPWARD);
  Database other = *Database::temporary();
  const std::string upward = other.value("query 1.0 / 10.0")->text();
  const double large = *Value((std::int64_t{1} << 53) + 1).get<double>();
  const std::string parsed = Value::parse("point3d", "(1/3 0.1 0.7)")->text();
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
  std::fesetround(before);
  EXPECT_EQ(upward, tenth);
  EXPECT_EQ(large, 0x1p53);
  EXPECT_EQ(parsed, Value::parse("point3d", "(1/3 0.1 0.7)")->text());
}

TEST(Database, gives_inquiries_as_rows) {
  Database database = numbers();
  Result<Rows> rows = database.query("list objects");
  ASSERT_TRUE(rows.ok()) << rows.error().text();
  EXPECT_EQ(rows->columns(), (std::vector<Column>{{"Name", "text"}, {"Type", "text"}}));
  const std::vector<Row> all = *rows->all();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0]["Name"], Value::text("Numbers"));
  Result<Rows> plan = database.query("explain Numbers feed count");
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->columns()[3], (Column{"Calls", "int"}));
}

TEST(Database, shows_functions_and_indexes_by_their_notation) {
  Database database = numbers();
  ASSERT_TRUE(database.execute("let twice = fun(n: int) n * 2; let Index = Numbers createbtree[Elem]").ok());
  EXPECT_EQ(database.value("query twice")->get<std::string>().value(), "(fun (n int) (* n 2))");
  Result<Rows> index = database.query("query Index");
  ASSERT_TRUE(index.ok()) << index.error().text();
  EXPECT_EQ(index->columns().front().name, "value");
  EXPECT_EQ((**index->next())[0], Value::text("(Numbers Elem 5)"));
}

TEST(Database, groups_statements_into_transactions) {
  Database database = numbers();
  ASSERT_TRUE(database.execute("begin transaction; delete Numbers").ok());
  EXPECT_TRUE(database.is_in_transaction());
  ASSERT_TRUE(database.execute("abort transaction").ok());
  EXPECT_FALSE(database.is_in_transaction());
  EXPECT_EQ(shown(database.value("query Numbers count")), "5");
}

TEST(Database, takes_statements_as_deeply_nested_as_the_program) {
  Database database = *Database::temporary();
  std::string sum = "1";
  for (int i = 0; i < 190; ++i) sum = "(" + sum + " + 1)";
  EXPECT_EQ(shown(database.value("query " + sum)), "191");
}

TEST(Database, may_be_moved) {
  Database first = numbers();
  Result<Rows> rows = first.query("query Numbers");
  Result<Rows> taken = std::move(*rows);
  EXPECT_FALSE(rows->next()->has_value());  // NOLINT(bugprone-use-after-move): has no more
  rows = std::move(taken);
  Database second = std::move(first);
  EXPECT_EQ(rows->all()->size(), 5U);
  EXPECT_EQ(shown(second.value("query Numbers count")), "5");
  EXPECT_EQ(shown(first.value("query 1")),
            "error: the database was moved elsewhere");  // NOLINT(bugprone-use-after-move)
  first.cancel();                                        // does nothing
  EXPECT_EQ(first.report().notes.size(), 0U);
}

TEST(Database, is_kept_open_by_rows_that_are_read) {
  std::optional<Database> database = numbers();
  const fs::path file = database->file();
  {
    Result<Rows> rows = database->query("query Numbers");
    database.reset();
    EXPECT_TRUE(fs::exists(file));
    EXPECT_EQ(rows->all()->size(), 5U);
  }
  EXPECT_FALSE(fs::exists(file.parent_path()));  // the temporary folder
}

TEST(Database, rows_are_values_of_their_own) {
  std::vector<Row> rows;
  {
    Database database = numbers();
    rows = *database.query("query Numbers feed Numbers feed concat")->all();
  }
  ASSERT_EQ(rows.size(), 10U);
  EXPECT_EQ(rows[0], rows[5]);
  EXPECT_LT(rows[0], rows[1]);
  EXPECT_EQ(std::unordered_set<Row>(rows.begin(), rows.end()).size(), 5U);
}

TEST_F(DatabaseFile, is_made_opened_again_and_read_only) {
  OpenOptions existing;
  existing.creates = false;
  EXPECT_EQ(Database::open(file(), existing).error().code, ErrorCode::database_missing);
  {
    Database database = *Database::open(file());
    ASSERT_TRUE(database.execute("let a = 1").ok());
  }
  EXPECT_EQ(shown(Database::open(file(), existing)->value("query a")), "1");
  OpenOptions reading;
  reading.read_only = true;
  Database database = *Database::open(file(), reading);
  EXPECT_EQ(shown(database.value("query a")), "1");
  EXPECT_EQ(database.execute("let b = 2").error().code, ErrorCode::database_read_only);
  EXPECT_EQ(Database::open(file("none.db"), reading).error().code, ErrorCode::database_missing);
}

TEST_F(DatabaseFile, of_another_program_is_an_error) {
  std::ofstream(file()) << "this is no database, and longer than the header of one\n" << std::string(5000, 'x');
  EXPECT_EQ(Database::open(file()).error().code, ErrorCode::database_foreign);
  EXPECT_EQ(Database::open(folder() / "none" / "parts.db").error().code, ErrorCode::file_missing);
}

TEST_F(DatabaseFile, has_a_name_that_the_system_takes) {
  const std::string with_zero = file().string() + std::string("\0.db", 4);
  for (const fs::path& name : {fs::path(), fs::path(with_zero)}) {
    EXPECT_EQ(Database::open(name).error().code, ErrorCode::file_missing);
    EXPECT_EQ(Database::open(name, {.read_only = true}).error().code, ErrorCode::file_missing);
  }
  EXPECT_EQ(Database::open("").error().text(), "the file name is empty");
  EXPECT_EQ(Database::open(with_zero).error().text(), "the file name has a zero byte behind '" + file().string() + "'");
  EXPECT_FALSE(fs::exists(file()));
  EXPECT_EQ(Database::open(file(), {.folder = with_zero}).error().code, ErrorCode::file_missing);
  EXPECT_EQ(Database::open(file(), {.failure_folder = with_zero}).error().code, ErrorCode::file_missing);
}

TEST_F(DatabaseFile, that_is_damaged_gives_the_findings_as_notes_of_a_script) {
  const std::string mark = "a text that is long enough to be found again";
  {
    Database database = *Database::open(file());
    ASSERT_TRUE(database.execute("let Texts = [const rel(tuple([T: string])) value ((\"" + mark + "\"))]").ok());
  }
  std::fstream stream(file(), std::ios::in | std::ios::out | std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  const std::size_t place = bytes.find(mark);
  ASSERT_NE(place, std::string::npos);
  stream.seekp(static_cast<std::streamoff>(place));
  stream << 'X';
  stream.close();
  Database database = *Database::open(file());
  const Status status = database.execute("check database");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::database_corrupt);
  EXPECT_TRUE(status.error().text().ends_with(" findings; they are in the notes")) << status.error().text();
  // The page, by its checksum, and the tuple.
  const auto& notes = database.report().notes;
  EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& note) { return note.starts_with("Texts: tuple 1: "); }));
  EXPECT_TRUE(
      std::ranges::any_of(notes, [](const std::string& note) { return note.find("checksum") != std::string::npos; }));
}

TEST_F(DatabaseFile, relative_names_start_from_the_folder) {
  OpenOptions options;
  options.folder = folder();
  Database database = *Database::open(file(), options);
  const Parameters cube = {{"cube", *Solid::box({0, 0, 0}, {1, 1, 1})}, {"file", "cube.stl"}};
  ASSERT_TRUE(database.execute("query $cube exportSTL[\"cube\", $file, TRUE]", cube).ok());
  EXPECT_TRUE(fs::exists(folder() / "cube.stl"));
  EXPECT_EQ(*database.value("query importSTL($file)", cube), cube.at("cube"));
}

TEST_F(DatabaseFile, a_script_fails_where_a_file_is_missing) {
  Database database = *Database::temporary();
  const Status status = database.execute("let Part = importSTL($file);", {{"file", file("none.stl").string()}});
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::io_error);
  // As a value it is undefined, with the reason.
  const Result<Value> value = database.value("query importSTL($file)", {{"file", file("none.stl").string()}});
  ASSERT_TRUE(value.ok()) << value.error().text();
  EXPECT_NE(value->reason().find("none.stl"), std::string_view::npos) << value->reason();
}

}  // namespace
}  // namespace algebra3d::database
