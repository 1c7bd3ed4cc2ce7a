// The nested-list form of an expression and its reader are inverse to each other: asked of the examples of all
// operators.
#include "queries/language/nested_reader.h"

#include <gtest/gtest.h>

#include "queries/language/example_queries.h"
#include "unit/language/language_samples.h"

namespace queries {
namespace {

std::string nested_of(const std::string& text) {
  const auto expression = parse_expression(text, full_registry());
  return expression ? to_nested(**expression).print() : "error " + expression.error().text();
}

// From the printed list back to a tree, and to a list again.
std::string read_and_written(const std::string& nested) {
  const auto list = NestedList::parse(nested);
  if (!list) return "error " + list.error().text();
  const auto expression = NestedReader(full_registry(), {"", 1, 1}).expression(*list);
  return expression ? to_nested(**expression).print() : "error " + expression.error().text();
}

TEST(NestedReader, reads_what_was_written_for_every_example) {
  std::size_t count = 0;
  for (const algebra3d::Operator* op : full_registry().operators())
    for (const auto& example : example_queries(full_registry(), *op)) {
      const std::string text = example.query.starts_with("query ") ? example.query.substr(6) : example.query;
      const std::string nested = nested_of(text);
      ASSERT_FALSE(nested.starts_with("error")) << text << ": " << nested;
      EXPECT_EQ(read_and_written(nested), nested) << text;
      ++count;
    }
  EXPECT_GT(count, 200);
}

TEST(NestedReader, forms_of_language_3_3) {
  EXPECT_EQ(nested_of("r filter[.A > 3]"), "(filter r (> (attr tuple1 A) 3))");
  for (const char* nested : {
           "(op_call 1 2)",
           "(filter (feed r) (fun (t TUPLE) (> (attr t A) 3)))",
           "(project s (A B))",
           "(sortby s ((A asc) (B desc)))",
           "(extend s ((X (fun (t TUPLE) (* (attr t A) 2)))))",
           "(groupby s (A) ((N (count tuple1))))",
           "(const (rel (tuple ((A int)))) value ((1) (2)))",
           "(fun (a int) (b int) (+ a b))",
           "(translate v (const vector3d value (1 0 0)))",
       })
    EXPECT_EQ(read_and_written(nested), nested);
}

TEST(NestedReader, other_spellings_are_accepted) {
  EXPECT_EQ(read_and_written("(translate v ((vector3d (1 0 0))))"), "(translate v (const vector3d value (1 0 0)))");
  EXPECT_EQ(read_and_written("(translate v (w))"), "(translate v w)");
  EXPECT_EQ(read_and_written("((rel (tuple ((A int)))) ((1)))"), "(const (rel (tuple ((A int)))) value ((1)))");
  EXPECT_EQ(read_and_written("(sortby s (A (B desc)))"), "(sortby s ((A asc) (B desc)))");
}

TEST(NestedReader, names_of_operators_are_names_but_at_the_head_of_a_list) {
  for (const char* nested :
       {"(+ area 1)", "(count count)", "(fun (union int) (union union union))", "(project count (area))",
        "(extend s ((count (fun (feed TUPLE) (attr feed count)))))", "(translate v area)"})
    EXPECT_EQ(read_and_written(nested), nested);
}

TEST(NestedReader, arguments_of_an_operator_may_be_those_of_a_function_of_its_name) {
  for (const char* nested : {"(project s 5)", "(extend (+ 1 2) (+ 1 2))", "(sum s (+ 1 2))", "(renameAttr s \"x\")",
                             "(groupby s (now) 1.5)"})
    EXPECT_EQ(read_and_written(nested), nested);
}

TEST(NestedReader, errors_say_what_was_expected) {
  EXPECT_EQ(read_and_written("()"), "error expected an expression, found ()");
  EXPECT_EQ(read_and_written("(1 2)"),
            "error expected an operator, a function or a type as the first element of a list, found (1 2)");
  EXPECT_EQ(read_and_written("(project s ())"), "(project s ())");
  EXPECT_EQ(read_and_written("(project s let)"), "error expected project: a list of attribute names, found let");
  EXPECT_EQ(read_and_written("(fun (x) x)"), "error expected (parameter type), found (x)");
  EXPECT_EQ(read_and_written("(+ let 1)"), "error expected an operand, found 'let', a word of the language");
}

// A stored function once held more levels than could be read back.
TEST(NestedReader, trees_may_be_as_high_as_those_of_texts) {
  const auto sum_of_height = [](int height) {
    std::string sum = "1";
    for (int level = 1; level < height; ++level) sum = "(+ 1 " + sum + ")";
    return sum;
  };
  EXPECT_EQ(read_and_written(sum_of_height(400)), sum_of_height(400));
  const std::string refused =
      "error the expression is more than 400 levels high (brackets, or operators in a row); split it with let";
  EXPECT_EQ(read_and_written(sum_of_height(401)), refused);
  EXPECT_EQ(read_and_written(sum_of_height(1000)), refused);
}

}  // namespace
}  // namespace queries
