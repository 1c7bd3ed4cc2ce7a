// First stage: which faces may touch, by their boxes alone.
#include "algebra3d/kernel/arrangement/detail/candidates.h"

#include <gtest/gtest.h>

#include "unit/arrangement/stages.h"

namespace algebra3d::arrangement {
namespace {

using stages::Lines;

/// All pairs of a face of a side of A and one of a side of B, for pairs of sides such as "x+ y-". The box of each face
/// is that of its side.
Lines faces_of_sides(const Lines& pairs_of_sides) {
  const Lines sides{"z-", "z+", "y-", "y+", "x-", "x+"};
  const auto first_face = [&](const std::string& side) { return 2 * (std::ranges::find(sides, side) - sides.begin()); };
  Lines pairs;
  for (const std::string& pair : pairs_of_sides) {
    const auto a = first_face(pair.substr(0, 2)), b = first_face(pair.substr(3));
    for (const int i : {0, 1})
      for (const int j : {0, 1}) pairs.push_back(fmt::format("A{} B{}", a + i, b + j));
  }
  return stages::sorted(pairs);
}

void expect_candidates(const stages::Boxes& boxes, const Lines& pairs_of_sides) {
  const Candidates found = boxes.candidates();
  EXPECT_EQ(stages::text(boxes.operands(), found), faces_of_sides(pairs_of_sides));
  EXPECT_EQ(audit(boxes.operands(), found), Lines());
}

TEST(Candidates, of_crossing_cubes) {
  expect_candidates(stages::CrossingCubes(), {"x+ y-", "x+ z-", "y+ x-", "y+ z-", "z+ x-", "z+ y-"});
}

TEST(Candidates, of_boxes_with_a_shared_face) {
  expect_candidates(stages::SharedFace(), {"x+ x-", "x+ y-", "x+ y+", "x+ z-", "x+ z+",  //
                                           "y- x-", "y- y-", "y- z-", "y- z+",           //
                                           "y+ x-", "y+ y+", "y+ z-", "y+ z+",           //
                                           "z- x-", "z- z-", "z- y-", "z- y+",           //
                                           "z+ x-", "z+ z+", "z+ y-", "z+ y+"});
}

TEST(Candidates, of_boxes_with_a_shared_edge) {
  expect_candidates(stages::SharedEdge(), {"x+ x-", "x+ y-", "x+ z-", "x+ z+",  //
                                           "y+ x-", "y+ y-", "y+ z-", "y+ z+",  //
                                           "z- x-", "z- y-", "z- z-",           //
                                           "z+ x-", "z+ y-", "z+ z+"});
}

TEST(Candidates, of_boxes_with_a_shared_vertex) {
  expect_candidates(stages::SharedVertex(),
                    {"x+ x-", "x+ y-", "x+ z-", "y+ x-", "y+ y-", "y+ z-", "z+ x-", "z+ y-", "z+ z-"});
}

TEST(Candidates, of_boxes_that_overlap_in_a_plane) {
  expect_candidates(stages::CoplanarOverlap(), {"z+ z-", "z+ x-", "z+ y-", "x+ z-", "x+ y-", "y+ z-", "y+ x-"});
}

TEST(Candidates, of_a_cavity_are_none) {
  expect_candidates(stages::Cavity(), {});
}

TEST(Candidates, of_many_operands_are_those_of_each_two) {
  // Ten cubes in a row: each shares a side with the next one. One tree finds what hierarchies find for two.
  std::vector<TriangleMesh> cubes;
  for (int i = 0; i < 10; ++i) cubes.push_back(solids::box({1.0 * i, 0, 0}, {1.0 * i + 1, 1, 1}));
  std::vector<Operand> list;
  for (const TriangleMesh& cube : cubes) list.push_back({&cube, 0});
  const Operands operands(list);
  const Candidates found = find_candidates(operands, {}).value();
  // 21 pairs of sides, as for two boxes with a shared face.
  EXPECT_EQ(found.pairs.size(), 9U * 21 * 4);
  EXPECT_EQ(audit(operands, found), Lines());
}

/// A rod along (1, 1, 0) with |x - y| <= 1, in a grid of boxes of which some touch it in an edge; moved along x and y.
stages::Boxes rod_in_a_grid(double shift, bool is_rod_first) {
  solids::Maker grid;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) {
      const Vec3 low{shift + 3 * i, shift + 3 * j, 0};
      const TriangleMesh box = solids::box(low, low + Vec3{2, 2, 3});
      for (const auto& [a, b, c] : solids::triangles_of(box))
        grid.triangle(box.points()[a].approx, box.points()[b].approx, box.points()[c].approx);
    }
  const double end = shift + 15;
  const std::array<solids::Corner, 4> outline{{{shift, shift - 1}, {end, end - 1}, {end - 1, end}, {shift - 1, shift}}};
  const TriangleMesh rod = solids::prism(outline, 1, 2);
  return is_rod_first ? stages::Boxes(rod, grid.mesh()) : stages::Boxes(grid.mesh(), rod);
}

void expect_faces_that_touch(const stages::Boxes& boxes, OperandId rod, OperandId grid, bool are_others_left_out) {
  const Operands& operands = boxes.operands();
  const Candidates found = boxes.candidates();
  std::size_t touching = 0, beyond = 0;
  for (const InputFaceId f : operands.faces(rod))
    for (const InputFaceId g : operands.faces(grid)) {
      const TriangleRef corners = operands.corners(g);
      const auto offset = [](const PointRef& p) { return p.approx.x - p.approx.y; };
      const bool is_beyond = std::ranges::all_of(corners, [&](const PointRef& p) { return offset(p) > 1; }) ||
                             std::ranges::all_of(corners, [&](const PointRef& p) { return offset(p) < -1; });
      const bool is_found = std::ranges::count(found.pairs, FacePair{std::min(f, g), std::max(f, g)}) == 1;
      const bool does_touch = intersect_triangles(operands.corners(f), corners) != Contact::none;
      EXPECT_TRUE(is_found || !does_touch) << stages::text(operands, f) << " " << stages::text(operands, g);
      EXPECT_FALSE(is_beyond && is_found && are_others_left_out)
          << stages::text(operands, f) << " " << stages::text(operands, g);
      touching += does_touch ? 1 : 0;
      beyond += is_beyond ? 1 : 0;
    }
  EXPECT_GT(touching, 100U);
  EXPECT_GT(beyond, 1000U);
}

TEST(Candidates, of_a_slanted_rod_are_the_faces_between_its_facets) {
  const OperandId first(0), second(1);
  expect_faces_that_touch(rod_in_a_grid(0, true), first, second, true);
  expect_faces_that_touch(rod_in_a_grid(0, false), second, first, true);
  expect_faces_that_touch(rod_in_a_grid(0x1p30, false), second, first, true);
  // Where coordinates have no digits left to tell faces apart.
  expect_faces_that_touch(rod_in_a_grid(0x1p51, false), second, first, false);
}

TEST(Candidates, beyond_the_limit_are_an_error) {
  const stages::CrossingCubes boxes;
  EXPECT_TRUE(find_candidates(boxes.operands(), {}, 24).ok());
  const auto found = find_candidates(boxes.operands(), {}, 23);
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::limit_exceeded);
}

TEST(Candidates, audit_sees_damage) {
  const stages::CrossingCubes boxes;
  const InputFaceId a(0), b(12), beyond(24);
  EXPECT_EQ(audit(boxes.operands(), {{{a, b}, {a, b}}}), Lines{"pair (0 12) comes twice"});
  EXPECT_EQ(audit(boxes.operands(), {{{b, a}}}), Lines{"pair (12 0): the faces are of operands 1 and 0"});
  EXPECT_EQ(audit(boxes.operands(), {{{a, a}}}), Lines{"pair (0 0): the faces are of operands 0 and 0"});
  EXPECT_EQ(audit(boxes.operands(), {{{a, beyond}}}), Lines{"pair (0 24): no such face"});
}

}  // namespace
}  // namespace algebra3d::arrangement
