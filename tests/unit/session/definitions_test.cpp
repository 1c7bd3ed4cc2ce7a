// What a command says of the objects that it leaves without something that they need.
#include <fstream>

#include "unit/session/example_session.h"

namespace queries {
namespace {

class Definitions : public testing::Test {
 protected:
  Definitions() {
    for (const char* command :
         {"create database d", "open database d", "let R = intstream(1, 3) transformstream consume",
          "let ByElem = R createbtree[Elem]", "let Size = fun(x: int) R count + x", "derive Count = R count",
          "let Find = fun(x: int) ByElem R exactmatch[x] count", "type Number = int",
          "let Other = fun(R: int) R + [const Number value 1]"})
      EXPECT_EQ(session_.run(command), "") << command;
  }

  TestFolder folder_;
  TestSession session_{folder_.path()};
};

TEST_F(Definitions, delete_names_what_goes_and_what_is_left_without) {
  EXPECT_EQ(session_.run("delete R"), "");
  EXPECT_EQ(session_.notes(),
            "delete: its indexes are deleted, too: ByElem\n"
            "delete: these functions use it and fail from now on: Find, Size\n"
            "delete: these objects are derived from it; they keep their values, and `restore` will leave them out: "
            "Count\n");
  EXPECT_EQ(session_.run("query Size(1)"), "error: unknown name 'R'");
  EXPECT_EQ(session_.run("query Count"), "3");
}

TEST_F(Definitions, changename_names_what_keeps_the_old_name) {
  EXPECT_EQ(session_.run("changename R to S"), "");
  EXPECT_EQ(session_.notes(),
            "changename: these functions use it and fail from now on: Find, Size\n"
            "changename: these objects are derived from it; they keep their values, and `restore` will leave them out: "
            "Count\n");
}

TEST_F(Definitions, delete_type_names_the_functions_that_name_it) {
  EXPECT_EQ(session_.run("delete type Number"), "");
  EXPECT_EQ(session_.notes(), "delete type: these functions use it and fail from now on: Other\n");
}

TEST_F(Definitions, a_relation_that_is_replaced_loses_its_indexes) {
  EXPECT_EQ(session_.run("let_ R = R feed head[1] consume"), "");
  EXPECT_EQ(session_.notes(),
            "let_: its indexes are deleted, too: ByElem\n"
            "let_: these functions use it and fail from now on: Find\n");
  EXPECT_EQ(session_.run("query Size(1)"), "2");
}

TEST_F(Definitions, what_needs_it_at_second_hand_is_named_too) {
  for (const char* command :
       {"derive First = R feed consume", "derive Second = First count", "derive Third = Size(Second)",
        "let OfFirst = First createbtree[Elem]", "let g = fun(x: int) Size(x)", "let h = fun(x: int) Third + x",
        "let Own = Second + 1", "derive Fourth = h(1)"})
    EXPECT_EQ(session_.run(command), "") << command;
  EXPECT_EQ(session_.run("delete R"), "");
  EXPECT_EQ(session_.notes(),
            "delete: its indexes are deleted, too: ByElem\n"
            "delete: these functions use it and fail from now on: Find, Size, g\n"
            "delete: these objects are derived from it; they keep their values, and `restore` will leave them out: "
            "Count, First, Fourth, OfFirst, Second, Third\n");
  EXPECT_EQ(session_.run("save database to 'all'"), "");
  EXPECT_TRUE(session_.notes().starts_with(
      "save: these objects cannot be derived again, and `restore` will leave them out: Count, First, Fourth, OfFirst, "
      "Second, Third\nsave: 'Count' cannot be derived again: unknown name 'R'\n"))
      << session_.notes();
  EXPECT_EQ(session_.run("save Own to 'own'"), "");
  EXPECT_EQ(session_.notes(), "");
  EXPECT_EQ(session_.run("save Second to 'second'"), "");
  EXPECT_TRUE(session_.notes().ends_with("save: 'Second' cannot be derived again: unknown name 'First'\n"));
  EXPECT_EQ(session_.run("save Count to 'count'"), "");
  EXPECT_EQ(session_.run("delete Count"), "");
  EXPECT_EQ(session_.notes(), "");
  EXPECT_EQ(session_.run("restore Count from 'count'"),
            "error: restore: 'Count' cannot be derived again; nothing was restored");
  EXPECT_EQ(session_.run("query Count"), "error: unknown name 'Count'");
}

TEST_F(Definitions, a_restore_that_leaves_something_out_fails) {
  for (const char* command :
       {"derive Twice = Count * 2", "let Own = 1", "delete R", "save database to 'all'", "close database"})
    EXPECT_EQ(session_.run(command), "") << command;
  const std::string names = "Count, Twice";
  EXPECT_EQ(session_.run("restore database d from 'all'"),
            "error: restore: nothing was changed, since these objects cannot be derived again, and the existing "
            "database would lose those that it has: " +
                names + "; delete it first, or restore under another name");
  EXPECT_EQ(session_.run("open database d"), "");
  EXPECT_EQ(session_.run("query Twice"), "6");
  EXPECT_EQ(session_.run("close database"), "");
  for (const char* name : {"new", "empty"}) {
    if (name == std::string("empty")) {
      EXPECT_EQ(session_.run("create database empty"), "");
    }
    EXPECT_EQ(session_.run(fmt::format("restore database {} from 'all'", name)),
              fmt::format("error: restore: the database '{}' was restored and is open, without these objects, which "
                          "cannot be derived again: {}",
                          name, names));
    EXPECT_EQ(session_.run("query Own"), "1");
    EXPECT_EQ(session_.run("query Twice"), "error: unknown name 'Twice'");
    EXPECT_EQ(session_.run("close database"), "");
  }
}

// A file is needed as an object is.
TEST_F(Definitions, what_was_made_of_a_file_that_is_gone_is_left_out) {
  const std::filesystem::path table = folder_.path() / "table.csv";
  const std::filesystem::path stated = folder_.path() / "stated.csv";
  for (const auto& file : {table, stated}) std::ofstream(file) << "A\n1\n2\n";
  for (const char* command :
       {"derive Table = importCSV('table.csv') consume", "derive Rows = Table count",
        "derive Stated = importCSV('stated.csv', [const rel(tuple([A: int])) value ()]) consume", "let Own = 1"})
    EXPECT_EQ(session_.run(command), "") << command;
  std::filesystem::remove(table);
  std::ofstream(stated) << "A\n1\nx\n";
  EXPECT_EQ(session_.run("save database to 'all'"), "");
  EXPECT_TRUE(session_.notes().starts_with(
      "save: these objects cannot be derived again, and `restore` will leave them out: Rows, Table\n"))
      << session_.notes();
  EXPECT_EQ(session_.run("close database"), "");
  EXPECT_EQ(session_.run("restore database new from 'all'"),
            "error: restore: the database 'new' was restored and is open, without these objects, which cannot be "
            "derived again: Rows, Stated, Table");
  EXPECT_NE(session_.notes().find("restore: 'Stated' is left out, it cannot be derived again: importCSV: stated.csv "
                                  "line 3, column A: "),
            std::string::npos)
      << session_.notes();
  EXPECT_EQ(session_.run("query Own + Count"), "4");
}

TEST_F(Definitions, what_had_a_value_and_is_undefined_at_restore_is_left_out) {
  const std::filesystem::path part = folder_.path() / "part.off";
  for (const char* command :
       {"query createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1)) exportOFF['part.off', TRUE]",
        "derive Part = importOFF('part.off')", "derive Big = volume(Part)", "derive Gone = importOFF('gone.off')",
        "derive NoSize = volume(Gone)"})
    EXPECT_TRUE(!session_.run(command).starts_with("error")) << command;
  std::filesystem::remove(part);
  for (const char* command : {"save database to 'all'", "save Part to 'part'", "close database"})
    EXPECT_EQ(session_.run(command), "") << command;
  EXPECT_EQ(session_.run("restore database d from 'all'"),
            "error: restore: nothing was changed, since these objects cannot be derived again, and the existing "
            "database would lose those that it has: Big, Part; delete it first, or restore under another name");
  EXPECT_EQ(session_.run("open database d"), "");
  EXPECT_EQ(session_.run("query Big"), "1.0");
  EXPECT_EQ(session_.run("restore Again from 'part'"),
            "error: restore: 'Again' cannot be derived again; nothing was restored");
  EXPECT_EQ(session_.run("close database"), "");
  EXPECT_EQ(session_.run("restore database new from 'all'"),
            "error: restore: the database 'new' was restored and is open, without these objects, which cannot be "
            "derived again: Big, Part");
  EXPECT_NE(session_.notes().find("restore: 'Part' is left out, it cannot be derived again: it had a value when it was "
                                  "saved and is undefined now\n"),
            std::string::npos)
      << session_.notes();
  EXPECT_EQ(session_.run("query NoSize"), "undefined");
}

TEST_F(Definitions, a_relation_of_another_type_is_noticed) {
  EXPECT_EQ(session_.run("derive Sum = R feed sum[Elem]"), "");
  EXPECT_EQ(session_.run("let_ R = R feed projectextend[; Other: .Elem] consume"), "");
  EXPECT_EQ(
      session_.notes(),
      "let_: its indexes are deleted, too: ByElem\n"
      "let_: these functions use it and fail from now on: Find\n"
      "let_: these objects are derived from it; they keep their values, and `restore` will leave them out: Sum\n");
}

TEST_F(Definitions, what_nothing_needs_goes_without_a_word) {
  EXPECT_EQ(session_.run("delete Count"), "");
  EXPECT_EQ(session_.notes(), "");
}

std::string sum_of(std::size_t count) {
  std::string sum = "1";
  while (--count > 0) sum += "+1";
  return sum;
}

// What is stored can be evaluated, saved and restored: one limit, met when the object is made.
TEST_F(Definitions, the_highest_expression_that_is_stored_is_read_again) {
  const std::string highest = "let Highest = fun(x: int) " + sum_of(399);
  EXPECT_EQ(session_.run(highest + " + 1"),
            "error: the expression is more than 400 levels high (brackets, or operators in a row); split it with let");
  EXPECT_EQ(session_.run(highest), "");
  EXPECT_EQ(session_.run("derive High = Highest(2) + " + sum_of(398)), "");
  EXPECT_EQ(session_.run("query Highest(1) + High"), std::to_string(399 + 399 + 398));
  EXPECT_EQ(session_.run("save Highest to 'highest.txt'"), "");
  EXPECT_EQ(session_.run("restore Again from 'highest.txt'"), "");
  EXPECT_EQ(session_.run("query Again(1)"), "399");
  EXPECT_EQ(session_.run("save database to 'all.txt'"), "");
  EXPECT_EQ(session_.run("close database"), "");
  EXPECT_EQ(session_.run("restore database e from 'all.txt'"), "");
  EXPECT_EQ(session_.run("query Highest(1) + High"), std::to_string(399 + 399 + 398));
}

}  // namespace
}  // namespace queries
