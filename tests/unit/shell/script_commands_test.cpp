// The commands that the shell carries out itself, in scripts.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/values/conversions/mesh3d_files.h"
#include "queries/exchange/csv_presenter.h"
#include "queries/exchange/json_presenter.h"
#include "queries/shell/detail/interruption.h"
#include "queries/shell/detail/presenters.h"
#include "queries/shell/detail/statement_runner.h"
#include "queries/streams/all.h"

namespace queries {
namespace {

const algebra3d::Registry& registry() {
  static const algebra3d::Registry& all = *[] {
    auto* made = new algebra3d::Registry(algebra3d::make_registry());
    register_stream_operators(*made);
    return made;
  }();
  return all;
}

class ScriptCommands : public testing::Test {
 protected:
  ScriptCommands() { std::filesystem::create_directories(folder_); }
  ~ScriptCommands() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  RunResult run(const std::string& text) {
    Session session(registry(), {.folder = folder_, .read_only = false});
    ListPresenter presenter(out_);
    StatementRunner runner(session, presenter, {out_, errors_}, rules_);
    std::istringstream script(text);
    return runner.run_script(script, "script");
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("algebra3d-scripts-" + std::to_string(getpid()));
  FailureRules rules_;
  std::ostringstream out_;
  std::ostringstream errors_;
};

TEST_F(ScriptCommands, a_script_runs_another) {
  write("inner.q", "query 1 + 1;\nquery 3\n");
  EXPECT_EQ(run("@" + path("inner.q") + "\nquery 4;"), RunResult::ok);
  EXPECT_EQ(out_.str(), "(int 2)\n(int 3)\n(int 4)\n");
}

TEST_F(ScriptCommands, a_script_may_end_at_its_first_error) {
  write("inner.q", "query nope;\nquery 3;\n");
  EXPECT_EQ(run("@" + path("inner.q")), RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 3)\n");
  EXPECT_EQ(run("@@" + path("inner.q") + "\nquery 5;"), RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 3)\n(int 5)\n");
  EXPECT_NE(errors_.str().find("inner.q:1:7: error: unknown name 'nope'"), std::string::npos) << errors_.str();
}

TEST_F(ScriptCommands, a_sequence_ends_at_a_failed_result_as_at_an_error) {
  for (const char* first : {"query importSTL('no.stl')", "query nosuch"}) {
    const std::string command = first;
    out_.str("");
    EXPECT_EQ(run("{ " + command + " | query 2 }"), RunResult::failed);
    EXPECT_EQ(run("while TRUE do { " + command + " | query 2 } endwhile"), RunResult::failed);
    EXPECT_EQ(out_.str().find("(int 2)"), std::string::npos) << out_.str();
    EXPECT_EQ(run("{{ " + command + " | query 3 }}"), RunResult::failed);
    EXPECT_NE(out_.str().find("(int 3)"), std::string::npos) << out_.str();
  }
}

TEST_F(ScriptCommands, features_that_cannot_be_read_are_an_error) {
  rules_.stops_on_error = true;
  EXPECT_EQ(run("query 1; query importGeoJSON('no.geojson') consume; query 2;"), RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 1)\n");
}

TEST_F(ScriptCommands, a_solid_that_is_the_result_and_not_written_is_an_error) {
  std::filesystem::create_directories(folder_ / "value_1.obj" / "in the way");
  Session session(registry(), {.folder = folder_, .read_only = false});
  ExchangeOptions options;
  options.geometry = ExchangeOptions::Geometry::file;
  options.folder = folder_;
  for (const bool is_json : {true, false}) {
    ExchangeValues values(options);
    JsonPresenter json(out_, values, JsonPresenter::Layout::document);
    CsvPresenter csv(out_, values);
    Presenter& presenter = is_json ? static_cast<Presenter&>(json) : csv;
    StatementRunner runner(session, presenter, {out_, errors_}, rules_);
    std::istringstream script("query createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))");
    EXPECT_EQ(runner.run_script(script, "script"), RunResult::failed);
  }
  EXPECT_EQ(out_.str(), "");
  EXPECT_NE(errors_.str().find("error: --geometry-dir: not written: exportOBJ: "), std::string::npos) << errors_.str();
}

TEST_F(ScriptCommands, surfaces_and_meshes_are_written_as_mesh_files_too) {
  Session session(registry(), {.folder = folder_, .read_only = false});
  ExchangeOptions options;
  options.geometry = ExchangeOptions::Geometry::file;
  options.folder = folder_;
  const std::string surface = "[const surface3d value (((0 0 0) (1 0 0) (0 1 0)))]",
                    mesh = "[const mesh3d value (((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((0 1 2 3)))]";
  for (const std::string ending : {"obj", "off", "stl"}) {
    options.mesh_ending = ending;
    ExchangeValues values(options);
    JsonPresenter json(out_, values, JsonPresenter::Layout::document);
    StatementRunner runner(session, json, {out_, errors_}, rules_);
    std::istringstream script("query " + surface + "; query " + mesh + "; query [const points3d value ((0 0 0))]");
    EXPECT_EQ(runner.run_script(script, "script"), RunResult::ok) << errors_.str();
    const auto file = [&](const std::string& number) { return path("value_" + number + "." + ending); };
    EXPECT_EQ(out_.str(), "\"" + file("1") + "\"\n\"" + file("2") + "\"\n[[0.0,0.0,0.0]]\n");
    out_.str("");
    const auto first = algebra3d::import_mesh(file("1")), second = algebra3d::import_mesh(file("2"));
    ASSERT_TRUE(first->mesh && second->mesh);
    EXPECT_EQ(first->mesh->mesh().face_count(), 1U);
    EXPECT_EQ(second->mesh->mesh().face_count(), ending == "stl" ? 2U : 1U);
    EXPECT_EQ(second->mesh->mesh().vertex_count(), 4U);
  }
}

TEST_F(ScriptCommands, marked_comments_are_skipped_on_demand) {
  write("inner.q", "// a line\n/* a block\nquery 1;\n*/\nquery nope;\nquery 2;\n");
  EXPECT_EQ(run("@%" + path("inner.q")), RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 2)\n");
  EXPECT_EQ(run("@&" + path("inner.q")), RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 2)\n");
}

TEST_F(ScriptCommands, a_marked_comment_that_is_not_closed_is_an_error) {
  write("inner.q", "query 1;\n/* a block\nquery 2;\n");
  EXPECT_EQ(run("@%" + path("inner.q") + "\nquery 3;"), RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 1)\n(int 3)\n");
  EXPECT_EQ(errors_.str(), path("inner.q") +
                               ":2:1: error: this comment is not closed by a line that begins with */; what follows "
                               "was not run\n");
}

TEST_F(ScriptCommands, a_device_is_no_script) {
  EXPECT_EQ(run("@/dev/zero"), RunResult::failed);
  EXPECT_EQ(errors_.str(), "script:1:1: error: cannot read the script '/dev/zero': it is a device\n");
  EXPECT_EQ(run("@/dev/null"), RunResult::ok);
}

TEST_F(ScriptCommands, long_lines_are_read_whole) {
  const std::string text(100000, 'x');
  for (const std::size_t length : {std::size_t{4083}, std::size_t{4084}, std::size_t{4085}, std::size_t{100000}}) {
    out_.str("");
    EXPECT_EQ(run("query \"" + text.substr(0, length) + "\"\n\nquery 2"), RunResult::ok);
    EXPECT_EQ(out_.str(), "(string \"" + text.substr(0, length) + "\")\n(int 2)\n");
  }
}

/// A database with an int `a` of 1 that another session writes to, so that no transaction can begin.
class LockedDatabase : public ScriptCommands {
 protected:
  LockedDatabase() : other_(registry(), {.folder = folder_, .read_only = false}) {
    run("create database d; open database d; let a = 1;");
    ListPresenter presenter(out_);
    for (const char* command : {"open database d", "begin transaction"}) {
      Context context{diagnostics_, nullptr, {}};
      EXPECT_TRUE(other_.execute(command, {}, presenter, context));
    }
  }

  algebra3d::Diagnostics diagnostics_;
  Session other_;
};

TEST_F(LockedDatabase, nothing_of_a_transaction_that_cannot_begin_is_run) {
  EXPECT_EQ(run("open database d;\nbegin transaction;\nquery 1;\nquery 2;\ncommit transaction;\nquery 3;"),
            RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 3)\n");
  const std::string errors = errors_.str();
  EXPECT_NE(errors.find("script:3:1: error: not run, since the transaction of script:2 could not begin\n"
                        "script:4:1: error: not run, since the transaction of script:2 could not begin\n"
                        "script:5:1: error: nothing is committed, since the transaction of script:2 could not begin\n"),
            std::string::npos)
      << errors;
}

TEST_F(LockedDatabase, nor_in_a_sequence_that_goes_on_after_errors) {
  EXPECT_EQ(run("open database d; {{ query 1 | begin transaction | query 2 | commit transaction }}"),
            RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 1)\n");
}

TEST_F(LockedDatabase, a_transaction_that_cannot_begin_lasts_to_the_end_of_the_script) {
  write("inner.q", "begin transaction;\nquery 1;\n");
  EXPECT_EQ(run("open database d;\n@" + path("inner.q") + "\nquery 2;"), RunResult::failed);
  EXPECT_EQ(out_.str(), "");
  EXPECT_NE(errors_.str().find("script:3:1: error: not run, since the transaction of " + path("inner.q") + ":1 could"),
            std::string::npos)
      << errors_.str();
}

TEST_F(ScriptCommands, a_second_begin_leaves_the_transaction_as_it_is) {
  EXPECT_EQ(run("create database d; open database d; begin transaction; let a = 1; begin transaction; query a; "
                "commit transaction; query a"),
            RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 1)\n(int 1)\n");
}

TEST_F(ScriptCommands, a_script_that_includes_itself_is_an_error) {
  write("a.q", "@" + path("b.q") + "\nquery 1;\n");
  write("b.q", "@" + path("a.q") + "\nquery 2;\n");
  EXPECT_EQ(run("@" + path("a.q")), RunResult::failed);
  EXPECT_EQ(errors_.str(), path("b.q") + ":1:1: error: the script '" + path("a.q") + "' includes itself\n");
  EXPECT_EQ(out_.str(), "(int 2)\n(int 1)\n");
}

TEST_F(ScriptCommands, a_script_that_is_not_there) {
  EXPECT_EQ(run("@" + path("none.q")), RunResult::failed);
  EXPECT_EQ(errors_.str(),
            "script:1:1: error: cannot read the script '" + path("none.q") + "': No such file or directory\n");
  EXPECT_EQ(run("@"), RunResult::failed);
}

TEST_F(ScriptCommands, an_interruption_before_or_between_statements_ends_the_script) {
  write("a.q", "query 1;\nquery 2;\n");
  Interruption::flag() = true;
  EXPECT_EQ(run("@" + path("a.q")), RunResult::interrupted);
  EXPECT_EQ(out_.str(), "");
  EXPECT_EQ(errors_.str(), "error: interrupted while the script was read\n");
  EXPECT_FALSE(Interruption::flag());
  Interruption::flag() = true;
  EXPECT_EQ(run("REPEAT 1000000 query 3"), RunResult::interrupted);
  EXPECT_EQ(out_.str(), "");  // not one of them
}

TEST_F(ScriptCommands, functions_that_call_each_other_can_be_interrupted) {
  const std::string open = "create database d; open database d; let f = fun(x: int) x + 1; query f(1); ";
  Interruption::flag() = false;
  run(open);
  EXPECT_EQ(out_.str(), "(int 2)\n");
  out_.str("");
  Interruption::flag() = true;
  EXPECT_EQ(run("open database d; query f(1)"), RunResult::interrupted);
  EXPECT_EQ(out_.str(), "");
}

TEST_F(ScriptCommands, repeat_runs_a_command_several_times) {
  EXPECT_EQ(run("REPEAT 3 query 7"), RunResult::ok);
  EXPECT_EQ(out_.str(), "(int 7)\n(int 7)\n(int 7)\n");
  EXPECT_EQ(run("repeat many query 7"), RunResult::failed);
  EXPECT_EQ(errors_.str(),
            "script:1:1: error: repeat: expected a number of times and a command, found 'many query 7'\n");
}

TEST_F(ScriptCommands, an_import_or_export_that_fails_is_a_failure_of_the_statement_whose_result_it_is) {
  const std::string missing = "importSTL('" + path("missing.stl") + "')";
  const std::string unwritten = "exportSTL[\"c\", '" + path("no/folder/c.stl") + "', TRUE]";
  for (const std::string& statement :
       {"query " + missing, "query volume(" + missing + ")", "query importSurface('" + path("missing.stl") + "')",
        "query createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1)) " + unwritten,
        "query " + missing + " " + unwritten, "{ query 1 | query " + missing + " }",
        "create database a; open database a; let M = " + missing,
        "create database b; open database b; derive M = " + missing,
        "create database c; open database c; let M = createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1)); update M "
        ":= " +
            missing}) {
    rules_ = {};
    EXPECT_EQ(run(statement + "; query 77"), RunResult::failed) << statement;
    EXPECT_TRUE(out_.str().ends_with("(int 77)\n")) << statement;
    for (const char* name : {"a", "b", "c"}) std::filesystem::remove(folder_ / (std::string(name) + ".db"));
    out_.str("");
    rules_.stops_on_error = true;
    EXPECT_EQ(run(statement + "; query 77"), RunResult::failed) << statement;
    EXPECT_EQ(out_.str().find("77"), std::string::npos) << statement;
    EXPECT_NE(errors_.str().find("error: the statement has failed: its result is "), std::string::npos) << statement;
    out_.str("");
    errors_.str("");
  }
}

TEST_F(ScriptCommands, undefined_values_of_other_kinds_are_answers) {
  const std::string missing = "importSTL('" + path("missing.stl") + "')";
  rules_.stops_on_error = true;
  for (const std::string& statement :
       {std::string("query 1 div 0"), std::string("query [const point3d value undefined]"),
        "query isdefined(" + missing + ")", "query isEmpty(" + missing + ")",
        "query [const rel(tuple([F: text])) value (('" + path("missing.stl") +
            "'))] feed extend[S: importSTL(.F)] consume"})
    EXPECT_EQ(run(statement + "; query 77"), RunResult::ok) << statement << errors_.str();
}

TEST_F(ScriptCommands, a_script_may_fail_wherever_a_value_is_undefined_for_a_reason) {
  const std::string files = "[const rel(tuple([F: text])) value (('" + path("a.stl") + "') ('" + path("b.stl") + "'))]";
  rules_ = {.stops_on_error = true, .fails_on_undefined = true};
  EXPECT_EQ(run("query " + files + " feed extend[S: importSTL(.F)] count; query 77"), RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 2)\n");
  EXPECT_NE(errors_.str().find("script:1:1: error: 2 values are undefined"), std::string::npos) << errors_.str();
  EXPECT_EQ(run("query 1 div 0; query 77"), RunResult::failed);
  EXPECT_EQ(run("query [const int value undefined] + 1; query 77"), RunResult::ok);
  EXPECT_TRUE(out_.str().ends_with("(int undefined)\n(int 77)\n")) << out_.str();
  rules_.stops_on_error = false;
  EXPECT_EQ(run("query intstream(1, 3) filter[. div 0 = 1] count; query 78"), RunResult::failed);
  EXPECT_TRUE(out_.str().ends_with("(int 78)\n")) << out_.str();
}

TEST_F(ScriptCommands, exit_is_quit) {
  EXPECT_EQ(run("query 1;\nexit\nquery 2;"), RunResult::quit);
  EXPECT_EQ(out_.str(), "(int 1)\n");
  EXPECT_EQ(errors_.str(), "note: `exit` means `quit` here\n");
}

TEST_F(ScriptCommands, words_of_the_shell_need_no_semicolon) {
  EXPECT_EQ(run("Query 1;\nDEBUG 1\nquery 2;\nQUIT\nquery 3;"), RunResult::failed);
  EXPECT_EQ(out_.str(), "(int 2)\n");
  EXPECT_EQ(run("? volume\nHELP no_such_thing\n"), RunResult::failed);
  EXPECT_NE(out_.str().find("The enclosed volume "), std::string::npos);
}

}  // namespace
}  // namespace queries
