#include "algebra3d/kernel/arrangement/detail/edge_sides.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "algebra3d/kernel/arrangement/detail/bucket_sort.h"

namespace algebra3d::arrangement_tests {
namespace {

using arrangement::EdgeSides;
using arrangement::InputEdgeEnds;
using arrangement::InputVertexId;

/// Points of a grid of thirds, so that many edges meet, and of others that are a hair beside it.
std::vector<ExactPoint> thirds_and_near_ones(std::mt19937& random, std::size_t count) {
  std::uniform_int_distribution<int> step(-3, 3);
  const Rational hair(1, std::int64_t{1} << 60);
  std::vector<ExactPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto coordinate = [&] { return Rational(step(random), 3) + (i % 3 == 0 ? hair : Rational(0)); };
    points.emplace_back(RationalVec3(coordinate(), coordinate(), coordinate()));
  }
  return points;
}

TEST(EdgeSides, are_orient3d_however_often_and_in_which_order_they_are_asked_for) {
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
  const auto points = thirds_and_near_ones(random, 300);
  std::uniform_int_distribution<std::uint32_t> any(0, static_cast<std::uint32_t>(points.size()) - 1);
  std::uniform_int_distribution<std::uint32_t> few(0, 11);  // so that most are asked for again
  EdgeSides edge_sides;
  std::array<int, 3> seen{};
  for (int i = 0; i < 60000; ++i) {
    std::array<std::uint32_t, 4> n{};
    for (std::uint32_t& number : n) number = i % 2 == 0 ? few(random) : any(random);
    const auto ends = [&](std::uint32_t a, std::uint32_t b) {
      return InputEdgeEnds{points[a], points[b], InputVertexId(a), InputVertexId(b)};
    };
    const InputEdgeEnds edge = ends(n[0], n[1]), other = ends(n[2], n[3]);
    const int expected = orient3d(points[n[0]], points[n[1]], points[n[2]], points[n[3]]);
    ASSERT_EQ(edge_sides.side(edge, other), expected);
    ++seen[static_cast<std::size_t>(expected + 1)];
  }
  for (const int count : seen) EXPECT_GT(count, 1000);
}

TEST(BucketSort, sorts_as_sort_does) {
  std::mt19937 random(2);  // NOLINT(cert-msc51-cpp): the same in every run
  for (const std::uint32_t buckets : {1U, 7U, 1000U})
    for (const std::size_t count : {0U, 1U, 100U, 3000U}) {
      std::vector<std::pair<std::uint32_t, std::uint32_t>> values(count);
      for (auto& value : values) {
        value.first = static_cast<std::uint32_t>(random()) % buckets;
        value.second = static_cast<std::uint32_t>(random()) % 50;
      }
      auto expected = values;
      std::sort(expected.begin(), expected.end());
      arrangement::bucket_sort(
          values, buckets, [](const auto& value) { return value.first; }, std::less());
      ASSERT_EQ(values, expected);
    }
}

}  // namespace
}  // namespace algebra3d::arrangement_tests
