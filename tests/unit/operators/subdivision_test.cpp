// The notes of subdivide and limitPosition.
#include <gtest/gtest.h>

#include "algebra3d/values/types/mesh3d.h"
#include "unit/operators/call_operator.h"

namespace algebra3d {
namespace {

using calls::call;
using calls::cube;
using calls::point;

TEST(SubdivisionNotes, bodies_that_touch_are_divided) {
  const Volume3d block = cube(point(0, 0, 0), point(1, 1, 1));
  const auto at_edge = call("union", block, cube(point(1, 1, 0), point(2, 2, 1))).get<Volume3d>();
  const auto divided = call("subdivide", at_edge, std::string("loop"), 1);
  EXPECT_EQ(divided.diagnostics,
            (std::vector<std::string>{"subdivide: divided the solid at 1 edge and 2 vertices, where bodies touch"}));
  EXPECT_EQ(divided.get<Mesh3d>().mesh().face_count(), 96U);
  const auto at_vertex = call("union", block, cube(point(1, 1, 1), point(2, 2, 2))).get<Volume3d>();
  EXPECT_EQ(call("limitPosition", at_vertex, std::string("doo-sabin")).diagnostics,
            (std::vector<std::string>{"limitPosition: divided the solid at 0 edges and 1 vertex, where bodies touch"}));
  // Nothing is divided, and nothing is said, without steps or contacts.
  EXPECT_TRUE(call("subdivide", at_edge, std::string("loop"), 0).diagnostics.empty());
  EXPECT_TRUE(call("subdivide", block, std::string("loop"), 1).diagnostics.empty());
}

TEST(SubdivisionNotes, surfaces_are_cut_along_edges_of_three_triangles) {
  const auto fan =
      calls::literal<Surface3d>("(((0 0 0) (2 0 0) (1 2 0)) ((0 0 0) (2 0 0) (1 0 2)) ((0 0 0) (2 0 0) (1 -2 0)))");
  const auto divided = call("subdivide", fan, std::string("loop"), 1);
  EXPECT_EQ(
      divided.diagnostics,
      (std::vector<std::string>{"subdivide: divided the surface at 1 edge and 2 vertices, where it is not manifold"}));
  EXPECT_EQ(divided.get<Mesh3d>().mesh().vertex_count(), 18U);
}

}  // namespace
}  // namespace algebra3d
