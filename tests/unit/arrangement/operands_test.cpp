// Input of an arrangement: elements of several meshes, numbered through.
#include "algebra3d/kernel/arrangement/detail/operands.h"

#include <gtest/gtest.h>

#include "unit/arrangement/stages.h"

namespace algebra3d::arrangement {
namespace {

using stages::CrossingCubes;
using stages::Lines;

TEST(Operands, are_numbered_through) {
  const CrossingCubes boxes;
  const Operands& operands = boxes.operands();
  const OperandId a(0), b(1);
  EXPECT_EQ(operands.count(), 2U);
  EXPECT_EQ(operands.face_count(), 24U);
  EXPECT_EQ(operands.halfedge_count(), 72U);
  EXPECT_EQ(operands.vertex_count(), 16U);
  EXPECT_EQ(operands.faces(b).front(), InputFaceId(12));
  EXPECT_EQ(operands.operand_of(InputFaceId(11)), a);
  EXPECT_EQ(operands.operand_of(InputFaceId(12)), b);
  EXPECT_EQ(operands.operand_of(InputVertexId(7)), a);
  EXPECT_EQ(operands.operand_of(InputVertexId(8)), b);
  EXPECT_EQ(operands.in_mesh(b, InputFaceId(14)), FaceId(2));
  EXPECT_EQ(operands.in_mesh(b, InputHalfedgeId(36)), HalfedgeId(0));
  EXPECT_EQ(operands.in_mesh(b, InputVertexId(9)), VertexId(1));
  EXPECT_EQ(operands.input(b, FaceId(2)), InputFaceId(14));
  EXPECT_EQ(audit(operands), Lines());
}

TEST(Operands, go_round_faces_and_across_edges) {
  const CrossingCubes boxes;
  const Operands& operands = boxes.operands();
  const InputFaceId face(12);
  const InputHalfedgeId h = Operands::halfedge(face, 2);
  EXPECT_EQ(Operands::face(h), face);
  EXPECT_EQ(Operands::next(h), Operands::halfedge(face, 0));
  EXPECT_EQ(Operands::previous(Operands::halfedge(face, 0)), h);
  EXPECT_EQ(Operands::halfedges(face).size(), 3U);
  // The two faces of a side share the diagonal, which leads from the first corner of the second face to the second one.
  const InputHalfedgeId diagonal = Operands::halfedge(InputFaceId(13), 0);
  EXPECT_EQ(operands.opposite(h), diagonal);
  EXPECT_EQ(operands.edge(h), operands.edge(diagonal));
  EXPECT_EQ(Operands::halfedge(operands.edge(diagonal)), h);
  std::vector<InputHalfedgeId> found;
  operands.halfedges_along(operands.edge(h), found);
  EXPECT_EQ(found, (std::vector{h, diagonal}));
  EXPECT_EQ(operands.origin(Operands::halfedge(face, 0)), InputVertexId(8));
}

TEST(Operands, of_many_meshes_are_found_by_faces) {
  const TriangleMesh cube = solids::cube(0, 1);
  const std::vector<Operand> list(7, Operand{&cube, 0});
  const Operands operands(list);
  for (const OperandId operand : operands.ids())
    for (const InputFaceId face : operands.faces(operand)) EXPECT_EQ(operands.operand_of(face), operand);
  EXPECT_EQ(audit(operands), Lines());
}

TEST(Operands, audit_sees_damage) {
  CrossingCubes boxes;
  boxes.list()[1].group = 2;
  EXPECT_EQ(audit(boxes.operands()), Lines{"operand 1 has the group 2"});
  boxes.list()[1].group = 1;
  const TriangleMesh other = solids::tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  boxes.list()[1].mesh = &other;
  EXPECT_EQ(audit(boxes.operands()), (Lines{"operand 1 has 4 faces and a hierarchy of 12",
                                            "operand 1 has the faces from 12 on, 12 of them; expected 4 from 12 on",
                                            "24 faces, but 16 in operands"}));
}

}  // namespace
}  // namespace algebra3d::arrangement
