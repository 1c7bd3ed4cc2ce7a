#include "algebra3d/values/types/type_expr.h"

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

Result<TypeExpr> read(std::string_view text) {
  auto list = NestedList::parse(text);
  EXPECT_TRUE(list.ok()) << text;
  return TypeExpr::from_nested(*list);
}

TEST(type_expr, reads_what_it_prints) {
  for (const char* text :
       {"int", "volume3d", "(stream real)", "(map int bool)", "(map bool)",
        "(rel (tuple ((Name string) (Vol volume3d))))", "(stream (tuple ((A int))))", "(tuple ())",
        "(rtree3 (tuple ((Name string) (Vol volume3d))) volume3d FALSE)", "(set (vector (array TRUE)))"}) {
    const auto type = read(text);
    ASSERT_TRUE(type.ok()) << text << ": " << type.error().text();
    EXPECT_EQ(type->text(), text);
    EXPECT_EQ(type->to_nested(), *NestedList::parse(text));
  }
}

TEST(type_expr, builders_give_the_same_terms_as_text) {
  const auto tuple = TypeExpr::tuple({{"Name", "string"}, {"Vol", "volume3d"}});
  EXPECT_EQ(TypeExpr::rel(tuple), *read("(rel (tuple ((Name string) (Vol volume3d))))"));
  EXPECT_EQ(TypeExpr::stream("real"), *read("(stream real)"));
  EXPECT_EQ(TypeExpr::map({"int", "real"}, "bool"), *read("(map int real bool)"));
  EXPECT_EQ(TypeExpr("rtree3", {tuple, "volume3d", "FALSE"}),
            *read("(rtree3 (tuple ((Name string) (Vol volume3d))) volume3d FALSE)"));
}

TEST(type_expr, knows_the_shapes_that_matter) {
  const auto relation = *read("(rel (tuple ((A int) (B real))))");
  EXPECT_TRUE(relation.is_relation());
  EXPECT_TRUE(relation.element().is_tuple());
  EXPECT_EQ(relation.element().attributes()[1].name, "B");
  EXPECT_FALSE(relation.is_stream());
  const auto tuples = TypeExpr::stream(relation.element());
  EXPECT_TRUE(tuples.is_tuple_stream());
  EXPECT_TRUE(TypeExpr::stream("int").is_stream());
  EXPECT_FALSE(TypeExpr::stream("int").is_tuple_stream());
  EXPECT_FALSE(TypeExpr("rel", {"int"}).is_relation());
  const auto function = *read("(map int real bool)");
  EXPECT_TRUE(function.is_function());
  EXPECT_EQ(function.function_result(), TypeExpr("bool"));
  EXPECT_EQ(function.function_parameters(), (std::vector<TypeExpr>{"int", "real"}));
  EXPECT_TRUE(TypeExpr::map({}, "int").function_parameters().empty());
}

TEST(type_expr, equality_is_structural) {
  EXPECT_EQ(TypeExpr(), TypeExpr(""));
  EXPECT_FALSE(TypeExpr("int") == TypeExpr("real"));
  EXPECT_FALSE(TypeExpr::stream("int") == TypeExpr::stream("real"));
  EXPECT_FALSE(TypeExpr::tuple({{"A", "int"}}) == TypeExpr::tuple({{"B", "int"}}));
  EXPECT_FALSE(TypeExpr::tuple({{"A", "int"}}) == TypeExpr::tuple({{"A", "real"}}));
  EXPECT_EQ(TypeExpr::tuple({{"A", TypeExpr::stream("int")}}), TypeExpr::tuple({{"A", TypeExpr::stream("int")}}));
}

TEST(type_expr, what_is_no_type_is_named) {
  const auto error_of = [](std::string_view text) {
    const auto type = read(text);
    return type.ok() ? "no error" : std::string(describe(type.error().code).name) + ": " + type.error().text();
  };
  EXPECT_EQ(error_of("5"), "invalid_value: type: expected a name or (constructor type ...), got 5");
  EXPECT_EQ(error_of("()"), "invalid_value: type: expected a name or (constructor type ...), got ()");
  EXPECT_EQ(error_of("(int)"), "invalid_value: type: expected a name or (constructor type ...), got (int)");
  EXPECT_EQ(error_of("(stream 1/3)"), "invalid_value: type: expected a name or (constructor type ...), got 1/3");
  EXPECT_EQ(error_of("(stream \"int\")"),
            "invalid_value: type: expected a name or (constructor type ...), got \"int\"");
  EXPECT_EQ(error_of("(+ int)"), "invalid_value: type: expected a name or (constructor type ...), got (+ int)");
  EXPECT_EQ(error_of("(rel tuple)"), "invalid_value: type: expected (tuple ((Name type) ...)), got tuple");
  EXPECT_EQ(error_of("(tuple int)"), "invalid_value: type: expected (tuple ((Name type) ...)), got (tuple int)");
  EXPECT_EQ(error_of("(tuple ((A int)) ())"),
            "invalid_value: type: expected (tuple ((Name type) ...)), got (tuple ((A int)) ())");
  EXPECT_EQ(error_of("(rel (tuple ((A))))"), "invalid_value: type: expected an attribute (Name type), got (A)");
  EXPECT_EQ(error_of("(tuple ((1 int)))"), "invalid_value: type: expected an attribute (Name type), got (1 int)");
}

}  // namespace
}  // namespace algebra3d
