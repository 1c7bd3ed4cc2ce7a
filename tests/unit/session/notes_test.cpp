// Notes of statements, and integers in inquiries.
#include <regex>

#include "unit/session/example_session.h"

namespace queries {
namespace {

class Notes : public testing::Test {
 protected:
  Notes() {
    EXPECT_TRUE(session_.session().open_file(folder_.path() / "notes.db").ok());
    EXPECT_EQ(session_.run("let Shapes = [const rel(tuple([No: int, Shape: points3d])) value "
                           "((1 ()) (2 undefined) (3 ((0 0 0))) (4 undefined) (5 undefined))]"),
              "");
  }

  TestFolder folder_;
  TestSession session_{folder_.path()};
};

TEST_F(Notes, is_empty_counts_undefined_values_once_in_a_statement) {
  EXPECT_EQ(session_.run("query Shapes feed filter[isEmpty(.Shape)] count"), "4");
  EXPECT_EQ(session_.notes(), "isEmpty: 3 undefined values counted as empty\n");
  EXPECT_EQ(session_.run("query isEmpty([const volume3d value undefined])"), "TRUE");
  EXPECT_EQ(session_.notes(), "isEmpty: 1 undefined value counted as empty\n");
  EXPECT_EQ(session_.run("query Shapes feed Shapes feed {b} symmjoin[isEmpty(.Shape minus ..Shape_b)] count"), "24");
  EXPECT_EQ(session_.notes(), "isEmpty: 21 undefined values counted as empty\n");
  EXPECT_EQ(session_.run("query isEmpty([const volume3d value ()])"), "TRUE");
  EXPECT_EQ(session_.notes(), "");
}

TEST_F(Notes, what_is_not_evaluated_notes_nothing) {
  EXPECT_EQ(session_.run("query Shapes feed filter[isdefined(.Shape) and isEmpty(.Shape)] count"), "1");
  EXPECT_EQ(session_.notes(), "");
  EXPECT_EQ(session_.run("query Shapes feed filter[not(isdefined(.Shape)) or not(isEmpty(.Shape))] count"), "4");
  EXPECT_EQ(session_.notes(), "");
  // Also where the second operand may be undefined, but not end in an error.
  EXPECT_EQ(session_.run("query (1 = 1) or (1 / 0 > 1)"), "TRUE");
  EXPECT_EQ(session_.notes(), "");
  EXPECT_EQ(session_.run("query Shapes feed filter[(.No # 3) and (6 / (.No - 3) > 1)] count"), "2");
  EXPECT_EQ(session_.notes(), "");
}

TEST_F(Notes, operands_that_do_not_decide_note_why_they_are_undefined) {
  EXPECT_EQ(session_.run("query (1 / 0 > 1) or (1 = 1)"), "TRUE");
  EXPECT_EQ(session_.notes(), "/: division by zero\n");
  EXPECT_EQ(session_.run("query (1 / 0 > 1) and (1 = 1)"), "undefined");
  EXPECT_EQ(session_.notes(), "/: division by zero\n");
  // Loading a solid could end in an error, so it is loaded; the notes are those of its evaluation.
  EXPECT_EQ(session_.run("query (1 = 2) and (volume(importSTL('gone.stl')) > 1)"), "FALSE");
  EXPECT_NE(session_.notes().find("importSTL"), std::string::npos);
}

TEST_F(Notes, a_filter_by_an_index_tells_why_its_operand_is_undefined) {
  const std::string flat = "createCube(makePoint3D(0, 0, 0), makePoint3D(0, 1, 1))";
  EXPECT_EQ(session_.run("query Shapes feed filter[.Shape intersects " + flat + "] count"), "0");
  const std::string notes = session_.notes();
  EXPECT_NE(notes, "");
  EXPECT_EQ(session_.run("let Index = Shapes creatertree[Shape]"), "");
  EXPECT_EQ(session_.run("query Shapes feed filter[.Shape intersects " + flat + "] count"), "0");
  EXPECT_EQ(session_.notes(), notes);
  EXPECT_EQ(session_.run("query Shapes feed filter[.Shape intersects makePoint3D(0, 0, 0)] count"), "1");
  EXPECT_EQ(session_.notes(), "");
}

TEST_F(Notes, inquiries_give_integers) {
  const std::string plan = session_.run("explain query Shapes feed sum[No]");
  EXPECT_TRUE(plan.starts_with("(inquiry (plan ((0 sum '((stream (tuple ((No int) (Shape points3d))))) -> int' 1 0 "))
      << plan;
  EXPECT_NE(plan.find(" 1 5 "), std::string::npos) << plan;
  const std::string counters = session_.run("list counters");
  EXPECT_EQ(counters.find('.'), std::string::npos) << counters;
}

// Once times came as `0.05001100000000001`.
TEST_F(Notes, times_of_a_plan_are_whole_microseconds) {
  const std::string plan = session_.run("explain query intstream(1, 2000) transformstream sortby[Elem desc] count");
  const std::regex row(R"( \d+ \d+ (\d+\.(\d+)) -?\d+ ')");
  std::size_t rows = 0;
  for (std::sregex_iterator found(plan.begin(), plan.end(), row), end; found != end; ++found, ++rows)
    EXPECT_LE((*found)[2].length(), 3) << (*found)[1];
  EXPECT_EQ(rows, 4U) << plan;
}

}  // namespace
}  // namespace queries
