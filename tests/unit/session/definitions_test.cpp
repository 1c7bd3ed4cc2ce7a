// What a command says of the objects that it leaves without something that they need.
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

TEST_F(Definitions, what_nothing_needs_goes_without_a_word) {
  EXPECT_EQ(session_.run("delete Count"), "");
  EXPECT_EQ(session_.notes(), "");
}

}  // namespace
}  // namespace queries
