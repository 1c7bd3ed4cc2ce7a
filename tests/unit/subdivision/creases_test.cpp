// Creases and corners: steps against rational masks, limits against what they must keep.
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/subdivided.h"
#include "reference_steps.h"
#include "subdivision_samples.h"
#include "support/rounds.h"

namespace algebra3d {
namespace {

using reference::Polygons;
using reference::Reference;
using samples::faces_of;
using samples::polygon_mesh;
using Scheme = SubdivisionScheme;

/// Values of edges and vertices as attributes, and for the reference.
struct Sharp {
  MeshAttributes attributes;
  Reference::Creases creases;
};

/// `of_edge()` and `of_vertex()` give the sharpness of one.
template <typename OfEdge, typename OfVertex>
Sharp sharpened(const PolygonMesh& mesh, const OfEdge& of_edge, const OfVertex& of_vertex) {
  Sharp result;
  AttributeValues edge_values(AttributeKind::real, element_count(mesh, MeshElement::edge));
  AttributeValues vertex_values(AttributeKind::real, mesh.vertex_count());
  std::size_t e = 0;
  for (const HalfedgeId h : edges(mesh)) {
    const double value = of_edge(h);
    // 0 and undefined are the same.
    if (value > 0 || e % 2 == 0) edge_values.set(e, std::array{value});
    ++e;
    if (value > 0) result.creases.edges[std::minmax(mesh.origin(h).index(), mesh.target(h).index())] = Rational(value);
  }
  for (const VertexId v : vertices(mesh)) {
    const double value = of_vertex(v);
    if (value > 0) result.creases.vertices[v.index()] = Rational(value);
    vertex_values.set(v.index(), std::array{value});
  }
  result.attributes = MeshAttributes()
                          .with(MeshElement::edge, kCreaseAttribute, edge_values)
                          .with(MeshElement::vertex, kCornerAttribute, vertex_values);
  return result;
}

/// A third of the edges and a tenth of the vertices are sharp, by one of the values.
Sharp random_creases(const PolygonMesh& mesh, std::mt19937& random, const std::vector<double>& values) {
  const auto below = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  return sharpened(
      mesh, [&](HalfedgeId) { return below(3) == 0 ? values[below(values.size())] : 0; },
      [&](VertexId) { return below(10) == 0 ? values[below(values.size())] : 0; });
}

Polygons reference_step(const PolygonMesh& mesh, const Scheme& scheme, const Reference::Creases& creases) {
  if (scheme == Scheme::catmull_clark) return Reference(mesh).catmull_clark(creases);
  return Reference(mesh).loop([](std::int64_t n) { return n == 3 ? Rational(3, 16) : Rational(3, 8 * n); }, creases);
}

SubdivisionOptions options_for(const Scheme& scheme) {
  return scheme == Scheme::loop ? samples::variant(scheme, "warren") : SubdivisionOptions();
}

std::vector<samples::NamedMesh> meshes_for(const Scheme& scheme) {
  std::vector<samples::NamedMesh> meshes = samples::manifold_triangle_meshes();
  if (scheme == Scheme::catmull_clark)
    for (auto& mesh : samples::manifold_polygon_meshes()) meshes.push_back(std::move(mesh));
  std::erase_if(meshes, [](const auto& named) { return named.mesh.halfedge_count() > 200; });
  return meshes;
}

class Creases : public testing::TestWithParam<Scheme> {};

TEST_P(Creases, steps_by_rational_masks) {
  std::mt19937 random(11);
  const Scheme scheme = GetParam();
  for (const auto& [name, mesh] : meshes_for(scheme))
    for (int round = 0; round < rounds(3); ++round) {
      SCOPED_TRACE(name);
      const Sharp sharp = random_creases(mesh, random, {0.25, 0.5, 1, 1.5, 2, 3, 10, 12});
      const auto result = subdivided(mesh, sharp.attributes, scheme, 1, options_for(scheme));
      ASSERT_TRUE(result.ok()) << result.error().message;
      const Polygons expected = reference_step(mesh, scheme, sharp.creases);
      ASSERT_EQ(result->mesh.vertex_count(), expected.points.size());
      for (const VertexId v : vertices(result->mesh)) {
        const RationalVec3 point = result->mesh.point(v).rational();
        for (std::size_t axis = 0; axis < 3; ++axis)
          ASSERT_LE((point[axis] - expected.points[v.index()][axis]).abs().nearest_double(), 0x1p-46) << v.index();
      }
    }
}

/// Halves of edges and vertices have one less after each step, down to 0, and new edges and vertices none.
TEST_P(Creases, sharpness_decreases) {
  const Scheme scheme = GetParam();
  const PolygonMesh mesh = polygon_mesh(faces_of(samples::octahedron()));
  const Sharp sharp = sharpened(
      mesh, [&](HalfedgeId h) { return h == HalfedgeId(0)   ? 1.5
                                       : h == HalfedgeId(1) ? 11.0
                                                            : 0.0; },
      [](VertexId v) { return v == VertexId(3) ? 2.25 : 0.0; });
  const SubdividedMesh result = *subdivided(mesh, sharp.attributes, scheme, 2);
  std::map<double, int> counts;
  const AttributeValues& of_edges = *result.attributes.find(MeshElement::edge, kCreaseAttribute)->values;
  for (std::size_t e = 0; e < of_edges.size(); ++e)
    if (of_edges.is_defined(e)) ++counts[of_edges.numbers(e)[0]];
  EXPECT_FALSE(counts.contains(0.5));
  EXPECT_EQ(counts[11], 4);
  const SubdividedMesh once = *subdivided(mesh, sharp.attributes, scheme, 1);
  const AttributeValues& after_one = *once.attributes.find(MeshElement::edge, kCreaseAttribute)->values;
  int halves = 0;
  for (std::size_t e = 0; e < after_one.size(); ++e)
    halves += after_one.is_defined(e) && after_one.numbers(e)[0] == 0.5 ? 1 : 0;
  EXPECT_EQ(halves, 2);
  const AttributeValues& of_vertices = *result.attributes.find(MeshElement::vertex, kCornerAttribute)->values;
  for (const VertexId v : vertices(result.mesh)) {
    ASSERT_EQ(of_vertices.is_defined(v.index()), v.index() < mesh.vertex_count());
    if (!of_vertices.is_defined(v.index())) continue;
    EXPECT_EQ(of_vertices.numbers(v.index())[0], v == VertexId(3) ? 0.25 : 0);
  }
}

/// Limits do not change by steps, and steps approach them: for infinitely sharp edges, also darts, and for semi-sharp
/// ones.
TEST_P(Creases, limits) {
  std::mt19937 random(12);
  const Scheme scheme = GetParam();
  const SubdivisionOptions options = options_for(scheme);
  for (const auto& values : {std::vector<double>{10}, {0.5, 1, 2, 15}})
    for (const auto& [name, mesh] : meshes_for(scheme)) {
      if (mesh.halfedge_count() > 60) continue;
      SCOPED_TRACE(name);
      const Sharp sharp = random_creases(mesh, random, values);
      const auto limit = limit_mesh(mesh, sharp.attributes, scheme, options);
      ASSERT_TRUE(limit.ok()) << limit.error().message;
      ASSERT_EQ(limit->mesh.origins(), mesh.origins());
      EXPECT_EQ(limit->attributes, sharp.attributes);
      const SubdividedMesh once = *subdivided(mesh, sharp.attributes, scheme, 1, options);
      const SubdividedMesh of_once = *limit_mesh(once.mesh, once.attributes, scheme, options);
      const SubdividedMesh refined = *subdivided(mesh, sharp.attributes, scheme, is_thorough() ? 6 : 4, options);
      for (const VertexId v : vertices(mesh)) {
        const Vec3 p = limit->mesh.point(v).approx;
        ASSERT_LE(length(of_once.mesh.point(v).approx - p), 1e-12) << v.index();
        ASSERT_LE(length(refined.mesh.point(v).approx - p), 0.5) << v.index();
      }
    }
}

/// An edge between two of a tetrahedron's faces that is sharp for ever is a dart at both ends; all edges sharp make
/// corners, which stay where they are.
TEST_P(Creases, corners_stay) {
  const PolygonMesh mesh = polygon_mesh(faces_of(samples::tetrahedron()));
  const Sharp all = sharpened(
      mesh, [](HalfedgeId) { return 10.0; }, [](VertexId) { return 0.0; });
  const Sharp corner = sharpened(
      mesh, [](HalfedgeId) { return 0.0; }, [](VertexId v) { return v == VertexId(2) ? 99.0 : 0.0; });
  const PolygonMesh by_edges = subdivided(mesh, all.attributes, GetParam(), 3)->mesh;
  const PolygonMesh by_vertex = subdivided(mesh, corner.attributes, GetParam(), 3)->mesh;
  for (const VertexId v : vertices(mesh)) {
    EXPECT_EQ(by_edges.point(v).approx, mesh.point(v).approx);
    EXPECT_EQ(by_vertex.point(v).approx == mesh.point(v).approx, v == VertexId(2));
    EXPECT_EQ(limit_mesh(mesh, all.attributes, GetParam())->mesh.point(v).approx, mesh.point(v).approx);
  }
}

/// A ring of sharp edges is a cubic B-spline curve: (a + 4 b + c) / 6 at its vertices.
TEST_P(Creases, two_sharp_edges_make_a_spline) {
  const PolygonMesh mesh = polygon_mesh(faces_of(samples::octahedron()));
  // The face 0 of three edges, sharp all around.
  const auto is_of_face = [&](HalfedgeId h) {
    return mesh.face(h) == FaceId(0) || (mesh.opposite(h).is_valid() && mesh.face(mesh.opposite(h)) == FaceId(0));
  };
  const Sharp ring = sharpened(
      mesh, [&](HalfedgeId h) { return is_of_face(h) ? 10.0 : 0.0; }, [](VertexId) { return 0.0; });
  const PolygonMesh limit = limit_mesh(mesh, ring.attributes, GetParam())->mesh;
  for (const HalfedgeId h : halfedges_of(mesh, FaceId(0))) {
    const Vec3 a = mesh.point(mesh.origin(mesh.prev(h))).approx, b = mesh.point(mesh.origin(h)).approx,
               c = mesh.point(mesh.target(h)).approx;
    EXPECT_LE(length(limit.point(mesh.origin(h)).approx - (1.0 / 6) * (a + 4 * b + c)), 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Creases, testing::Values(Scheme::catmull_clark, Scheme::loop));

TEST(CreaseErrors, what_is_no_sharpness) {
  const PolygonMesh mesh = polygon_mesh(faces_of(samples::tetrahedron()));
  AttributeValues negative(AttributeKind::real, 6);
  negative.set(4, std::array{-0.5});
  const auto refused = subdivided(mesh, MeshAttributes().with(MeshElement::edge, "Crease", negative), Scheme::loop, 1);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "edge 4 has Crease -0.5, expected 0 or more");
  const auto of_texts = MeshAttributes().with(MeshElement::vertex, "Corner", AttributeValues(AttributeKind::text, 4));
  const auto refused_texts = subdivided(mesh, of_texts, Scheme::catmull_clark, 1);
  ASSERT_FALSE(refused_texts.ok());
  EXPECT_EQ(refused_texts.error().message,
            "the vertex attribute Corner is the sharpness of creases, expected kind real, got text");
  // Other schemes take them as any attribute.
  EXPECT_TRUE(subdivided(mesh, of_texts, Scheme::butterfly, 1).ok());
}

}  // namespace
}  // namespace algebra3d
