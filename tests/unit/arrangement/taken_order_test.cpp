// Orders of hierarchies that results take over, along chains of operations. Oracle: hierarchies of the same faces that
// know nothing.
#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "base/scheduler.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/solids.h"

namespace algebra3d::solids {
namespace {

std::vector<PlacedFace> order_of(const BoxHierarchy& hierarchy) {
  std::vector<PlacedFace> order;
  for (std::size_t i = 0; i < hierarchy.face_count(); ++i) order.push_back(hierarchy.placed(i));
  return order;
}

/// As a loaded value has it.
BoxHierarchy made_anew(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.face_count());
  std::iota(faces.begin(), faces.end(), 0U);
  return {mesh, std::move(faces)};
}

TriangleMesh difference(const TriangleMesh& solid, const BoxHierarchy& hierarchy, const TriangleMesh& tool) {
  return combine_solids(std::vector<Operand>{{&solid, 0, &hierarchy}, {&tool, 1}},
                        [](const auto& windings) { return windings[0] > 0 && windings[1] == 0; })
      .value();
}

/// A small cube, turned at random, at a random place.
TriangleMesh small_cube(Chance& chance, double reach) {
  const Vec3 place{reach * chance.unit(), reach * chance.unit(), reach * chance.unit()};
  return shifted(rotated(cube(-0.15, 0.15), chance.direction(), 3 * chance.unit()), place);
}

struct Chain {
  TriangleMesh last;
  std::size_t taken_over = 0;  ///< number of steps whose hierarchy had the frame of the one before
};

/// Bites of cubes, one after the other; each hierarchy must be the one that is made anew.
Chain bitten(TriangleMesh solid, std::size_t steps, double reach) {
  Chance chance(5);
  Chain chain{std::move(solid)};
  for (std::size_t step = 0; step < steps; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const BoxHierarchy hierarchy(chain.last);
    EXPECT_EQ(order_of(hierarchy), order_of(made_anew(chain.last)));
    chain.last = difference(chain.last, hierarchy, small_cube(chance, reach));
    const FaceOrder* order = chain.last.face_order();
    if (order != nullptr && order->frame == BoxHierarchy(chain.last).frame()) ++chain.taken_over;
  }
  return chain;
}

TEST(TakenOrder, HierarchiesOfALongChainAreTheSameAsMadeAnew) {
  // No bite reaches the points of the ball that are farthest out along the axes.
  const std::size_t bites = is_thorough() ? 200 : 50;
  const Chain chain = bitten(geodesic_sphere(8), bites, 0.55);
  EXPECT_GT(chain.taken_over, bites * 3 / 4);
}

TEST(TakenOrder, BitesThatMoveTheBoxChangeTheFrame) {
  const Chain chain = bitten(geodesic_sphere(8), 60, 1.2);
  EXPECT_LT(chain.taken_over, 60U);
}

TEST(TakenOrder, AChainDoesNotDependOnThreadsNorOnWhoKnowsTheOrder) {
  const TriangleMesh ball = geodesic_sphere(20);
  const auto chain = [&](bool knows) {
    Chance chance(7);
    TriangleMesh solid = ball;
    for (int step = 0; step < 20; ++step) {
      const BoxHierarchy hierarchy = knows ? BoxHierarchy(solid) : made_anew(solid);
      solid = difference(solid, hierarchy, small_cube(chance, 1));
    }
    return solid;
  };
  const TriangleMesh expected = chain(false);
  ASSERT_NE(expected.face_order(), nullptr);
  for (const int threads : {1, 2, 16})
    with_threads(threads, [&] {
      const TriangleMesh result = chain(true);
      EXPECT_EQ(triangles_of(result), triangles_of(expected)) << threads;
      EXPECT_EQ(result.points(), expected.points()) << threads;
      EXPECT_EQ(result.face_order()->faces, expected.face_order()->faces) << threads;
    });
}

TEST(TakenOrder, IsKnownOnlyIfOneOperandGivesMostFaces) {
  const TriangleMesh one = geodesic_sphere(10), other = shifted(geodesic_sphere(10), {0.5, 0.25, 0.125});
  const BoxHierarchy hierarchy(one);
  EXPECT_EQ(difference(one, hierarchy, other).face_order(), nullptr) << "both give many";
  EXPECT_NE(difference(one, hierarchy, shifted(cube(-0.1, 0.1), {1, 0, 0})).face_order(), nullptr);
  const TriangleMesh small = geodesic_sphere(3);
  EXPECT_EQ(difference(small, BoxHierarchy(small), shifted(cube(-0.1, 0.1), {1, 0, 0})).face_order(), nullptr)
      << "few are sorted as soon";
}

}  // namespace
}  // namespace algebra3d::solids
