// Third stage: the coplanar facets that touch something, and their planes. A side of a box is one facet of two faces.
#include "algebra3d/kernel/arrangement/detail/facets.h"

#include <gtest/gtest.h>

#include "unit/arrangement/stages.h"

namespace algebra3d::arrangement {
namespace {

using stages::Lines;

void expect_facets(const stages::Boxes& boxes, const Lines& planes) {
  const Facets facets = boxes.facets();
  EXPECT_EQ(stages::text(boxes.operands(), facets), stages::sorted(planes));
  EXPECT_EQ(audit(boxes.operands(), facets), Lines());
}

TEST(Facets, of_crossing_cubes) {
  // Normals of A's sides point along the axes, as the fronts of planes do; those of B's point against them.
  expect_facets(stages::CrossingCubes(), {"x=2: B back 8 9", "x=4: A front 10 11", "y=2: B back 4 5",
                                          "y=4: A front 6 7", "z=2: B back 0 1", "z=4: A front 2 3"});
}

TEST(Facets, of_boxes_with_a_shared_face) {
  expect_facets(stages::SharedFace(),
                {"x=2: A front 10 11, B back 8 9", "y=0: A back 4 5, B back 4 5", "y=2: A front 6 7, B front 6 7",
                 "z=0: A back 0 1, B back 0 1", "z=2: A front 2 3, B front 2 3"});
}

TEST(Facets, of_boxes_with_a_shared_edge) {
  expect_facets(stages::SharedEdge(), {"x=2: A front 10 11, B back 8 9", "y=2: A front 6 7, B back 4 5",
                                       "z=0: A back 0 1, B back 0 1", "z=2: A front 2 3, B front 2 3"});
}

TEST(Facets, of_boxes_with_a_shared_vertex) {
  expect_facets(stages::SharedVertex(),
                {"x=2: A front 10 11, B back 8 9", "y=2: A front 6 7, B back 4 5", "z=2: A front 2 3, B back 0 1"});
}

TEST(Facets, of_boxes_that_overlap_in_a_plane) {
  expect_facets(stages::CoplanarOverlap(), {"x=1: B back 8 9", "x=2: A front 10 11", "y=1: B back 4 5",
                                            "y=2: A front 6 7", "z=2: A front 2 3, B back 0 1"});
}

TEST(Facets, of_a_cavity_are_none) {
  expect_facets(stages::Cavity(), {});
}

TEST(Facets, of_all_faces) {
  const stages::Cavity boxes;
  const Facets facets = make_facets_of_all_faces(boxes.operands());
  EXPECT_EQ(stages::text(boxes.operands(), facets),
            stages::sorted({"x=0: A back 8 9", "x=6: A front 10 11", "y=0: A back 4 5", "y=6: A front 6 7",
                            "z=0: A back 0 1", "z=6: A front 2 3", "x=2: B back 8 9", "x=4: B front 10 11",
                            "y=2: B back 4 5", "y=4: B front 6 7", "z=2: B back 0 1", "z=4: B front 2 3"}));
  EXPECT_EQ(audit(boxes.operands(), facets), Lines());
}

TEST(Facets, end_at_their_edges) {
  const stages::CrossingCubes boxes;
  const Facets facets = boxes.facets();
  // Face A10 has the diagonal of its side as edge 2.
  EXPECT_TRUE(facets.is_boundary(boxes.operands(), Operands::halfedge(InputFaceId(10), 0)));
  EXPECT_TRUE(facets.is_boundary(boxes.operands(), Operands::halfedge(InputFaceId(10), 1)));
  EXPECT_FALSE(facets.is_boundary(boxes.operands(), Operands::halfedge(InputFaceId(10), 2)));
}

TEST(Facets, audit_sees_damage) {
  const stages::CrossingCubes boxes;
  const auto audited = [&](const auto& damage) {
    Facets damaged = boxes.facets();
    damage(damaged);
    return fmt::format("{}", fmt::join(audit(boxes.operands(), damaged), "\n"));
  };
  const auto expect_seen = [](const std::string& violations, const std::string& part) {
    EXPECT_NE(violations.find(part), std::string::npos) << violations;
  };
  const FacetId first(0), second(1);
  expect_seen(audited([&](Facets& f) { f.facets[first].orientation *= -1; }), "looks to another side than its facet 0");
  expect_seen(audited([&](Facets& f) { std::swap(f.facets[first].plane, f.facets[second].plane); }),
              "does not lie in the plane");
  expect_seen(audited([&](Facets& f) { f.facets[first].plane = PlaneId(99); }), "facet 0: no such plane");
  expect_seen(audited([&](Facets& f) { f.of_face[f.faces.front()] = second; }), "which is not its own");
  expect_seen(audited([&](Facets& f) { f.of_face[f.faces.front()] = FacetId(); }),
              "11 faces have a facet, 12 are listed");
  expect_seen(audited([&](Facets& f) { f.facets[first].faces.last = 1; }), "facet 1 has the faces 2 to 4 of 12");
  expect_seen(audited([&](Facets& f) { f.facets[first].operand = OperandId(1 - f.facets[first].operand.index()); }),
              "is of another operand");
  expect_seen(audited([&](Facets& f) { f.planes[PlaneId(0)].is_clockwise = !f.planes[PlaneId(0)].is_clockwise; }),
              "plane 0: its triangle does not turn counter-clockwise");
  expect_seen(audited([&](Facets& f) {
                const TriangleRef elsewhere{Vec3{0, 0, 9}, Vec3{1, 0, 9}, Vec3{0, 1, 9}};
                f.planes[PlaneId(0)].coefficients = IntegerPlane::through(elsewhere);
              }),
              "plane 0: its triangle is not in the plane of the coefficients");
}

TEST(Facets, audit_sees_a_facet_that_is_not_maximal) {
  const stages::CrossingCubes boxes;
  Facets facets = boxes.facets();
  // The second face of the last facet becomes a facet by itself.
  Facet& last = facets.facets.back();
  const InputFaceId face = facets.faces.back();
  --last.faces.last;
  Facet part = last;
  part.faces = {last.faces.last, last.faces.last + 1};
  facets.of_face[face] = facets.facets.push_back(part);
  EXPECT_EQ(audit(boxes.operands(), facets).size(), 2U);  // once from each side
}

}  // namespace
}  // namespace algebra3d::arrangement
