#include "queries/test_runner/detail/comparison.h"

#include <gtest/gtest.h>

#include "unit/test_runner/nested_text.h"

namespace queries {
namespace {

std::string difference(const std::string& expected, const std::string& found, Tolerance tolerance = {}) {
  const auto result = first_difference(list(expected), list(found), tolerance);
  return result ? result->text() : "";
}

TEST(Comparison, equal_lists_do_not_differ) {
  for (const char* text : {"()", "5", "(int 3)", "(a \"a\" 'a' (TRUE 1.5 -7))"}) EXPECT_EQ(difference(text, text), "");
}

TEST(Comparison, atoms_of_different_kinds_differ) {
  EXPECT_EQ(difference("(1 2)", "(1 \"2\")"), "at /2: expected 2, found \"2\"");
  EXPECT_EQ(difference("(a \"x\")", "(a 'x')"), "at /2: expected \"x\", found 'x'");
  EXPECT_EQ(difference("a", "b"), "expected a, found b");
  EXPECT_EQ(difference("(a)", "a"), "expected (a), found a");
}

TEST(Comparison, numbers_are_compared_by_value) {
  EXPECT_EQ(difference("(real 1)", "(real 1.0)"), "");
  EXPECT_EQ(difference("(int 1.0)", "(int 1)"), "");
  EXPECT_EQ(difference("(2 (3 -4))", "(2.0 (3.0 -4.0))"), "");
  EXPECT_EQ(difference("(real 1)", "(real 1.5)"), "at /2: expected 1, found 1.5");
  EXPECT_EQ(difference("(real 1)", "(real 1.5)", {1, false}), "");
  EXPECT_EQ(difference("(int 1)", "(int 2)", {5, false}), "at /2: expected 1, found 2");
  EXPECT_EQ(difference("(int 1)", "(real 1.0)"), "at /1: expected int, found real");
}

TEST(Comparison, the_first_difference_has_its_path) {
  EXPECT_EQ(difference("(rel ((1 2) (3 4)))", "(rel ((1 2) (3 5)))"), "at /2/2/2: expected 4, found 5");
  EXPECT_EQ(difference("((1 2) (3 4))", "((1 9) (3 8))"), "at /1/2: expected 2, found 9");
}

TEST(Comparison, lists_of_different_length_differ_after_what_they_share) {
  EXPECT_EQ(difference("(a (1 2 3))", "(a (1 2))"), "at /2: expected 3 elements, found 2");
  EXPECT_EQ(difference("(a (1 2 3))", "(a (1 7))"), "at /2/2: expected 2, found 7");
  EXPECT_EQ(difference("()", "(1)"), "expected 0 elements, found 1");
}

TEST(Comparison, absolute_tolerance_excludes_its_bound) {
  const Tolerance half{0.5, false};
  EXPECT_EQ(difference("1.0", "1.25", half), "");
  EXPECT_NE(difference("1.0", "1.5", half), "");
  EXPECT_EQ(difference("1", "1.25", half), "");
  EXPECT_NE(difference("1", "1.5", half), "");
}

TEST(Comparison, relative_tolerance_is_of_the_expected_magnitude) {
  const Tolerance tenth{0.1, true};
  EXPECT_TRUE(tenth.accepts(-100, -109));
  EXPECT_FALSE(tenth.accepts(-100, -111));
  EXPECT_FALSE(tenth.accepts(0, 1e-300));
  EXPECT_TRUE(tenth.accepts(0, 0));
}

TEST(Comparison, relative_tolerance_has_a_floor) {
  const Tolerance tiny{1e-30, true};
  EXPECT_TRUE(tiny.accepts(1.0, 1.0000000000000002));
  EXPECT_FALSE(tiny.accepts(1.0, 1.0000000000000013));
  EXPECT_FALSE((Tolerance{0, true}.accepts(1.0, 1.0000000000000002)));
}

TEST(Comparison, tolerances_are_read) {
  EXPECT_EQ(Tolerance::parse("0.25")->value, 0.25);
  EXPECT_FALSE(Tolerance::parse("0.25")->is_relative);
  EXPECT_EQ(Tolerance::parse("%50")->value, 0.5);
  EXPECT_TRUE(Tolerance::parse("%50")->is_relative);
  for (const char* text : {"", "x", "-1", "%", "%-2", "1%"}) EXPECT_FALSE(Tolerance::parse(text).has_value()) << text;
}

TEST(Comparison, short_lists_are_shown_whole) {
  EXPECT_EQ(excerpt(list("(int (1 2))"), {1, 0}), "(int (1 2))");
}

TEST(Comparison, of_long_lists_the_neighbourhood_is_shown) {
  std::string rows;
  for (int row = 0; row < 1000; ++row) rows += fmt::format("({} \"row\") ", row);
  const NestedList relation = list("((rel) (" + rows + "))");
  EXPECT_EQ(excerpt(relation, {1, 517, 0}), "at /2/518: (517 \"row\")");
  EXPECT_EQ(excerpt(relation, {1, 517}), "at /2: (... (516 \"row\") (517 \"row\") (518 \"row\") ...)");
  EXPECT_TRUE(excerpt(relation, {1}).starts_with("((rel) ((0 \"row\") (1 \"row\")"));
  EXPECT_LT(excerpt(relation, {1}).size(), 310U);
}

TEST(Comparison, a_place_beyond_the_end_shows_the_end) {
  std::string numbers;
  for (int i = 0; i < 500; ++i) numbers += std::to_string(i) + " ";
  EXPECT_EQ(excerpt(list("(" + numbers + ")"), {900}), "(... 499)");
}

TEST(Comparison, a_long_atom_is_cut) {
  const std::string shown = excerpt(list("\"" + std::string(10000, 'x') + "\""), {});
  EXPECT_LT(shown.size(), 400U);
}

TEST(Comparison, tuples_are_sorted_by_their_text) {
  EXPECT_EQ(with_sorted_tuples(list("(T ((2) (10) (1)))")), list("(T ((1) (10) (2)))"));
  EXPECT_EQ(with_sorted_tuples(list("(int 3)")), list("(int 3)"));
}

}  // namespace
}  // namespace queries
