#include "algebra3d/mesh/graph.h"
#include "algebra3d/mesh/cgal.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/boost/graph/graph_concepts.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <gtest/gtest.h>

#include <boost/graph/boyer_myrvold_planar_test.hpp>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/graph_concepts.hpp>
#include <boost/graph/kruskal_min_spanning_tree.hpp>
#include <map>
#include <queue>
#include <set>
#include <vector>

#include "algebra3d/mesh/normals.h"
#include "algebra3d/mesh/shapes.h"
#include "algebra3d/mesh/topology.h"
#include "face_lists.h"

namespace algebra3d::mesh {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using lists::Faces;

template <typename G>
struct HasConcepts {
  BOOST_CONCEPT_ASSERT((boost::VertexListGraphConcept<G>));
  BOOST_CONCEPT_ASSERT((boost::EdgeListGraphConcept<G>));
  BOOST_CONCEPT_ASSERT((boost::BidirectionalGraphConcept<G>));
  BOOST_CONCEPT_ASSERT((boost::AdjacencyGraphConcept<G>));
  BOOST_CONCEPT_ASSERT((boost::ReadablePropertyGraphConcept<G, VertexId, boost::vertex_index_t>));
  BOOST_CONCEPT_ASSERT((boost::ReadablePropertyGraphConcept<G, GraphEdge, boost::edge_weight_t>));
  BOOST_CONCEPT_ASSERT((CGAL::HalfedgeListGraphConcept<G>));
  BOOST_CONCEPT_ASSERT((CGAL::FaceListGraphConcept<G>));
};
template struct HasConcepts<Graph<TriangleMesh>>;
template struct HasConcepts<Graph<PolygonMesh>>;

template <AnyMesh M>
void check_graph(const M& mesh) {
  const Graph<M> g(mesh);
  std::size_t halfedge_count = 0, border_count = 0;
  std::set<GraphEdge> edges_met;
  for (const GraphHalfedge h : halfedges(g)) {
    ++halfedge_count;
    border_count += h.is_border() ? 1 : 0;
    ASSERT_EQ(opposite(opposite(h, g), g), h);
    ASSERT_NE(opposite(h, g), h);
    ASSERT_EQ(prev(next(h, g), g), h);
    ASSERT_EQ(next(prev(h, g), g), h);
    ASSERT_EQ(face(next(h, g), g), face(h, g));
    ASSERT_EQ(source(next(h, g), g), target(h, g));
    ASSERT_EQ(source(opposite(h, g), g), target(h, g));
    ASSERT_EQ(face(h, g).is_valid(), !h.is_border());
    ASSERT_EQ(edge(h, g), edge(opposite(h, g), g));
    edges_met.insert(edge(h, g));
  }
  ASSERT_EQ(halfedge_count, num_halfedges(g));
  ASSERT_EQ(border_count, halfedge_count - mesh.halfedge_count());
  ASSERT_EQ(edges_met.size(), num_edges(g));
  ASSERT_EQ(edges(g).size(), num_edges(g));
  ASSERT_TRUE(std::ranges::equal(edges(g), edges_met));
  for (const VertexId v : vertices(g)) {
    std::multiset<VertexId> out, in, beside;
    for (const GraphEdge& e : out_edges(v, g)) {
      ASSERT_EQ(source(e, g), v);
      out.insert(target(e, g));
      ASSERT_TRUE(edge(v, target(e, g), g).second);
    }
    for (const GraphEdge& e : in_edges(v, g)) {
      ASSERT_EQ(target(e, g), v);
      in.insert(source(e, g));
    }
    for (const VertexId u : adjacent_vertices(v, g)) beside.insert(u);
    ASSERT_EQ(out, in);
    ASSERT_EQ(out, beside);
    ASSERT_EQ(degree(v, g), out.size());
    if (!mesh.is_isolated(v)) {
      ASSERT_EQ(target(halfedge(v, g), g), v);
    }
  }
  for (const FaceId f : faces(g)) ASSERT_EQ(face(halfedge(f, g), g), f);
}

TEST(MeshGraph, every_edge_has_two_halfedges_and_those_without_face_form_loops) {
  lists::for_each_mesh([](const auto& mesh, const Faces& /*faces*/) { check_graph(mesh); });
}

TEST(MeshGraph, is_valid_for_cgal_where_the_mesh_is_manifold_without_isolated_vertices) {
  std::size_t open_count = 0, closed_count = 0;
  lists::for_each_mesh([&](const auto& mesh, const Faces& faces_given) {
    if (!mesh.is_manifold() || mesh.is_empty() || lists::has_repeated_corners(faces_given)) return;
    const Faces list = lists::renumbered(faces_given);
    std::uint32_t vertex_count = 0;
    for (const auto& face : list) vertex_count = std::max(vertex_count, std::ranges::max(face) + 1);
    const PolygonMesh compact = lists::polygons_of(list, lists::some_points(vertex_count));
    ASSERT_TRUE(CGAL::is_valid_polygon_mesh(Graph(compact)));
    ++(is_closed(mesh) ? closed_count : open_count);
  });
  EXPECT_GT(open_count, 50U);
  EXPECT_GT(closed_count, 2U);
}

TEST(MeshGraph, edges_have_different_numbers_also_where_they_are_cut) {
  const TriangleMesh mesh = lists::triangles_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, std::vector<Vec3>(5));
  const Graph g(mesh);
  std::set<std::size_t> numbers;
  for (const GraphEdge& e : edges(g)) numbers.insert(get(boost::edge_index, g, e));
  EXPECT_EQ(numbers.size(), num_edges(g));
  EXPECT_EQ(*numbers.rbegin() + 1, num_edges(g));
}

TEST(MeshGraph, cgal_finds_the_boundary_loops) {
  lists::for_each_mesh([&](const auto& mesh, const Faces& /*faces*/) {
    if (!mesh.is_manifold()) return;
    const Graph g(mesh);
    ASSERT_EQ(CGAL::is_closed(g), is_closed(mesh));
    std::vector<GraphHalfedge> cycles;
    PMP::extract_boundary_cycles(g, std::back_inserter(cycles));
    ASSERT_EQ(cycles.size(), boundary_loops(mesh).size());
  });
}

TEST(MeshGraph, cgal_finds_the_components) {
  lists::for_each_mesh([](const auto& mesh, const Faces& /*faces*/) {
    if (!mesh.is_manifold()) return;
    const Graph g(mesh);
    std::vector<std::size_t> component(mesh.face_count());
    const auto map = boost::make_iterator_property_map(component.begin(), get(boost::face_index, g));
    const FaceComponents expected = connected_components(mesh);
    ASSERT_EQ(PMP::connected_components(g, map), expected.count);
    std::map<std::size_t, std::uint32_t> names;
    for (std::size_t f = 0; f < component.size(); ++f)
      ASSERT_EQ(names.try_emplace(component[f], expected.of_face[f]).first->second, expected.of_face[f]);
  });
}

TEST(MeshGraph, cgal_measures_and_finds_normals) {
  const Solid box = *Solid::box({0, 0, 0}, {3, 2, 1});
  const TriangleMesh mesh = mesh_of(box);
  const Graph g(mesh);
  ASSERT_TRUE(CGAL::is_triangle_mesh(g));
  EXPECT_EQ(PMP::volume(g), 6);
  EXPECT_EQ(PMP::area(g), 22);
  const std::vector<Vec3> normals = face_normals(mesh);
  for (const FaceId f : faces(g)) {
    const auto n = PMP::compute_face_normal(f, g);
    EXPECT_EQ((Vec3{n.x(), n.y(), n.z()}), normals[f.index()]);
  }
}

TEST(MeshGraph, cgal_walks_round_vertices_and_faces) {
  const PolygonMesh grid = lists::polygons_of(lists::grid(3, 3, false), lists::grid_points(3, 3));
  const Graph g(grid);
  for (const VertexId v : vertices(g)) {
    std::set<GraphHalfedge> met;
    for (const GraphHalfedge h : CGAL::halfedges_around_target(v, g)) {
      EXPECT_EQ(target(h, g), v);
      met.insert(h);
    }
    EXPECT_EQ(met.size(), degree(v, g));
    EXPECT_EQ(CGAL::is_border(v, g).has_value(), grid.is_boundary(v));
  }
  for (const FaceId f : faces(g)) EXPECT_EQ(std::ranges::distance(CGAL::vertices_around_face(halfedge(f, g), g)), 4);
}

/// Numbers of edges from vertex 0, kFar where there is no way.
constexpr std::size_t kFar = 1U << 30U;
template <AnyMesh M>
std::vector<std::size_t> edge_distances(const M& mesh) {
  std::vector<std::size_t> distances(mesh.vertex_count(), kFar);
  std::queue<VertexId> waiting;
  distances[0] = 0;
  for (waiting.push(VertexId(0)); !waiting.empty(); waiting.pop())
    for (const VertexId v : algebra3d::adjacent_vertices(mesh, waiting.front()))
      if (distances[v.index()] == kFar) {
        distances[v.index()] = distances[waiting.front().index()] + 1;
        waiting.push(v);
      }
  return distances;
}

TEST(MeshGraph, boost_searches_in_breadth) {
  lists::for_each_mesh([](const auto& mesh, const Faces& /*faces*/) {
    if (mesh.vertex_count() == 0) return;
    const Graph g(mesh);
    std::vector<std::size_t> distances(mesh.vertex_count(), kFar);
    distances[0] = 0;
    const auto map = boost::make_iterator_property_map(distances.begin(), get(boost::vertex_index, g));
    boost::breadth_first_search(
        g, VertexId(0), boost::visitor(boost::make_bfs_visitor(boost::record_distances(map, boost::on_tree_edge()))));
    ASSERT_EQ(distances, edge_distances(mesh));
  });
}

TEST(MeshGraph, boost_finds_shortest_ways_along_edges) {
  const TriangleMesh grid = lists::triangles_of(lists::grid(6, 4, true), lists::grid_points(6, 4));
  const Graph g(grid);
  std::vector<double> distances(grid.vertex_count());
  boost::dijkstra_shortest_paths(
      g, VertexId(0),
      boost::distance_map(boost::make_iterator_property_map(distances.begin(), get(boost::vertex_index, g))));
  // Diagonals run from the lower left to the upper right.
  for (const VertexId v : vertices(g)) {
    const Vec3& p = grid.point(v);
    const double diagonal = std::min(p.x, p.y);
    EXPECT_NEAR(distances[v.index()], diagonal * std::sqrt(2.0) + (std::max(p.x, p.y) - diagonal), 1e-12);
  }
}

TEST(MeshGraph, boost_finds_components_planarity_and_spanning_trees) {
  lists::for_each_mesh([](const auto& mesh, const Faces& /*faces*/) {
    const Graph g(mesh);
    std::vector<std::size_t> component(mesh.vertex_count());
    const std::size_t count = boost::connected_components(
        g, boost::make_iterator_property_map(component.begin(), get(boost::vertex_index, g)));
    for (const GraphEdge& e : edges(g)) ASSERT_EQ(component[source(e, g).index()], component[target(e, g).index()]);
    std::vector<GraphEdge> tree;
    boost::kruskal_minimum_spanning_tree(g, std::back_inserter(tree));
    ASSERT_EQ(tree.size(), mesh.vertex_count() - count);
  });
  const PolygonMesh cube = lists::polygons_of(lists::cube(), lists::cube_points());
  EXPECT_TRUE(boost::boyer_myrvold_planarity_test(Graph(cube)));
  const TriangleMesh torus = lists::triangles_of(lists::torus(5, 5, true), lists::torus_points(5, 5));
  EXPECT_FALSE(boost::boyer_myrvold_planarity_test(Graph(torus)));
}

}  // namespace
}  // namespace algebra3d::mesh
