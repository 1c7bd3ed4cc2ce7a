#include <gtest/gtest.h>

#include "unit/operators/call_operator.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using calls::call;
using samples::MeshMaker;

/// The volumes of the components, in their order; each of them is proved anew.
std::vector<double> component_volumes(const TriangleMesh& mesh) {
  auto solid = Volume3d::prove(mesh);
  EXPECT_TRUE(solid->is_defined());
  std::vector<double> volumes;
  const auto answer = call("components", **solid);
  for (const Value& component : answer.elements()) {
    EXPECT_TRUE((*Volume3d::prove(component.get<Volume3d>().mesh())).is_defined());
    volumes.push_back(call("volume", component).get<double>());
  }
  return volumes;
}

TEST(Components, of_nothing_are_none) {
  EXPECT_TRUE(call("components", Volume3d()).elements().empty());
  EXPECT_TRUE(call("components", Value(TypeOf<Volume3d>::type())).elements().empty());
  EXPECT_TRUE(call("components", Surface3d()).elements().empty());
}

TEST(Components, come_in_order_of_their_first_triangles) {
  EXPECT_EQ(component_volumes(MeshMaker().box({0, 0, 0}, {1, 1, 2}).box({5, 0, 0}, {6, 1, 1}).mesh()),
            (std::vector<double>{2, 1}));
}

TEST(Components, cavity_belongs_to_the_solid_around_it) {
  EXPECT_EQ(
      component_volumes(
          MeshMaker().box({20, 0, 0}, {21, 1, 1}).box({1, 1, 1}, {2, 2, 2}, true).box({0, 0, 0}, {4, 4, 4}).mesh()),
      (std::vector<double>{1, 63}));
}

TEST(Components, solid_within_a_cavity_is_its_own) {
  const auto nested = [](bool reversed) {
    MeshMaker maker;
    // Five shells, each one inside the one before: body, cavity, body, cavity, body.
    for (int i = 0; i < 5; ++i) {
      const double k = reversed ? 4 - i : i;
      maker.box({k, k, k}, {11 - k, 11 - k, 11 - k}, static_cast<int>(k) % 2 == 1);
    }
    return maker.mesh();
  };
  const std::vector<double> expected{1331.0 - 729, 343.0 - 125, 27};
  EXPECT_EQ(component_volumes(nested(false)), expected);
  EXPECT_EQ(component_volumes(nested(true)), (std::vector<double>{27, 343.0 - 125, 1331.0 - 729}));
}

TEST(Components, two_cavities_of_one_solid_belong_to_it) {
  EXPECT_EQ(
      component_volumes(
          MeshMaker().box({0, 0, 0}, {9, 3, 3}).box({1, 1, 1}, {2, 2, 2}, true).box({4, 1, 1}, {6, 2, 2}, true).mesh()),
      (std::vector<double>{78}));
}

TEST(Components, solids_that_touch_in_an_edge_are_one_and_in_a_point_two) {
  EXPECT_EQ(component_volumes(MeshMaker().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 0}, {2, 2, 1}).mesh()),
            (std::vector<double>{2}));
  EXPECT_EQ(component_volumes(MeshMaker().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 1}, {2, 2, 2}).mesh()),
            (std::vector<double>{1, 1}));
}

TEST(Components, body_touching_its_cavity_in_points_is_its_own) {
  // A tetrahedron in a cavity, with a corner inside one of the cavity's walls.
  EXPECT_EQ(component_volumes(MeshMaker()
                                  .tetrahedron({2, 3, 2}, {4, 3, 2}, {2, 5, 2}, {2, 3, 6})
                                  .box({0, 0, 0}, {8, 8, 8})
                                  .box({1, 1, 1}, {7, 7, 6}, true)
                                  .mesh()),
            (std::vector<double>{8.0 / 3, 512.0 - 180}));
}

TEST(Components, work_on_coordinates_that_are_no_doubles) {
  EXPECT_EQ(component_volumes(MeshMaker(Rational(1, 3))
                                  .box({0, 0, 0}, {9, 9, 9})
                                  .box({1, 1, 1}, {4, 4, 4}, true)
                                  .box({20, 0, 0}, {23, 3, 3})
                                  .mesh()),
            (std::vector<double>{26, 1}));
}

TEST(Components, of_a_surface_are_connected_across_edges) {
  const auto surface =
      calls::literal<Surface3d>("(((0 0 0) (1 0 0) (0 1 0)) ((0 0 0) (-1 0 0) (0 -1 0)) ((1 0 0) (1 1 0) (0 1 0)))");
  const auto answer = call("components", surface);
  ASSERT_EQ(answer.elements().size(), 2U);
  EXPECT_EQ(answer.elements()[0].get<Surface3d>().mesh().face_count(), 2U);
  EXPECT_EQ(answer.elements()[1].to_nested().print(), "(((0.0 0.0 0.0) (-1.0 0.0 0.0) (0.0 -1.0 0.0)))");
}

}  // namespace
}  // namespace algebra3d
