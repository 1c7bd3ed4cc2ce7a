#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "mesh_samples.h"
#include "same_mesh.h"

namespace algebra3d {
namespace {

using samples::BruteForce;
using samples::expect_same_mesh;
using samples::Triangles;

std::size_t vertices_of(const Triangles& triangles) {
  std::size_t count = 0;
  for (const auto& triangle : triangles)
    for (const std::uint32_t corner : triangle) count = std::max<std::size_t>(count, corner + 1);
  return count;
}

/// Opposites of manifold edges, of which about one in `share` is unlinked. Where the fans of a vertex are more than
/// one, and all half-edges that leave it would be linked, one of these edges is unlinked too.
std::vector<std::uint32_t> some_opposites(const Triangles& triangles, std::mt19937& random, std::uint32_t share) {
  const BruteForce brute(triangles);
  std::vector<std::uint32_t> opposites(brute.halfedge_count(), TriangleMesh::kUnlinked);
  for (std::uint32_t h = 0; h < opposites.size(); ++h) {
    if (!brute.is_manifold(h) || brute.opposite(h) < h || random() % share == 0) continue;
    opposites[h] = brute.opposite(h);
    opposites[brute.opposite(h)] = h;
  }
  for (std::uint32_t v = 0; v < vertices_of(triangles); ++v) {
    const auto corners = brute.corners(v);
    const auto is_linked = [&](std::uint32_t h) { return opposites[h] != TriangleMesh::kUnlinked; };
    if (brute.fans(v).size() < 2 || !std::ranges::all_of(corners, is_linked)) continue;
    const std::uint32_t h = corners[random() % corners.size()];
    opposites[opposites[h]] = TriangleMesh::kUnlinked;
    opposites[h] = TriangleMesh::kUnlinked;
  }
  return opposites;
}

LargeVector<std::uint32_t> origins_of(const Triangles& triangles) {
  LargeVector<std::uint32_t> origins;
  for (const auto& triangle : triangles) origins.insert(origins.end(), triangle.begin(), triangle.end());
  return origins;
}

TriangleMesh partly_linked(const Triangles& triangles, const std::vector<std::uint32_t>& opposites,
                           std::size_t vertex_count) {
  return {samples::points_for(vertex_count), origins_of(triangles), {opposites.begin(), opposites.end()}, {}};
}

/// With the vertices below `settled_count` settled, and nonsense in place of the opposites that have to be found.
TriangleMesh partly_settled(const Triangles& triangles, std::size_t settled_count, std::size_t vertex_count) {
  const BruteForce brute(triangles);
  const LargeVector<std::uint32_t> origins = origins_of(triangles);
  LargeVector<std::uint32_t> opposites;
  for (std::uint32_t h = 0; h < origins.size(); ++h) {
    const bool is_settled = origins[h] < settled_count || origins[h % 3 == 2 ? h - 2 : h + 1] < settled_count;
    opposites.push_back(is_settled ? brute.opposite(h) : 12345);
  }
  LargeVector<HalfedgeId> outgoing;
  for (std::uint32_t v = 0; v < settled_count; ++v) outgoing.emplace_back(std::ranges::min(brute.corners(v)));
  return {samples::points_for(vertex_count), origins, opposites, outgoing, {}};
}

/// Renumbers the vertices so that those which may be settled come first. Returns their number.
std::size_t sort_by_kind(Triangles& triangles) {
  const BruteForce brute(triangles);
  const auto may_be_settled = [&](std::uint32_t v) {
    const auto corners = brute.corners(v);
    return brute.fans(v).size() == 1 &&
           std::ranges::all_of(corners, [&](std::uint32_t h) { return brute.is_manifold(h); });
  };
  std::vector<std::uint32_t> numbers(vertices_of(triangles));
  std::uint32_t count = 0, settled_count = 0;
  for (const bool settled : {true, false}) {
    for (std::uint32_t v = 0; v < numbers.size(); ++v)
      if (may_be_settled(v) == settled) numbers[v] = count++;
    if (settled) settled_count = count;
  }
  for (auto& triangle : triangles)
    for (std::uint32_t& corner : triangle) corner = numbers[corner];
  return settled_count;
}

TEST(PartlyLinkedMesh, is_the_one_that_is_linked_from_scratch) {
  std::mt19937 random(7);
  for (const Triangles& triangles : samples::all_kinds()) {
    const TriangleMesh expected = samples::mesh_of(triangles);
    for (const std::uint32_t share : {1U, 2U, 5U, 1000000U})
      expect_same_mesh(partly_linked(triangles, some_opposites(triangles, random, share), expected.vertex_count()),
                       expected);
  }
}

TEST(PartlyLinkedMesh, larger_meshes_of_all_kinds) {
  std::mt19937 random(8);
  for (int i = 0; i < 12; ++i) {
    Triangles triangles =
        samples::joined(samples::torus(20, 15), samples::moved(samples::grid(12, 9, false, true), 280));
    std::ranges::shuffle(triangles, random);
    // Some faces away, some turned round, some twice.
    for (int n = 0; n < i; ++n) {
      triangles.pop_back();
      std::swap(triangles[random() % triangles.size()][0], triangles[random() % triangles.size()][0]);
      auto& turned = triangles[random() % triangles.size()];
      std::swap(turned[0], turned[1]);
      triangles.push_back(triangles[random() % triangles.size()]);
    }
    const TriangleMesh expected = samples::mesh_of(triangles);
    for (const std::uint32_t share : {2U, 10U, 1000U})
      expect_same_mesh(partly_linked(triangles, some_opposites(triangles, random, share), expected.vertex_count()),
                       expected);
  }
}

TEST(PartlyLinkedMesh, with_all_edges_linked_has_nothing_to_do) {
  for (const Triangles& triangles : {samples::tetrahedron(), samples::torus(5, 7), samples::double_torus()}) {
    const BruteForce brute(triangles);
    std::vector<std::uint32_t> opposites;
    for (std::uint32_t h = 0; h < brute.halfedge_count(); ++h) opposites.push_back(brute.opposite(h));
    // Vertices that no triangle uses are isolated.
    const std::size_t count = vertices_of(triangles) + 3;
    const TriangleMesh mesh = partly_linked(triangles, opposites, count);
    expect_same_mesh(mesh, samples::mesh_of(triangles, count));
    EXPECT_TRUE(mesh.is_isolated(VertexId(count - 1)));
  }
}

TEST(PartlyLinkedMesh, with_settled_vertices_is_the_one_that_is_linked_from_scratch) {
  std::size_t most = 0;
  for (Triangles triangles : samples::all_kinds()) {
    const std::size_t settled_count = sort_by_kind(triangles);
    const TriangleMesh expected = samples::mesh_of(triangles);
    for (const std::size_t count : {settled_count, settled_count / 2, std::size_t{0}})
      expect_same_mesh(partly_settled(triangles, count, expected.vertex_count()), expected);
    most = std::max(most, settled_count);
  }
  EXPECT_GT(most, 10U);
}

TEST(PartlyLinkedMesh, of_nothing_is_empty) {
  const TriangleMesh mesh(PointArray(), {}, {}, {});
  EXPECT_TRUE(mesh.is_empty());
  EXPECT_TRUE(audit(mesh).empty());
}

}  // namespace
}  // namespace algebra3d
