#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <ranges>
#include <set>
#include <vector>

#include "algebra3d/mesh/mesh.h"
#include "algebra3d/mesh/topology.h"
#include "face_lists.h"

namespace algebra3d::mesh {
namespace {

using lists::BruteForce;
using lists::Faces;

template <typename Range>
std::vector<std::uint32_t> numbers(Range&& range) {
  std::vector<std::uint32_t> result;
  for (const auto id : range) result.push_back(id.index());
  return result;
}
template <typename Range>
std::vector<std::uint32_t> sorted_numbers(Range&& range) {
  std::vector<std::uint32_t> result = numbers(range);
  std::ranges::sort(result);
  return result;
}
std::vector<std::uint32_t> all_below(std::size_t count) {
  std::vector<std::uint32_t> result(count);
  std::iota(result.begin(), result.end(), 0U);
  return result;
}

// Ranges of elements are random access, those of neighbours forward; all are views whose iterators outlive them.
template <typename M>
concept HasElements = std::ranges::random_access_range<decltype(vertices(std::declval<const M&>()))> &&
    std::ranges::random_access_range<decltype(edges(std::declval<const M&>()))> &&
    std::ranges::random_access_range<decltype(faces(std::declval<const M&>()))> &&
    std::ranges::random_access_range<decltype(halfedges(std::declval<const M&>()))> &&
    std::ranges::sized_range<decltype(edges(std::declval<const M&>()))>;
template <typename Range>
concept Neighbours = std::ranges::forward_range<Range> && std::ranges::view<Range> &&
    std::ranges::common_range<Range> && std::ranges::borrowed_range<Range>;
template <typename M>
concept HasNeighbours = Neighbours<decltype(adjacent_vertices(std::declval<const M&>(), VertexId()))> &&
    Neighbours<decltype(incoming_halfedges(std::declval<const M&>(), VertexId()))> &&
    Neighbours<decltype(outgoing_halfedges(std::declval<const M&>(), VertexId()))> &&
    Neighbours<decltype(faces_around(std::declval<const M&>(), VertexId()))> &&
    Neighbours<decltype(halfedges_of(std::declval<const M&>(), FaceId()))> &&
    Neighbours<decltype(vertices_of(std::declval<const M&>(), FaceId()))> &&
    Neighbours<decltype(adjacent_faces(std::declval<const M&>(), FaceId()))>;
static_assert(HasElements<TriangleMesh> && HasElements<PolygonMesh>);
static_assert(HasNeighbours<TriangleMesh> && HasNeighbours<PolygonMesh>);
// Handles of different elements are different types, and none is a number.
static_assert(!std::convertible_to<VertexId, EdgeId> && !std::convertible_to<std::uint32_t, FaceId> &&
              !std::convertible_to<HalfedgeId, std::uint32_t>);
// No second storage: a mesh is a few pointers.
static_assert(sizeof(TriangleMesh) <= 18 * sizeof(void*));

TEST(MeshEnumerators, elements_are_numbered_from_zero) {
  lists::for_each_mesh([](const auto& mesh, const Faces& faces_given) {
    const BruteForce brute(faces_given);
    ASSERT_EQ(numbers(vertices(mesh)), all_below(mesh.vertex_count()));
    ASSERT_EQ(numbers(faces(mesh)), all_below(faces_given.size()));
    ASSERT_EQ(numbers(halfedges(mesh)), all_below(brute.halfedges.size()));
    ASSERT_EQ(numbers(edges(mesh)), all_below(brute.edges.size()));
  });
}

TEST(MeshEnumerators, halfedges_have_the_ends_faces_and_edges_of_brute_force) {
  lists::for_each_mesh([](const auto& mesh, const Faces& faces_given) {
    const BruteForce brute(faces_given);
    for (const HalfedgeId h : halfedges(mesh)) {
      const auto& expected = brute.halfedges[h.index()];
      ASSERT_EQ(mesh.origin(h).index(), expected.from);
      ASSERT_EQ(mesh.target(h).index(), expected.to);
      ASSERT_EQ(mesh.face(h).index(), expected.face);
      ASSERT_EQ(mesh.prev(mesh.next(h)), h);
      ASSERT_EQ(mesh.target(h), mesh.origin(mesh.next(h)));
      ASSERT_EQ(mesh.edge(h).index(), brute.edge_of_halfedge[h.index()]);
      ASSERT_EQ(mesh.is_boundary(h), brute.is_boundary(h.index()));
      ASSERT_EQ(mesh.opposite(h).is_valid(), brute.is_manifold(h.index()));
      if (mesh.opposite(h).is_valid()) {
        ASSERT_EQ(mesh.opposite(mesh.opposite(h)), h);
      }
    }
    for (const EdgeId e : edges(mesh)) {
      const std::uint32_t first = brute.edges[e.index()].front();
      ASSERT_EQ(mesh.halfedge(e).index(), first);
      ASSERT_EQ(mesh.ends(e)[0].index(), brute.halfedges[first].from);
      ASSERT_EQ(mesh.ends(e)[1].index(), brute.halfedges[first].to);
      ASSERT_EQ(mesh.is_boundary(e), brute.is_boundary(first));
      ASSERT_EQ(mesh.is_nonmanifold(e), !brute.is_boundary(first) && !brute.is_manifold(first));
    }
  });
}

TEST(MeshEnumerators, neighbourhoods_of_vertices_are_those_of_brute_force) {
  lists::for_each_mesh([](const auto& mesh, const Faces& faces_given) {
    const BruteForce brute(faces_given);
    for (const VertexId v : vertices(mesh)) {
      std::vector<std::uint32_t> leaving, arriving, around;
      std::set<std::uint32_t> neighbours;
      bool is_boundary = false;
      for (std::uint32_t h = 0; h < brute.halfedges.size(); ++h) {
        const auto& [from, to, face] = brute.halfedges[h];
        if (from == v.index()) {
          leaving.push_back(h);
          around.push_back(face);
          neighbours.insert(to);
        }
        if (to == v.index()) {
          arriving.push_back(h);
          neighbours.insert(from);
        }
        if (from == v.index() || to == v.index()) is_boundary |= brute.is_boundary(h);
      }
      ASSERT_EQ(sorted_numbers(outgoing_halfedges(mesh, v)), leaving);
      ASSERT_EQ(sorted_numbers(incoming_halfedges(mesh, v)), arriving);
      ASSERT_EQ(sorted_numbers(faces_around(mesh, v)), around);
      const std::vector<std::uint32_t> found = numbers(adjacent_vertices(mesh, v));
      ASSERT_EQ(std::set(found.begin(), found.end()), neighbours);
      if (mesh.is_manifold()) {
        ASSERT_EQ(found.size(), neighbours.size());
      }
      ASSERT_EQ(mesh.is_isolated(v), neighbours.empty());
      if (mesh.is_manifold()) {
        ASSERT_EQ(mesh.is_boundary(v), is_boundary);
      }
      for (const VertexId to : vertices(mesh)) {
        const HalfedgeId h = mesh.find_halfedge(v, to);
        const bool is_there =
            std::ranges::any_of(leaving, [&](std::uint32_t out) { return brute.halfedges[out].to == to.index(); });
        ASSERT_EQ(h.is_valid(), is_there);
        if (is_there) {
          ASSERT_TRUE(mesh.origin(h) == v && mesh.target(h) == to);
        }
      }
    }
  });
}

TEST(MeshEnumerators, incoming_and_outgoing_halfedges_come_in_the_same_order) {
  lists::for_each_mesh([](const auto& mesh, const Faces& /*faces*/) {
    for (const VertexId v : vertices(mesh)) {
      auto incoming = incoming_halfedges(mesh, v).begin();
      for (const HalfedgeId h : outgoing_halfedges(mesh, v)) ASSERT_EQ(*incoming++, mesh.prev(h));
    }
  });
}

TEST(MeshEnumerators, neighbourhoods_of_faces_are_those_of_brute_force) {
  lists::for_each_mesh([](const auto& mesh, const Faces& faces_given) {
    const BruteForce brute(faces_given);
    std::uint32_t first = 0;
    for (const FaceId f : faces(mesh)) {
      const auto& corners = faces_given[f.index()];
      std::vector<std::uint32_t> own, beside;
      for (std::uint32_t h = first; h < first + corners.size(); ++h) {
        own.push_back(h);
        for (const std::uint32_t other : brute.along(h))
          if (brute.halfedges[other].face != f.index()) beside.push_back(brute.halfedges[other].face);
      }
      first += static_cast<std::uint32_t>(corners.size());
      ASSERT_EQ(mesh.degree(f), corners.size());
      ASSERT_EQ(numbers(halfedges_of(mesh, f)), own);
      ASSERT_EQ(numbers(vertices_of(mesh, f)), corners);
      ASSERT_TRUE(std::ranges::equal(mesh.corners(f), corners));
      ASSERT_EQ(numbers(adjacent_faces(mesh, f)), beside);
    }
  });
}

template <typename M>
concept LendsNeighbours = requires(M mesh) {
  adjacent_vertices(std::forward<M>(mesh), VertexId(0));
};

TEST(MeshEnumerators, ranges_do_not_refer_to_meshes_that_are_gone) {
  static_assert(LendsNeighbours<const PolygonMesh&> && LendsNeighbours<TriangleMesh&>);
  static_assert(!LendsNeighbours<PolygonMesh> && !LendsNeighbours<const TriangleMesh>);
}

TEST(MeshEnumerators, ranges_compose_with_views) {
  const PolygonMesh cube = lists::polygons_of(lists::cube(), lists::cube_points());
  const VertexId corner(0);
  auto heights = adjacent_vertices(cube, corner) |
                 std::views::filter([&](VertexId v) { return cube.point(v).z == 0; }) |
                 std::views::transform([&](VertexId v) { return cube.point(v).x; });
  EXPECT_EQ(std::accumulate(heights.begin(), heights.end(), 0.0), 1);
  auto all = faces(cube) | std::views::transform([&](FaceId f) { return adjacent_faces(cube, f); }) | std::views::join |
             std::views::common;
  EXPECT_EQ(std::ranges::distance(all), 24);
  EXPECT_EQ(numbers(edges(cube) | std::views::reverse | std::views::take(2)), (std::vector<std::uint32_t>{11, 10}));
  EXPECT_EQ(numbers(edges(cube) | std::views::drop(10)), (std::vector<std::uint32_t>{10, 11}));
}

TEST(MeshEnumerators, edges_of_large_meshes_have_their_first_halfedges) {
  for (const bool is_of_triangles : {true, false}) {
    const Faces list = lists::torus(101, 97, is_of_triangles);
    const PolygonMesh mesh = lists::polygons_of(list, lists::torus_points(101, 97));
    const BruteForce brute(list);
    ASSERT_EQ(mesh.edge_count(), brute.edges.size());
    for (const EdgeId e : edges(mesh)) {
      ASSERT_EQ(mesh.halfedge(e).index(), brute.edges[e.index()].front());
      ASSERT_EQ(mesh.edge(mesh.opposite(mesh.halfedge(e))), e);
    }
  }
}

TEST(MeshEnumerators, boundary_loops_have_each_boundary_halfedge_once) {
  lists::for_each_mesh([](const auto& mesh, const Faces& faces_given) {
    const BruteForce brute(faces_given);
    std::vector<std::uint32_t> found, expected;
    for (const BoundaryLoop& loop : boundary_loops(mesh)) {
      for (std::size_t i = 0; i + 1 < loop.halfedges.size(); ++i)
        ASSERT_EQ(mesh.origin(loop.halfedges[i + 1]), mesh.target(loop.halfedges[i]));
      if (loop.is_closed) {
        ASSERT_EQ(mesh.origin(loop.halfedges.front()), mesh.target(loop.halfedges.back()));
      }
      for (const HalfedgeId h : loop.halfedges) found.push_back(h.index());
    }
    for (std::uint32_t h = 0; h < brute.halfedges.size(); ++h)
      if (brute.is_boundary(h)) expected.push_back(h);
    std::ranges::sort(found);
    ASSERT_EQ(found, expected);
  });
}

}  // namespace
}  // namespace algebra3d::mesh
