#include "queries/shell/detail/inquiry_text.h"

#include <gtest/gtest.h>

#include "queries/shell/detail/table.h"

namespace queries {
namespace {

using algebra3d::NestedList;

std::string shown(std::string_view list, std::size_t columns = 80) {
  return inquiry_text(NestedList::parse(list).value(), columns);
}

TEST(InquiryText, objects_are_a_table_of_names_and_types) {
  EXPECT_EQ(shown("(inquiry (objects (OBJECTS (OBJECT n () ((int))) "
                  "(OBJECT Parts () ((rel (tuple ((Name string) (Solid volume3d)))))))))"),
            "Name  | Type\n"
            "------+---------------------------------\n"
            "n     | int\n"
            "Parts | rel: Name string, Solid volume3d\n");
  EXPECT_EQ(shown("(inquiry (objects (OBJECTS)))"), "no objects\n");
}

TEST(InquiryText, named_types_are_a_table) {
  EXPECT_EQ(shown("(inquiry (types (TYPES (TYPE count int))))"), "Name  | Type\n------+-----\ncount | int\n");
  EXPECT_EQ(shown("(inquiry (types (TYPES)))"), "no named types\n");
}

TEST(InquiryText, a_plan_is_an_indented_tree) {
  EXPECT_EQ(shown("(inquiry (plan ((0 count 'x' 1 0 2.25 -1 '') (1 feed 'y' 1 7 0.5 8 'by the index I'))))"),
            "Operator | Signature | Estimate | Calls | Tuples |  ms\n"
            "---------+-----------+----------+-------+--------+----\n"
            "count    | x         |          |     1 |        | 2.2\n"
            "  feed   | y         |        8 |     1 |      7 | 0.5\n"
            "feed: by the index I\n");
}

TEST(InquiryText, findings_and_names_stand_one_per_line) {
  EXPECT_EQ(shown("(inquiry (findings ((\"Parts\" 3 \"Solid\" 'damaged') (\"\" 0 \"\" 'a page is lost'))))"),
            "Parts: tuple 3: 'Solid': damaged\na page is lost\n");
  EXPECT_EQ(shown("(inquiry (findings ()))"), "no findings\n");
  EXPECT_EQ(shown("(inquiry (databases (a b)))"), "a\nb\n");
  EXPECT_EQ(shown("(inquiry (databases ()))"), "no databases\n");
}

TEST(InquiryText, operators_show_syntax_and_meaning_cut_to_the_screen) {
  EXPECT_EQ(shown("(inquiry (operators ((volume ('a -> b') 'volume(_)' 'Enclosed volume of a solid.'))))", 30),
            "Operator  | Meaning\n"
            "----------+-------------------\n"
            "volume(_) | Enclosed volume o…\n"
            "`help NAME` shows signatures and examples.\n");
}

TEST(OneLine, is_one_line_without_control_characters_and_never_endless) {
  EXPECT_EQ(one_line("a\nb\tc\x1b"), "a b c\\x1b");
  EXPECT_LT(one_line(std::string(1000000, 'x')).size(), 2000U);
}

}  // namespace
}  // namespace queries
