// Fifth stage: the segments of each plane, cut at one another.
#include "algebra3d/kernel/arrangement/detail/overlay.h"

#include <gtest/gtest.h>

#include "unit/arrangement/stages.h"

namespace algebra3d::arrangement {
namespace {

using stages::Lines;

void expect_cuts(const stages::Boxes& boxes, const Lines& cuts) {
  const Facets facets = boxes.facets();
  const SegmentComplex complex = boxes.overlaid(facets);
  EXPECT_EQ(stages::cuts(complex), stages::sorted(cuts));
  EXPECT_TRUE(std::ranges::is_sorted(complex.cuts));
  EXPECT_EQ(std::ranges::adjacent_find(complex.cuts), complex.cuts.end());
  // Segments are neither added nor taken away.
  EXPECT_EQ(stages::segments(facets, complex), stages::segments(facets, boxes.facet_contacts(facets)));
  EXPECT_EQ(audit(boxes.operands(), facets, complex), Lines());
}

TEST(Overlay, of_crossing_cubes_adds_nothing) {
  expect_cuts(stages::CrossingCubes(),
              {"(4 4 0)-(4 4 4) at (4 4 2)", "(4 0 4)-(4 4 4) at (4 2 4)", "(0 4 4)-(4 4 4) at (2 4 4)",
               "(2 2 2)-(2 2 6) at (2 2 4)", "(2 2 2)-(2 6 2) at (2 4 2)", "(2 2 2)-(6 2 2) at (4 2 2)"});
}

TEST(Overlay, of_a_shared_face_edge_or_vertex_cuts_nothing) {
  expect_cuts(stages::SharedFace(), {});
  expect_cuts(stages::SharedEdge(), {});
  expect_cuts(stages::SharedVertex(), {});
}

TEST(Overlay, of_boxes_that_overlap_in_a_plane_adds_nothing) {
  expect_cuts(stages::CoplanarOverlap(), {"(0 2 2)-(2 2 2) at (1 2 2)", "(2 0 2)-(2 2 2) at (2 1 2)",
                                          "(1 1 2)-(1 3 2) at (1 2 2)", "(1 1 2)-(3 1 2) at (2 1 2)"});
}

TEST(Overlay, of_a_cavity_is_empty) {
  expect_cuts(stages::Cavity(), {});
}

/// Three boards, each in the middle of the other two: their common parts cross in planes.
class ThreeBoards {
 public:
  ThreeBoards()
      : boards_{solids::box({-3, -3, -1}, {3, 3, 1}), solids::box({-3, -1, -3}, {3, 1, 3}),
                solids::box({-1, -3, -3}, {1, 3, 3})},
        list_{{{&boards_[0], 0}, {&boards_[1], 0}, {&boards_[2], 0}}},
        operands_(list_) {}

  const Operands& operands() const { return operands_; }
  PairContacts contacts() const {
    return find_pair_contacts(operands_, find_candidates(operands_, {}).value(), {}).value();
  }

 private:
  std::array<TriangleMesh, 3> boards_;
  std::array<Operand, 3> list_;
  Operands operands_;
};

TEST(Overlay, cuts_common_parts_where_they_cross) {
  const ThreeBoards boards;
  const PairContacts contacts = boards.contacts();
  const Facets facets = make_facets(boards.operands(), contacts);
  const SegmentComplex before = find_facet_contacts(boards.operands(), facets, contacts).value();
  const SegmentComplex complex = overlay(boards.operands(), facets, before, {}).value();
  // Three pairs of boards meet in four lines each. Such a line lies in a side of both boards, and each of the two large
  // sides of the third board crosses it: the common parts are cut at the corners of the cube from -1 to 1.
  Lines expected;
  for (const int a : {-1, 1})
    for (const int b : {-1, 1})
      for (const int c : {-1, 1}) {
        expected.push_back(fmt::format("(-3 {0} {1})-(3 {0} {1}) at ({2} {0} {1})", a, b, c));
        expected.push_back(fmt::format("({0} -3 {1})-({0} 3 {1}) at ({0} {2} {1})", a, b, c));
        expected.push_back(fmt::format("({0} {1} -3)-({0} {1} 3) at ({0} {1} {2})", a, b, c));
      }
  Lines found;
  for (const std::string& cut : stages::cuts(complex))
    if (!std::ranges::binary_search(stages::cuts(before), cut)) found.push_back(cut);
  EXPECT_EQ(found, stages::sorted(expected));
  EXPECT_EQ(audit(boards.operands(), facets, complex), Lines());
}

TEST(Overlay, beyond_the_limit_is_an_error) {
  const ThreeBoards boards;
  const PairContacts contacts = boards.contacts();
  const Facets facets = make_facets(boards.operands(), contacts);
  const auto found =
      overlay(boards.operands(), facets, find_facet_contacts(boards.operands(), facets, contacts).value(), {}, 23);
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::limit_exceeded);
}

}  // namespace
}  // namespace algebra3d::arrangement
