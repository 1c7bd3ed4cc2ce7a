// A filter on boxes reads no geometry: issue "the main job", lazy loading.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "unit/session/example_session.h"

namespace queries {
namespace {

class LazyGeometry : public testing::Test {
 protected:
  LazyGeometry() : session_(folder_.path()) {
    EXPECT_TRUE(session_.session().open_file(folder_.path() / "lazy.db").ok());
    EXPECT_EQ(session_.run(
                  "let Parts = intstream(1, 10000) transformstream extend[Solid: createCube(makePoint3D(.Elem, 0, 0), "
                  "makePoint3D(.Elem + 1, 1, 1))] consume"),
              "");
    EXPECT_EQ(session_.run("let B = rectangle3(100, 200, 0, 1, 0, 1)"), "");
  }
  std::uint64_t loads() { return session_.session().store()->geometry_loads(); }

  TestFolder folder_;
  TestSession session_;
};

TEST_F(LazyGeometry, a_filter_on_boxes_reads_none_of_10000_solids) {
  // Cubes [n, n+1] that meet [100, 200]: n = 99 .. 200.
  EXPECT_EQ(session_.run("query Parts feed filter[bbox(.Solid) intersects B] count"), "102");
  EXPECT_EQ(session_.run("query Parts feed filter[size(.Solid) = 12] count"), "10000");
  EXPECT_EQ(session_.run("let Index = Parts creatertree[Solid]"), "");
  EXPECT_EQ(session_.run("query Index Parts windowintersects[B] count"), "102");
  EXPECT_EQ(session_.run("query Parts feed {a} Parts feed {b} itSpatialJoin[Solid_a, Solid_b] count"), "29998");
  EXPECT_EQ(loads(), 0U);
}

TEST_F(LazyGeometry, only_what_is_measured_is_read) {
  EXPECT_EQ(session_.run("query Parts feed filter[bbox(.Solid) intersects B] extend[V: volume(.Solid)] sum[V]"),
            "102.0");
  EXPECT_EQ(loads(), 102U);
}

/// Two balls of 62,000 faces that are apart, and one that crosses the first.
class LazyFaces : public testing::Test {
 protected:
  LazyFaces() : session_(folder_.path()) {
    open();
    run("let Balls = intstream(0, 1) transformstream projectextend[; No: .Elem, Solid: createSphere(makePoint3D(12 * "
        ".Elem, 5 * .Elem, 3 * .Elem), 4, 250)] consume");
    run("let Third = createSphere(makePoint3D(5.5, 1, 1), 4, 250)");
    run("let P = makePoint3D(1, 2, 3)");
    reopen();
  }
  void open() { EXPECT_TRUE(session_.session().open_file(folder_.path() / "lazy.db").ok()); }
  void reopen() {
    EXPECT_EQ(run("close database"), "");
    open();
  }
  std::string run(const std::string& statement) { return session_.run(statement); }
  std::string ball(int number) { return "(Balls feed filter[.No = " + std::to_string(number) + "] extract[Solid])"; }
  std::uint64_t loads() { return session_.session().store()->geometry_loads(); }
  std::uint64_t faces_in_blocks() { return session_.session().store()->faces_in_blocks(); }

  TestFolder folder_;
  TestSession session_;
};

TEST_F(LazyFaces, elements_are_counted_without_their_mesh) {
  EXPECT_EQ(run("query faces(" + ball(0) + ") count"), "62000");
  EXPECT_EQ(run("query halfedges(" + ball(0) + ") count"), "186000");
  EXPECT_EQ(loads(), 0U);
  EXPECT_EQ(run("query faces(" + ball(0) + ") head[2] count"), "2");
  EXPECT_EQ(loads(), 1U);
}

TEST_F(LazyFaces, two_solids_are_compared_by_the_faces_that_are_near) {
  const std::vector<std::string> questions{"query " + ball(0) + " intersects " + ball(1),
                                           "query distance(" + ball(0) + ", " + ball(1) + ")",
                                           "query withinDistance(" + ball(0) + ", " + ball(1) + ", 5.5)",
                                           "query P inside " + ball(0), "query " + ball(0) + " intersects Third"};
  std::vector<std::string> answers;
  for (const std::string& question : questions) answers.push_back(run(question));
  EXPECT_EQ(answers[0], "FALSE");
  EXPECT_EQ(answers[3], "TRUE");
  EXPECT_EQ(answers[4], "TRUE");
  EXPECT_EQ(loads(), 2U) << "each once, since they had no blocks";
  EXPECT_EQ(faces_in_blocks(), 0U);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    reopen();
    EXPECT_EQ(run(questions[i]), answers[i]);
    EXPECT_EQ(loads(), 0U) << questions[i];
    EXPECT_EQ(faces_in_blocks() == 0, i == 0) << questions[i] << ": boxes that are apart suffice for the first one";
    EXPECT_LT(faces_in_blocks(), 31'000U) << questions[i];
  }
}

TEST_F(LazyFaces, who_asks_often_loads_the_solid) {
  run("query P inside " + ball(0));
  reopen();
  run("query intstream(1, 1000) transformstream filter[P inside " + ball(0) + "] count");
  for (int i = 0; i < 200 && loads() == 0; ++i) run("query P inside " + ball(0));
  EXPECT_EQ(loads(), 1U);
  EXPECT_LT(faces_in_blocks(), 36'000U);
}

TEST_F(LazyFaces, blocks_go_with_their_value) {
  run("query P inside " + ball(0));
  run("query Balls feed filter[.No = 0] Balls updatedirect[Solid: createSphere(makePoint3D(100, 2, 3), 4, 250)] count");
  EXPECT_EQ(run("query P inside " + ball(0)), "FALSE");
  reopen();
  EXPECT_EQ(run("query makePoint3D(100, 2, 3) inside " + ball(0)), "TRUE");
  reopen();
  EXPECT_EQ(run("query makePoint3D(100, 2, 3) inside " + ball(0)), "TRUE");
  EXPECT_EQ(loads(), 0U);
  EXPECT_EQ(run("check database"), "(inquiry (findings ()))");
}

}  // namespace
}  // namespace queries
