#include "algebra3d/operators/registry/syntax_pattern.h"

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

using Shape = SyntaxPattern::Shape;
using PlaceKind = SyntaxPattern::PlaceKind;

SyntaxPattern parsed(std::string_view text) {
  auto pattern = SyntaxPattern::parse(text);
  EXPECT_TRUE(pattern.ok()) << text;
  return pattern.ok() ? *pattern : SyntaxPattern{};
}

TEST(SyntaxPattern, prefix) {
  const SyntaxPattern pattern = parsed("makeVector3D(_, _ ...)");
  EXPECT_EQ(pattern.shape, Shape::prefix);
  EXPECT_EQ(pattern.name, "makeVector3D");
  EXPECT_EQ(pattern.place_count(), 2U);
  EXPECT_TRUE(pattern.is_open_ended);
}

TEST(SyntaxPattern, infix_and_postfix) {
  EXPECT_EQ(parsed("_ + _").shape, Shape::infix);
  EXPECT_EQ(parsed("_ union _").name, "union");
  const SyntaxPattern product = parsed("_ _ product");
  EXPECT_EQ(product.shape, Shape::postfix);
  EXPECT_EQ(product.operand_count, 2U);
  EXPECT_FALSE(product.has_brackets);
}

TEST(SyntaxPattern, brackets_with_functions_and_lists) {
  const SyntaxPattern pattern = parsed("_ groupby[attributes; functions(GROUP)]");
  ASSERT_EQ(pattern.places.size(), 2U);
  EXPECT_EQ(pattern.places[0].kind, PlaceKind::attributes);
  EXPECT_EQ(pattern.places[1].kind, PlaceKind::functions);
  EXPECT_EQ(pattern.places[1].before, ';');
  EXPECT_EQ(pattern.places[1].parameters, std::vector<std::string>{"GROUP"});
  EXPECT_EQ(parsed("_ _ symmjoin[fun(TUPLE, TUPLE2)]").places[0].parameters.size(), 2U);
}

TEST(SyntaxPattern, refuses_what_it_does_not_know) {
  for (const char* text : {"", "_", "op", "op(", "op(x)", "_ op[", "_ op[_", "_ op[_]]", "_ op _ _"})
    EXPECT_FALSE(SyntaxPattern::parse(text).ok()) << text;
}

}  // namespace
}  // namespace algebra3d
