#include "algebra3d/kernel/planar/noding.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

#include "unit/planar/checks.h"

namespace algebra3d {
namespace {

using Edges = std::vector<DirectedEdge>;

TEST(Noding, merges_divides_and_cancels) {
  //                        0          1          2          3          4          5          6
  const PointArray points({{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {0, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}});
  const auto result = [&](const Edges& edges) { return noded(points, edges).value(); };
  EXPECT_EQ(result({}), Edges());
  EXPECT_EQ(result({{0, 3}, {2, 5}}), Edges());
  EXPECT_EQ(result({{3, 1}}), (Edges{{0, 2}, {2, 1}}));
  EXPECT_EQ(result({{0, 1}, {1, 3}}), Edges());
  EXPECT_EQ(result({{0, 1}, {5, 3}}), (Edges{{2, 1}}));
  EXPECT_EQ(result({{0, 1}, {0, 1}, {3, 5}, {1, 0}}), (Edges{{0, 2}, {0, 2}, {2, 1}}));
  EXPECT_EQ(result({{2, 0}, {0, 1}, {0, 1}, {1, 2}}), (Edges{{0, 2}, {2, 1}}));
}

TEST(Noding, edges_may_cross_in_given_points_alone) {
  const std::vector<Vec3> square{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const auto crossed = noded(PointArray(square), Edges{{0, 2}, {1, 3}});
  ASSERT_FALSE(crossed.ok());
  EXPECT_EQ(crossed.error().code, ErrorCode::invalid_value);
  const std::string message = crossed.error().message;
  EXPECT_TRUE(message.find("crosses segment") != std::string::npos && message.find("(0 0)") != std::string::npos)
      << message;
  EXPECT_EQ(noded(PointArray(square), Edges{{0, 2}, {1, 3}, {2, 0}}).value(), (Edges{{1, 3}}));
  std::vector<Vec3> with_middle = square;
  with_middle.push_back({2, 2, 0});
  EXPECT_EQ(noded(PointArray(with_middle), Edges{{0, 2}, {1, 3}}).value(), (Edges{{0, 4}, {1, 4}, {4, 2}, {4, 3}}));
}

/// Edges between neighbouring places of a grid, which are longer where they run along it: counted place by place.
TEST(Noding, agrees_with_counting_on_a_grid) {
  constexpr std::uint32_t kSize = 8;
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
  std::vector<Vec3> places;
  for (std::uint32_t i = 0; i < kSize * kSize; ++i)
    places.push_back({static_cast<double>(i % kSize), static_cast<double>(i / kSize), 0});
  for (int round = 0; round < 50; ++round) {
    Edges edges;
    std::map<DirectedEdge, int> counts;
    for (int i = 0; i < 40; ++i) {
      const bool is_across = random() % 2 == 0;
      std::uint32_t from = random() % kSize, to = random() % kSize;
      const std::uint32_t line = random() % kSize;
      const auto place = [&](std::uint32_t along) { return is_across ? line * kSize + along : along * kSize + line; };
      edges.emplace_back(place(from), place(to));
      for (; from < to; ++from) ++counts[{place(from), place(from + 1)}];
      for (; from > to; --from) --counts[{place(from - 1), place(from)}];
    }
    Edges expected;
    for (const auto& [edge, count] : counts)
      for (int i = 0; i < std::abs(count); ++i)
        expected.push_back(count > 0 ? edge : DirectedEdge{edge.second, edge.first});
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(noded(PointArray(places), edges).value(), expected);
  }
}

}  // namespace
}  // namespace algebra3d
