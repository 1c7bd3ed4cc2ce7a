#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/arrangement/divide_and_conquer.h"
#include "base/scheduler.h"
#include "unit/arrangement/solids.h"

// The number of threads changes nothing: not the points, their order, or the triangles.
namespace algebra3d::solids {
namespace {

using Operation = std::function<Result<TriangleMesh>()>;

void expect_same_mesh(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(triangles_of(a), triangles_of(b));
  EXPECT_EQ(a.points(), b.points());
}

void expect_independence_of_threads(const Operation& operation) {
  TriangleMesh alone;
  with_threads(1, [&] { alone = operation().value(); });
  ASSERT_FALSE(alone.is_empty());
  for (const int threads : {2, 3, 16}) {
    SCOPED_TRACE(threads);
    with_threads(threads, [&] { expect_same_mesh(alone, operation().value()); });
  }
  expect_same_mesh(alone, operation().value());
}

TEST(Threads, TwoLargeSolids) {
  // 28,800 triangles each: beyond the limits from which stages are divided.
  const TriangleMesh one = geodesic_sphere(60), other = shifted(geodesic_sphere(60), {0.3, 0.2, 0.1});
  expect_independence_of_threads([&] {
    return combine_solids(std::vector<Operand>{{&one, 0}, {&other, 1}},
                          [](const auto& windings) { return windings[0] > 0 && windings[1] == 0; });
  });
}

TEST(Threads, NearlyCoincidentSolids) {
  // Crossings in each of some thousand planes.
  const TriangleMesh one = geodesic_sphere(12), other = shifted(geodesic_sphere(12), {0.001, 0.002, 0.003});
  expect_independence_of_threads([&] {
    return combine_solids(std::vector<Operand>{{&one, 0}, {&other, 0}},
                          [](const auto& windings) { return windings[0] > 0; });
  });
}

TEST(Threads, CommonPartsThatCrossInPlanes) {
  std::vector<TriangleMesh> boards;
  for (int i = 0; i < 6; ++i) {
    const double at = 3 * i + 0.5;
    boards.push_back(box({at, -9, -9}, {at + 1, 30, 30}));
    boards.push_back(box({-9, at, -9}, {30, at + 1, 30}));
    boards.push_back(box({-9, -9, at}, {30, 30, at + 1}));
  }
  std::vector<Operand> operands;
  for (const TriangleMesh& board : boards) operands.push_back({&board, 0});
  expect_independence_of_threads(
      [&] { return combine_solids(operands, [](const auto& windings) { return windings[0] > 1; }); });
}

TEST(Threads, ManySolidsByParts) {
  std::vector<TriangleMesh> cubes;
  for (int i = 0; i < 64; ++i) {
    const double x = i % 4, y = i / 4 % 4, z = i / 16;
    cubes.push_back(box({x, y, z}, {x + 1.5, y + 1.5, z + 1.5}));
  }
  std::vector<Operand> operands;
  for (const TriangleMesh& cube : cubes) operands.push_back({&cube, 0});
  expect_independence_of_threads([&] { return unite_solids(operands); });
}

}  // namespace
}  // namespace algebra3d::solids
