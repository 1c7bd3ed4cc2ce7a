// The nine adjacency relations and the numbers of edges against searches in lists of polygons.
#include "algebra3d/kernel/halfedge/adjacency.h"

#include <set>

#include <gtest/gtest.h>

#include "algebra3d/halfedge/edge_numbers.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "polygon_lists.h"

namespace algebra3d {
namespace {

using samples::PolygonList;
using NumberSet = std::set<std::uint32_t>;
using Ends = std::pair<std::uint32_t, std::uint32_t>;

/// Which corners each face has, which edges it has by their ends, and the edges in order of their first half-edges.
struct Searched {
  explicit Searched(const PolygonList& polygons) {
    for (std::uint32_t f = 0; f < polygons.size(); ++f) {
      for (std::size_t i = 0; i < polygons[f].size(); ++i) {
        const std::uint32_t a = polygons[f][i], b = polygons[f][(i + 1) % polygons[f].size()];
        const Ends ends = std::minmax({a, b});
        const auto number = static_cast<std::uint32_t>(edges.size());
        if (numbers.emplace(ends, number).second) {
          edges.push_back(ends);
          faces_of_edge.emplace_back();
        }
        const std::uint32_t edge = numbers.at(ends);
        faces_of_edge[edge].insert(f);
        edges_of_face[f].insert(edge);
        faces_of_vertex[a].insert(f);
        edges_of_vertex[a].insert(edge);
        edges_of_vertex[b].insert(edge);
        neighbours[a].insert(b);
        neighbours[b].insert(a);
      }
    }
  }
  std::vector<Ends> edges;
  std::map<Ends, std::uint32_t> numbers;
  std::vector<NumberSet> faces_of_edge;
  std::map<std::uint32_t, NumberSet> edges_of_face, faces_of_vertex, edges_of_vertex, neighbours;
};

template <typename Id>
NumberSet indices(const std::vector<Id>& elements) {
  NumberSet result;
  for (const Id id : elements) EXPECT_TRUE(result.insert(id.index()).second) << "repeated: " << id.index();
  return result;
}
NumberSet edge_indices(const EdgeNumbers& numbers, const std::vector<HalfedgeId>& edges) {
  std::vector<EdgeId> ids;
  for (const HalfedgeId h : edges) ids.push_back(numbers.edge(h));
  return indices(ids);
}
NumberSet found(const std::map<std::uint32_t, NumberSet>& map, std::uint32_t key) {
  const auto place = map.find(key);
  return place == map.end() ? NumberSet() : place->second;
}
NumberSet without(NumberSet numbers, std::uint32_t number) {
  numbers.erase(number);
  return numbers;
}

template <typename Layout>
void expect_relations(const HalfedgeMesh<Layout>& mesh, const PolygonList& polygons) {
  const Searched searched(polygons);
  const EdgeNumbers numbers(mesh);
  ASSERT_EQ(numbers.count(), searched.edges.size());
  for (const VertexId v : vertices(mesh)) {
    ASSERT_EQ(indices(vertices_beside(mesh, v)), found(searched.neighbours, v.index()));
    ASSERT_EQ(edge_indices(numbers, edges_at(mesh, v)), found(searched.edges_of_vertex, v.index()));
    ASSERT_EQ(indices(faces_at(mesh, v)), found(searched.faces_of_vertex, v.index()));
    ASSERT_EQ(valence(mesh, v), found(searched.edges_of_vertex, v.index()).size());
  }
  for (std::uint32_t edge = 0; edge < numbers.count(); ++edge) {
    const HalfedgeId h = numbers.first_halfedge(EdgeId(edge));
    ASSERT_EQ(first_along(mesh, h), h);
    ASSERT_EQ(numbers.edge(h), EdgeId(edge));
    const Ends ends = searched.edges[edge];
    ASSERT_EQ(indices(vertices_of_edge(mesh, h)), (NumberSet{ends.first, ends.second}));
    ASSERT_EQ(indices(faces_along(mesh, h)), searched.faces_of_edge[edge]);
    NumberSet beside = found(searched.edges_of_vertex, ends.first);
    beside.merge(found(searched.edges_of_vertex, ends.second));
    ASSERT_EQ(edge_indices(numbers, edges_beside(mesh, h)), without(beside, edge));
  }
  for (const FaceId f : faces(mesh)) {
    const auto& polygon = polygons[f.index()];
    ASSERT_EQ(indices(vertices_of_face(mesh, f)), NumberSet(polygon.begin(), polygon.end()));
    const NumberSet edges = found(searched.edges_of_face, f.index());
    ASSERT_EQ(edge_indices(numbers, edges_of_face(mesh, f)), edges);
    NumberSet beside;
    for (const std::uint32_t edge : edges)
      beside.insert(searched.faces_of_edge[edge].begin(), searched.faces_of_edge[edge].end());
    ASSERT_EQ(indices(faces_beside(mesh, f)), without(beside, f.index()));
  }
}

TEST(Adjacency, of_polygons_is_what_searches_find) {
  for (const PolygonList& polygons : samples::all_polygon_lists())
    ASSERT_NO_FATAL_FAILURE(expect_relations(samples::polygon_mesh(polygons), polygons));
}

TEST(Adjacency, of_triangles_is_what_searches_find) {
  for (const auto& triangles : samples::all_kinds())
    ASSERT_NO_FATAL_FAILURE(expect_relations(samples::mesh_of(triangles), samples::polygons_of(triangles)));
}

TEST(Adjacency, of_a_large_fan_has_each_element_once) {
  constexpr std::uint32_t kCount = 100'000;
  samples::Triangles fan;
  for (std::uint32_t i = 0; i < kCount; ++i) fan.push_back({0, 1 + i, 1 + (i + 1) % kCount});
  const TriangleMesh mesh(PointArray(std::vector<Vec3>(kCount + 1)), fan);
  EXPECT_EQ(vertices_beside(mesh, VertexId(0)).size(), kCount);
  EXPECT_EQ(edges_at(mesh, VertexId(0)).size(), kCount);
  EXPECT_EQ(faces_at(mesh, VertexId(0)).size(), kCount);
  EXPECT_EQ(valence(mesh, VertexId(0)), kCount);
  EXPECT_EQ(edges_beside(mesh, HalfedgeId(0)).size(), kCount + 1);
}

}  // namespace
}  // namespace algebra3d
