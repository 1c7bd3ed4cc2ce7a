// Hierarchies of meshes that know the order of most of their faces. Oracle: those of the same meshes without.
#include "algebra3d/kernel/halfedge/face_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "algebra3d/kernel/search/box_hierarchy.h"

namespace algebra3d::face_orders {
namespace {

using Triangles = std::vector<std::array<Vec3, 3>>;

TriangleMesh mesh_of(const Triangles& triangles, std::shared_ptr<const FaceOrder> order = nullptr) {
  std::vector<Vec3> points;
  LargeVector<std::uint32_t> origins;
  for (const auto& corners : triangles)
    for (const Vec3& corner : corners) {
      origins.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(corner);
    }
  LargeVector<std::uint32_t> opposites(origins.size(), TriangleMesh::kUnlinked);
  return {PointArray(std::move(points)), std::move(origins), std::move(opposites), {}, {}, std::move(order)};
}

/// The order that a set operation takes over for a mesh whose first triangles are some of those of another one.
std::shared_ptr<const FaceOrder> order_of(const BoxHierarchy& hierarchy, const std::vector<std::uint32_t>& kept) {
  auto order = std::make_shared<FaceOrder>();
  order->frame = hierarchy.frame();
  for (std::size_t i = 0; i < hierarchy.face_count(); ++i) {
    const PlacedFace placed = hierarchy.placed(i);
    const auto found = std::ranges::lower_bound(kept, placed.face());
    if (found != kept.end() && *found == placed.face())
      order->faces.push_back(PlacedFace(placed.place(), static_cast<std::uint32_t>(found - kept.begin())));
  }
  return order;
}

std::vector<PlacedFace> placed_faces(const BoxHierarchy& hierarchy) {
  std::vector<PlacedFace> result;
  for (std::size_t i = 0; i < hierarchy.face_count(); ++i) result.push_back(hierarchy.placed(i));
  return result;
}

std::vector<std::array<std::uint32_t, 2>> pairs_in_order(const BoxHierarchy& hierarchy) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  hierarchy.for_each_pair(
      [&](std::uint32_t f, std::uint32_t g) {
        pairs.push_back({f, g});
        return true;
      },
      [] { return true; });
  return pairs;
}

/// Triangles in [0, 1]^3, the first two of which span it; of every `step`-th the next twelve lie at one place.
Triangles clustered_triangles(std::size_t count, std::size_t step, unsigned seed) {
  std::mt19937 random(seed);  // NOLINT(cert-msc51-cpp): the same in every run
  std::uniform_real_distribution<double> unit(0, 0.9);
  Triangles result{{{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {{{1, 1, 1}, {1, 0, 1}, {1, 1, 0}}}};
  while (result.size() < count) {
    const Vec3 base{unit(random), unit(random), unit(random)};
    const std::size_t copies = result.size() % step == 0 ? 13 : 1;
    for (std::size_t i = 0; i < copies; ++i) {
      // Apart by less than a cell of the upper half of a code, in an order that is not that of the curve.
      const double off = 1e-5 * static_cast<double>((7 * i) % 13);
      result.push_back({base + Vec3{off, 0, off}, base + Vec3{0.05, off, 0}, base + Vec3{0, 0.05, off}});
    }
  }
  return result;
}

/// The hierarchy of kept and new triangles, made with the order of the kept ones and without.
void expect_the_same_with_a_known_order(const Triangles& before, const std::vector<std::uint32_t>& kept,
                                        const Triangles& added) {
  const TriangleMesh old_mesh = mesh_of(before);
  const BoxHierarchy old_hierarchy(old_mesh);
  Triangles after;
  for (const std::uint32_t face : kept) after.push_back(before[face]);
  after.insert(after.end(), added.begin(), added.end());
  const TriangleMesh plain = mesh_of(after), told = mesh_of(after, order_of(old_hierarchy, kept));
  ASSERT_EQ(told.face_order()->faces.size(), kept.size());
  const BoxHierarchy expected(plain), taken_over(told);
  EXPECT_EQ(expected.frame(), taken_over.frame());
  EXPECT_EQ(placed_faces(expected), placed_faces(taken_over));
  EXPECT_EQ(pairs_in_order(expected), pairs_in_order(taken_over));
}

std::vector<std::uint32_t> all_but(std::size_t count, std::size_t first, std::size_t step) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < count; ++i)
    if (i < first || (i - first) % step != 0) kept.push_back(i);
  return kept;
}

TEST(face_order, a_hierarchy_is_the_same_with_it_and_without) {
  for (const std::size_t step : {1000U, 50U}) {
    const Triangles before = clustered_triangles(3000, step, 1), added = clustered_triangles(300, step, 2);
    expect_the_same_with_a_known_order(before, all_but(before.size(), before.size(), 1), {});
    expect_the_same_with_a_known_order(before, all_but(before.size(), 2, 9), added);
    expect_the_same_with_a_known_order(before, all_but(before.size(), 2, 400), added);
    // Thirteen triangles at one place are ordered by their full codes, fewer by number: some of them go, others come.
    expect_the_same_with_a_known_order(before, all_but(before.size(), 2, 2), {});
    Triangles more(before.begin() + 2, before.begin() + 500);
    expect_the_same_with_a_known_order(before, all_but(before.size(), 2, 300), more);
  }
}

TEST(face_order, of_another_frame_or_of_few_faces_is_not_used) {
  const Triangles before = clustered_triangles(2000, 50, 1);
  expect_the_same_with_a_known_order(before, all_but(before.size(), 0, 500), {});  // another origin
  expect_the_same_with_a_known_order(before, all_but(before.size(), 2, 500), {{{{5, 0, 0}, {5, 1, 0}, {5, 0, 1}}}});
  expect_the_same_with_a_known_order(before, {0, 1, 5, 9}, clustered_triangles(500, 50, 3));
}

}  // namespace
}  // namespace algebra3d::face_orders
