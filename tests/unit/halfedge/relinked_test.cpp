#include "algebra3d/kernel/halfedge/relinked.h"

#include <random>

#include <gtest/gtest.h>

#include "mesh_samples.h"
#include "same_mesh.h"

namespace algebra3d {
namespace {

using samples::expect_same_mesh;
using samples::Triangles;

std::uint32_t number_below(std::mt19937& random, std::uint32_t limit) {
  return std::uniform_int_distribution<std::uint32_t>(0, limit - 1)(random);
}

/// Triangles that were faces of a mesh, and new ones.
struct Edited {
  Triangles triangles;
  std::vector<std::uint32_t> was;
};

/// In another order, without some, with some turned over, moved elsewhere, repeated or added. Now and then a face is
/// called new that is none.
Edited edited(const Triangles& triangles, std::uint32_t vertex_count, std::mt19937& random) {
  const auto one_in = [&](std::uint32_t n) { return number_below(random, n) == 0; };
  const std::uint32_t calm = 2 + number_below(random, 60);
  Edited result;
  const auto add = [&](TriangleMesh::Triangle triangle, std::uint32_t was) {
    result.triangles.push_back(triangle);
    result.was.push_back(was);
  };
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    if (one_in(calm)) continue;
    if (one_in(calm)) add({triangles[f][0], triangles[f][2], triangles[f][1]}, kNone);
    if (one_in(calm)) add({triangles[f][0], triangles[f][1], number_below(random, vertex_count)}, kNone);
    if (one_in(calm)) add(triangles[f], f);
    add(triangles[f], one_in(calm) ? kNone : f);
  }
  for (std::size_t i = result.was.size(); one_in(2) && i-- > 1;) {
    const std::size_t other = number_below(random, static_cast<std::uint32_t>(i) + 1);
    std::swap(result.triangles[i], result.triangles[other]);
    std::swap(result.was[i], result.was[other]);
  }
  return result;
}

void expect_relinked(const Triangles& triangles, std::mt19937& random) {
  const TriangleMesh before = samples::mesh_of(triangles);
  const auto vertex_count = static_cast<std::uint32_t>(before.vertex_count());
  Edited after = edited(triangles, vertex_count, random);
  std::vector<std::uint32_t> numbers(vertex_count);
  for (std::uint32_t v = 0; v < vertex_count; ++v) numbers[v] = v;
  if (number_below(random, 2) == 0) std::ranges::shuffle(numbers, random);
  for (auto& triangle : after.triangles)
    for (std::uint32_t& corner : triangle) corner = numbers[corner];
  const PointArray points = samples::points_for(vertex_count);
  expect_same_mesh(relinked(before, after.was, points, after.triangles), TriangleMesh(points, after.triangles));
}

TEST(Relinked, is_the_mesh_that_is_linked_from_nothing) {
  std::mt19937 random(5);
  for (const Triangles& triangles : samples::all_kinds())
    for (int i = 0; i < 20; ++i) expect_relinked(triangles, random);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("trial " + std::to_string(i));
    expect_relinked(samples::damaged_grid(random), random);
    expect_relinked(
        samples::random_soup(random, 1 + number_below(random, 40), 4 + number_below(random, 12), i % 2 == 0), random);
  }
}

TEST(TriangleMesh, over_other_points_has_the_same_links) {
  std::mt19937 random(6);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE("trial " + std::to_string(i));
    const Triangles triangles = i % 2 == 0 ? samples::damaged_grid(random)
                                           : samples::random_soup(random, 1 + number_below(random, 40), 12, true);
    const TriangleMesh mesh = samples::mesh_of(triangles);
    std::vector<Vec3> places = mesh.points().approx();
    for (Vec3& place : places) place = 3 * place;
    const TriangleMesh moved(mesh, PointArray(places));
    expect_same_mesh(moved, TriangleMesh(PointArray(places), triangles));
    EXPECT_EQ(moved.points().approx(), places);
  }
}

TEST(Relinked, all_or_nothing_may_be_left) {
  const Triangles torus = samples::torus(7, 5);
  const TriangleMesh mesh = samples::mesh_of(torus);
  std::vector<std::uint32_t> same(torus.size());
  for (std::uint32_t f = 0; f < same.size(); ++f) same[f] = f;
  expect_same_mesh(relinked(mesh, same, mesh.points(), torus), mesh);
  expect_same_mesh(relinked(mesh, std::vector<std::uint32_t>(torus.size(), kNone), mesh.points(), torus), mesh);
  EXPECT_TRUE(relinked(mesh, {}, mesh.points(), {}).is_empty());
  expect_same_mesh(relinked({}, std::vector<std::uint32_t>(torus.size(), kNone), mesh.points(), torus), mesh);
}

}  // namespace
}  // namespace algebra3d
