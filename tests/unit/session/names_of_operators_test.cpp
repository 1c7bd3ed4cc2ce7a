// A database of a version that did not know the operators sqrt, pow, round, distance, top, ... opens in one that does,
// and everything in it still means the same. tests/regression/data/names holds it, as a file and as a saved list.
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "queries/language/example_queries.h"
#include "queries/streams/stream_operator.h"
#include "unit/session/example_session.h"

namespace queries {
namespace {

double negative(double x) {
  return -x;
}
double negative_product(double x, double y) {
  return -x * y;
}

void add_missing(algebra3d::Registry& registry, algebra3d::Operator op) {
  if (registry.find_operator(op.name) == nullptr) registry.add(std::move(op));
}

void add_function(algebra3d::Registry& registry, const std::string& name) {
  algebra3d::Operator op;
  op.name = name;
  op.syntax = name + "(_ ...)";
  op.overloads = {algebra3d::overload<&negative>("x"), algebra3d::overload<&negative_product>("x", "y")};
  add_missing(registry, std::move(op));
}

void add_stream_operator(algebra3d::Registry& registry, const std::string& name, const std::string& syntax) {
  algebra3d::Operator op;
  op.name = name;
  op.syntax = syntax;
  op.stream = stream_operator([name](std::span<const ArgumentType>) -> Result<BoundOperator> {
    return algebra3d::Error{algebra3d::ErrorCode::type_error, "the operator {} is meant", name};
  });
  add_missing(registry, std::move(op));
}

/// The operators that there are, and those that a later version may have.
const algebra3d::Registry& later_registry() {
  static algebra3d::Registry& registry = *[] {
    auto* made = new algebra3d::Registry(algebra3d::make_registry());
    register_stream_operators(*made);
    for (const char* name : {"sqrt", "pow", "round", "floor", "ceil", "sin", "cos", "tan", "abs", "radians", "twice"})
      add_function(*made, name);
    add_stream_operator(*made, "distance", "_ distance _");
    add_stream_operator(*made, "top", "_ top[attribute]");
    add_stream_operator(*made, "relation", "_ relation[attributes]");
    add_stream_operator(*made, "floor_sqrt", "_ floor_sqrt");
    add_stream_operator(*made, "rduph", "_ rduph");
    add_stream_operator(*made, "feedproject", "_ feedproject[attributes]");
    return made;
  }();
  return registry;
}

class NamesOfOperators : public testing::Test {
 protected:
  static std::filesystem::path data(const std::string& name) {
    return std::filesystem::path(ALGEBRA3D_SOURCE) / "tests/regression/data/names" / name;
  }
  void open() {
    copy_file(data("names_of_operators.db"), folder_.path() / "names_of_operators.db");
    ASSERT_EQ(session_.run("open database names_of_operators"), "");
  }
  // The values that the version which made the database gave.
  void expect_the_old_answers() {
    const std::string rows = R"(((2 1.5 "two") (3 2.5 "three")))";
    for (const auto& [query, answer] : std::initializer_list<std::pair<const char*, std::string>>{
             {"query round", "3"},
             {"query ceil(5)", "22.0"},
             {"query twice(4)", "7"},
             {"query relation(1)", "2"},
             {"query sqrt(1.5)", "2.25"},
             {"query sin", rows},
             {"query cos", "5.25"},
             {"query tan", "2"},
             {"query floor_sqrt floor exactmatch[2] consume", R"(((2 1.5 "two")))"},
             {"query floor feed filter[.sqrt > distance(round, 2)] consume", rows},
             {"query floor feed extend[round: .abs * round] extract[round]", "1.5"},
             {"query rduph feed floor feed {f} product count", "9"},
             {"query size(feedproject)", "12"},
             {"query [const radians value 2.5]", "2.5"},
             {"(query (ceil 5))", "22.0"},
             {"query ceil", "(fun (n int) (+ (distance n round) (pow 2.0 n)))"},
             {"query relation", "(fun (n int) (top floor (+ n 1)))"},
         })
      EXPECT_EQ(session_.run(query), answer) << query;
  }

  TestFolder folder_;
  TestSession session_{folder_.path(), later_registry()};
};

TEST_F(NamesOfOperators, a_database_of_before_opens_and_works) {
  open();
  expect_the_old_answers();
}

TEST_F(NamesOfOperators, a_saved_list_of_before_is_restored) {
  EXPECT_EQ(session_.run("restore database new from '" + data("names_of_operators.list").string() + "'"), "");
  EXPECT_EQ(session_.notes(), "");
  expect_the_old_answers();
}

TEST_F(NamesOfOperators, save_and_restore_give_the_same_again) {
  open();
  EXPECT_EQ(session_.run("save database to 'saved.list'"), "");
  EXPECT_EQ(session_.run("close database"), "");
  EXPECT_EQ(session_.run("restore database again from 'saved.list'"), "");
  EXPECT_EQ(session_.notes(), "");
  expect_the_old_answers();
  EXPECT_EQ(session_.run("save sqrt to 'sqrt.list'"), "");
  EXPECT_EQ(session_.run("delete sqrt"), "");
  EXPECT_EQ(session_.run("restore sqrt from 'sqrt.list'"), "");
  expect_the_old_answers();
}

TEST_F(NamesOfOperators, a_call_that_does_not_fit_the_function_is_the_operators) {
  open();
  EXPECT_EQ(session_.run("query sqrt(2.0, 3.0)"), "error: sqrt: expected (real), got (real real)");
  EXPECT_EQ(session_.run("query twice(2.0, 3.0)"), "-6.0");
  EXPECT_EQ(session_.run("query `twice`(2.0, 3.0)"), "error: twice: expected (int) arguments, got 2");
  EXPECT_EQ(session_.run("query 5 floor_sqrt"), "error: the operator floor_sqrt is meant");
  EXPECT_EQ(session_.run("query floor top[sqrt]"), "error: the operator top is meant");
  EXPECT_EQ(session_.run("(query (floor_sqrt round))"), "error: the operator floor_sqrt is meant");
}

TEST_F(NamesOfOperators, objects_are_renamed_and_deleted_and_what_used_them_is_named) {
  open();
  EXPECT_EQ(session_.run("changename sqrt to square"), "");
  EXPECT_EQ(session_.notes(),
            "changename: these functions use it and fail from now on: pow\n"
            "changename: these objects are derived from it; they keep their values, and `restore` will leave them out: "
            "cos\n");
  EXPECT_EQ(session_.run("query square(3.0)"), "9.0");
  EXPECT_EQ(session_.run("query sqrt(3.0)"), "1.7320508075688772");
  EXPECT_EQ(session_.run("changename square to sqrt"), "");
  EXPECT_EQ(session_.run("changename twice to double"), "");
  EXPECT_EQ(session_.run("query double(4)"), "7");
  EXPECT_EQ(session_.run("query twice(4.0)"), "-4.0");
  EXPECT_EQ(session_.run("delete top"), "");
  EXPECT_EQ(session_.notes(),
            "delete: these functions use it and fail from now on: relation\n"
            "delete: these objects are derived from it; they keep their values, and `restore` will leave them out: "
            "tan\n");
  EXPECT_EQ(session_.run("query relation(1)"), "error: expected top: a name, found (+ n 1)");
  EXPECT_EQ(session_.run("query round + floor count"), "6");
  EXPECT_EQ(session_.run("delete floor"), "");
  EXPECT_EQ(session_.run("query floor"),
            "error: there is no object 'floor'; the operator of that name is written floor(_)");
}

/// Whether the scanner takes it for a name.
bool is_word(const std::string& name) {
  return std::isalpha(static_cast<unsigned char>(name.front())) != 0;
}

// So no script breaks when an operator comes to a version: it may have used the name for an object or an attribute.
TEST_F(NamesOfOperators, every_operator_may_name_objects_and_attributes_and_still_works) {
  TestSession session(folder_.path(), test_registry());
  EXPECT_EQ(session.run("create database d"), "");
  EXPECT_EQ(session.run("open database d"), "");
  for (const std::string& command : example_objects()) EXPECT_EQ(session.run(command), "");
  for (const algebra3d::Operator* op : test_registry().operators()) {
    if (!is_word(op->name)) continue;
    const std::string& name = op->name;
    EXPECT_EQ(session.run("let " + name + " = 7"), "") << name;
    EXPECT_EQ(session.run("query " + name + " + 1"), "8") << name;
    const std::string rows = "[const rel(tuple([" + name + ": int])) value ((5) (6))]";
    EXPECT_EQ(session.run("query " + rows + " feed filter[." + name + " > 5] project[" + name + "] consume"), "((6))");
    EXPECT_EQ(session.run("query " + rows + " feed sum[" + name + "]"), "11") << name;
  }
  for (const algebra3d::Operator* op : test_registry().operators())
    for (const auto& [query, result] : example_queries(test_registry(), *op)) {
      EXPECT_EQ(session.run("begin transaction"), "");
      EXPECT_EQ(session.run("query " + query), result) << query;
      EXPECT_EQ(session.run("abort transaction"), "");
    }
}

TEST_F(NamesOfOperators, a_new_function_says_which_calls_it_takes) {
  EXPECT_EQ(session_.run("create database d"), "");
  EXPECT_EQ(session_.run("open database d"), "");
  EXPECT_EQ(session_.run("let abs = fun(n: int) n + 1"), "");
  EXPECT_EQ(session_.notes(),
            "let: 'abs' is an operator, too; abs(...) is from now on a call of the function wherever its parameters "
            "take the arguments\n");
  EXPECT_EQ(session_.run("query abs(1)"), "2");
  EXPECT_EQ(session_.run("let f = fun(n: int) abs(abs(n))"), "");
  EXPECT_EQ(session_.run("query f(1)"), "3");
  // Nested calls that do not fit are checked once each.
  std::string nested = "TRUE";
  for (int level = 0; level < 150; ++level) nested = "abs(" + nested + ")";
  EXPECT_NE(session_.run("query " + nested).find("abs: expected"), std::string::npos);
}

}  // namespace
}  // namespace queries
