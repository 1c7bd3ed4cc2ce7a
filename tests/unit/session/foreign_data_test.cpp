// What data of somebody else must not do by itself: a saved file that is restored, a database that is opened.
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include "algebra3d/operators/registry/operator.h"
#include "queries/language/example_queries.h"
#include "unit/session/example_session.h"

namespace queries {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCube = "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))";

std::string file_content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string database_of(const std::string& objects) {
  return "(DATABASE x (DESCRIPTIVE ALGEBRA) (TYPES) (OBJECTS " + objects + "))";
}

/// A folder with a victim's file, and below it one with the files of somebody else.
class ForeignData : public testing::Test {
 protected:
  ForeignData() {
    fs::create_directories(foreign());
    write(folder_.path() / "victim", kSecret);
    write(folder_.path() / "victim.csv", "A\n1\n2\n");
    for (const char* command :
         {"create database own", "open database own", "let R = intstream(1, 3) transformstream consume"})
      EXPECT_EQ(session_.run(command), "") << command;
  }

  fs::path foreign() const { return folder_.path() / "foreign"; }
  static void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }
  void expect_untouched() const {
    EXPECT_EQ(file_content(folder_.path() / "victim"), kSecret);
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) names.insert(entry.path().filename());
    for (const char* ending : {"own.db-wal", "own.db-shm", "new.db", "new.db-wal", "new.db-shm"}) names.erase(ending);
    EXPECT_EQ(names, (std::set<std::string>{"foreign", "own.db", "victim", "victim.csv"}));
  }
  /// Restores a list of objects as the database `new`.
  std::string restore(const std::string& objects) {
    write(foreign() / "list", database_of(objects));
    session_.run("close database");
    return session_.run("restore database new from 'foreign/list'");
  }

  static constexpr const char* kSecret = "the content of somebody's start-up file";
  TestFolder folder_;
  TestSession session_{folder_.path()};
};

/// Expressions, as texts and as nested lists, that write or change something, directly or through functions.
struct Writing {
  const char* text;
  const char* list;
  const char* reason;
};

constexpr Writing kWriting[] = {
    {R"(S exportSTL["", 'victim', FALSE])", R"((exportSTL S "" 'victim' FALSE))", "writes a file (exportSTL)"},
    {R"(S exportOBJ["", 'new'])", R"((exportOBJ S "" 'new'))", "writes a file (exportOBJ)"},
    {"S exportOFF['new', TRUE]", "(exportOFF S 'new' TRUE)", "writes a file (exportOFF)"},
    {"f(S)", "(f S)", "writes a file (exportSTL, by the function f)"},
    {"g(S)", "(g S)", "writes a file (exportSTL, by the functions g, f)"},
    {"(1 > 2) and f(S)", "(and (> 1 2) (f S))", "writes a file (exportSTL, by the function f)"},
    {"R feed filter[f(S)] count", "(count (filter (feed R) (fun (t1 TUPLE) (f S))))",
     "writes a file (exportSTL, by the function f)"},
    {"R feed R deletedirect count", "(count (deletedirect (feed R) R))", "changes a relation (deletedirect)"},
    {"R inserttuple[7] count", "(count (inserttuple R (7)))", "changes a relation (inserttuple)"},
    {"h(1)", "(h 1)", "changes a relation (deletedirect, by the function h)"},
    // The name of the file is evaluated when the expression is checked.
    {"importCSV(name(S)) count", "(count (importCSV (name S)))", "writes a file (exportSTL, by the functions name, f)"},
};

constexpr const char* kFunctions[][2] = {
    {R"(fun(s: volume3d) s exportSTL["", 'victim', FALSE])", R"((fun (s volume3d) (exportSTL s "" 'victim' FALSE)))"},
    {"fun(s: volume3d) f(s)", "(fun (s volume3d) (f s))"},
    {"fun(x: int) (R feed R deletedirect count) + x", "(fun (x int) (+ (count (deletedirect (feed R) R)) x))"},
    {"fun(s: volume3d) ifthenelse(f(s), 'victim.csv', 'victim.csv')",
     "(fun (s volume3d) (ifthenelse (f s) 'victim.csv' 'victim.csv'))"},
};
constexpr const char* kNames[] = {"f", "g", "h", "name"};

// What `derive` and `restore` refuse is what the descriptions say.
TEST(Descriptions, say_which_operators_change_relations) {
  int changing = 0;
  for (const algebra3d::Operator* op : test_registry().operators()) {
    if (op->is_pure) continue;
    bool has_written = false;
    for (const auto& [query, result] : example_queries(test_registry(), *op)) {
      const TestFolder folder;
      TestSession session(folder.path());
      ASSERT_TRUE(session.session().open_file(folder.path() / "examples.db").ok());
      for (const std::string& command : example_objects()) ASSERT_EQ(session.run(command), "");
      session.run("query " + query);
      has_written = has_written || session.has_written();
    }
    EXPECT_EQ(has_written, op->changes_relations) << op->name;
    changing += has_written ? 1 : 0;
  }
  EXPECT_EQ(changing, 7);
}

TEST_F(ForeignData, derive_refuses_what_writes) {
  ASSERT_EQ(session_.run(std::string("let S = ") + kCube), "");
  for (std::size_t i = 0; i < std::size(kNames); ++i)
    ASSERT_EQ(session_.run(fmt::format("let {} = {}", kNames[i], kFunctions[i][0])), "");
  for (const Writing& each : kWriting)
    EXPECT_EQ(session_.run(std::string("derive D = ") + each.text),
              fmt::format("error: derive: the expression {}, which it would do again whenever it is evaluated; use let",
                          each.reason));
  EXPECT_EQ(session_.run("query R count"), "3");
  expect_untouched();
}

TEST_F(ForeignData, restore_leaves_out_what_writes) {
  const std::string solid =
      "(OBJECT S () volume3d (((0 0 0) (0 15 0) (15 0 0)) ((0 0 0) (15 0 0) (0 0 15)) "
      "((15 0 0) (0 15 0) (0 0 15)) ((0 15 0) (0 0 0) (0 0 15))) ())";
  const std::string relation = "(OBJECT R () (rel (tuple ((Elem int)))) ((1) (2) (3)) ())";
  std::string functions;
  const char* types[] = {"(map volume3d bool)", "(map volume3d bool)", "(map int int)", "(map volume3d text)"};
  for (std::size_t i = 0; i < std::size(kNames); ++i)
    functions += fmt::format("(OBJECT {} () {} {} ()) ", kNames[i], types[i], kFunctions[i][1]);
  for (const Writing& each : kWriting) {
    fs::remove(folder_.path() / "new.db");
    const std::string derived =
        fmt::format("(DERIVED D {} defined) (DERIVED E (= D D)) (DERIVED Size (count R))", each.list);
    EXPECT_EQ(restore(solid + relation + functions + derived),
              "error: restore: the database 'new' was restored and is open, without these objects, which cannot be "
              "derived again: D, E")
        << each.list;
    EXPECT_NE(session_.notes().find(fmt::format(
                  "restore: 'D' is left out, it cannot be derived again: its expression {}\n", each.reason)),
              std::string::npos)
        << session_.notes();
    EXPECT_EQ(session_.run("query Size + R count"), "6");
    expect_untouched();
    // A single object, into a database that has what it changes.
    write(foreign() / "one", fmt::format("(DERIVED D {})", each.list));
    EXPECT_EQ(session_.run("restore D from 'foreign/one'"),
              "error: restore: 'D' cannot be derived again; nothing was restored");
    EXPECT_EQ(session_.run("query R count"), "3");
    expect_untouched();
  }
}

TEST_F(ForeignData, restore_tells_of_functions_that_write) {
  EXPECT_EQ(restore(R"((OBJECT f () (map volume3d bool) (fun (s volume3d) (exportSTL s "" 'victim' FALSE)) ()))"), "");
  EXPECT_EQ(session_.notes(), "restore: the function 'f' writes a file (exportSTL) when it is called\n");
}

// Nobody who asks for a volume expects a file to be written.
TEST_F(ForeignData, a_function_with_the_name_of_an_operator_changes_nothing) {
  const std::string refusal =
      "the function 'volume' has the name of an operator and writes a file (exportSTL), which callers of "
      "the operator do not expect; give it another name";
  const std::string list =
      R"((OBJECT volume () (map volume3d real) (fun (s volume3d) (ifthenelse (exportSTL s "" 'victim' FALSE) 1.0 2.0)) ()))";
  EXPECT_EQ(restore(list), "");
  EXPECT_EQ(session_.notes(), "restore: calls will fail: " + refusal + "\n");
  EXPECT_EQ(session_.run(fmt::format("query volume({})", kCube)), "error: " + refusal);
  EXPECT_EQ(session_.run("changename volume to other"), "");
  const std::string definition = R"(fun(s: volume3d) ifthenelse(s exportSTL["", 'victim', FALSE], 1.0, 2.0))";
  EXPECT_EQ(session_.run("let volume = " + definition), "error: " + refusal);
  EXPECT_EQ(session_.run("let volume = fun(s: volume3d) 1.0"), "");
  EXPECT_EQ(session_.run("update volume := " + definition), "error: " + refusal);
  expect_untouched();
}

// They look at every definition of the database.
TEST_F(ForeignData, what_only_checks_definitions_changes_nothing) {
  for (const char* command :
       {"let count_them = fun(x: int) R feed R deletedirect count", "let Other = 1",
        R"(let name = fun(x: int) ifthenelse(R feed R deletedirect count = x, 'victim.csv', 'victim.csv'))",
        "let f = fun(x: int) importCSV('victim.csv') count"})
    ASSERT_EQ(session_.run(command), "") << command;
  for (const char* command :
       {"let_ Other = 2", "changename Other to Another", "delete Another", "save database to 'foreign/all'",
        "explain importCSV(name(3)) count",
        R"(explain importCSV(ifthenelse(R inserttuple[5] count = 1, 'victim.csv', 'victim.csv')) count)"}) {
    session_.run(command);
    EXPECT_EQ(session_.run("query R count"), "3") << command;
  }
  expect_untouched();
}

/// Parts of a saved file that read beside it, and the notes on them.
struct Reading {
  const char* objects;
  const char* told;
};

const Reading kReading[] = {
    {"(OBJECT T () text <file>victim</file---> ())", "files outside of its folder: '{}/victim'"},
    {"(OBJECT T () (rel (tuple ((A int) (B text)))) ((1 <file>foreign/near</file--->) (2 <file>victim</file--->)) ())",
     "files outside of its folder: '{}/victim'"},
    {"(OBJECT T () (rel (tuple ((A (arel (tuple ((B text)))))))) ((((<file>victim</file--->) "
     "(<file>victim.csv</file--->)))) ())",
     "files outside of its folder: '{0}/victim', '{0}/victim.csv'"},
    {"(OBJECT T () bytes <file>victim</file---> ())", "files outside of its folder: '{}/victim'"},
    {"(DERIVED T (const bytes value <file>victim</file--->))", "files outside of its folder: '{}/victim'"},
    {"(DERIVED T (importSTL 'victim'))", "files outside of its folder: '{}/victim'"},
    {"(DERIVED T (importOBJ 'foreign/../victim'))", "files outside of its folder: '{}/victim'"},
    {"(DERIVED T (importOFF 'foreign/link'))", "files outside of its folder: '{}/victim'"},
    {"(DERIVED T (checkSTL 'foreign/.hidden'))", "files outside of its folder: '{}/foreign/.hidden'"},
    {"(DERIVED T (importSurface 'victim'))", "files outside of its folder: '{}/victim'"},
    {"(DERIVED T (importMesh 'victim'))", "files outside of its folder: '{}/victim'"},
    {"(DERIVED T (count (repairReport 'victim')))", "files outside of its folder: '{}/victim'"},
    {"(DERIVED T (count (getDirectory '.')))", "files outside of its folder: '{}'"},
    {"(DERIVED T (count (importGeoJSON 'victim')))", "files outside of its folder: '{}/victim'"},
    {"(DERIVED T (count (importCSV 'victim.csv')))", "files outside of its folder: '{}/victim.csv'"},
    {"(DERIVED T (count (importCSV (+ 'vic' 'tim.csv'))))", "files outside of its folder: '{}/victim.csv'"},
    {"(DERIVED T (count (importJSON 'victim')))", "files outside of its folder: '{}/victim'"},
    {"(DERIVED T (const text value <file>victim</file--->))", "files outside of its folder: '{}/victim'"},
    {"(OBJECT f () (map text volume3d) (fun (t text) (importSTL t)) ()) (DERIVED T (f 'victim'))",
     "files outside of its folder: '{}/victim'"},
    {"(OBJECT T () string \"$(ALGEBRA3D_FOREIGN)\" ())", "environment variables: ALGEBRA3D_FOREIGN"},
    {"(DERIVED T (importSTL 'victim')) (DERIVED U (importSTL (+ 'x' (ifthenelse (isEmpty T) 'a' 'b'))))",
     "files outside of its folder: '{}/victim'; and what these objects read, which need the others and were not tried: "
     "U"},
    {"(DERIVED T (importSTL 'victim')) (DERIVED U (importSTL 'victim'))", "files outside of its folder: '{}/victim'"},
    {"(OBJECT T () text '$(ALGEBRA3D_FOREIGN)' ()) (DERIVED U (importSTL 'victim'))",
     "files outside of its folder: '{}/victim'; environment variables: ALGEBRA3D_FOREIGN"},
};

TEST_F(ForeignData, restore_reads_nothing_beside_without_leave) {
  write(foreign() / "near", "near");
  write(foreign() / ".hidden", "hidden");
  fs::create_symlink("../victim", foreign() / "link");
  const std::string folder = fs::canonical(folder_.path()).string();
  for (const Reading& each : kReading) {
    EXPECT_EQ(restore(each.objects),
              fmt::format("error: restore: nothing was restored, since 'foreign/list' would read {}; if it may, set "
                          "\"restoreReads\" = TRUE and restore it again",
                          fmt::format(fmt::runtime(each.told), folder)));
    EXPECT_EQ(session_.notes().find("is left out"), std::string::npos) << session_.notes();
    EXPECT_FALSE(fs::exists(folder_.path() / "new.db")) << each.objects;
    expect_untouched();
  }
}

TEST_F(ForeignData, restore_reads_with_leave_and_in_its_own_folder) {
  ASSERT_EQ(setenv("ALGEBRA3D_FOREIGN", "a value", 1), 0);
  write(foreign() / "near", "near");
  EXPECT_EQ(restore("(OBJECT T () text <file>foreign/near</file---> ())"), "");
  EXPECT_EQ(session_.run("query T"), "'bmVhcg=='");
  const char* variable =
      "(OBJECT T () string \"$(ALGEBRA3D_FOREIGN)\" ()) (DERIVED U (count (importCSV 'victim.csv')))";
  EXPECT_TRUE(restore(variable).starts_with("error: restore: nothing was restored"));
  EXPECT_EQ(session_.run("open database new"), "");
  EXPECT_EQ(session_.run("query T"), "'bmVhcg=='") << "the database is as it was";
  EXPECT_EQ(session_.run("set \"restoreReads\" = TRUE"), "");
  EXPECT_EQ(restore(variable), "");
  EXPECT_EQ(session_.run("query T"), "\"a value\"");
  EXPECT_EQ(session_.run("query U"), "2");
  unsetenv("ALGEBRA3D_FOREIGN");
}

// What `save` wrote itself has no variables.
TEST_F(ForeignData, own_saved_files_are_restored_as_ever) {
  for (const char* command : {"let Word = \"$(HOME)\"", "derive Size = R count", "save database to 'foreign/all'",
                              "save Word to 'foreign/word'", "close database",
                              "restore database new from 'foreign/all'", "restore Again from 'foreign/word'"})
    ASSERT_EQ(session_.run(command), "") << command;
  EXPECT_EQ(session_.run("query Again"), "\"$(HOME)\"");
  EXPECT_EQ(session_.run("query Size"), "3");
}

TEST_F(ForeignData, a_database_that_is_open_elsewhere_is_not_restored_over) {
  ASSERT_EQ(session_.run("save database to 'foreign/all'"), "");
  TestSession other(folder_.path());
  EXPECT_EQ(other.run("restore database own from 'foreign/all'"),
            fmt::format("error: {}/own.db: another session of this program has the database open; restore it when that "
                        "has closed it",
                        folder_.path().string()));
  EXPECT_EQ(session_.run("query R count"), "3");
  ASSERT_EQ(session_.run("close database"), "");
  EXPECT_EQ(other.run("restore database own from 'foreign/all'"), "");
  EXPECT_EQ(other.run("query R count"), "3");
}

}  // namespace
}  // namespace queries
