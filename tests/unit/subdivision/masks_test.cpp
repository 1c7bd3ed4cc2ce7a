// One step of each scheme against the masks of the papers in rational numbers.
#include <cmath>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/subdivided.h"
#include "reference_steps.h"
#include "subdivision_samples.h"

namespace algebra3d {
namespace {

using reference::Polygons;
using reference::Reference;
using samples::faces_of;
using samples::polygon_mesh;
using Scheme = SubdivisionScheme;

/// Same numbers, same faces; coordinates equal, or with the rounding that weights such as 1/9 need.
void expect_mesh(const PolygonMesh& mesh, const Polygons& expected, double tolerance) {
  ASSERT_EQ(mesh.vertex_count(), expected.points.size());
  ASSERT_EQ(mesh.face_count(), expected.faces.size());
  for (const FaceId f : faces(mesh)) {
    std::vector<std::uint32_t> corners;
    for (const VertexId v : vertices_of(mesh, f)) corners.push_back(v.index());
    ASSERT_EQ(corners, expected.faces[f.index()]) << "face " << f.index();
  }
  for (const VertexId v : vertices(mesh)) {
    const RationalVec3 point = mesh.point(v).rational();
    const RationalVec3& wanted = expected.points[v.index()];
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_LE((point[axis] - wanted[axis]).abs().nearest_double(), tolerance) << "vertex " << v.index();
  }
}

constexpr double kExact = 0;
constexpr double kRounded = 16 * 4 * 0x1p-53;  // coordinates up to 16

Polygons loop_reference(const PolygonMesh& mesh) {
  return Reference(mesh).loop([](std::int64_t n) {
    const Rational inner = Rational(3, 8) + Reference::cosine(1, n) / Rational(4);
    return (Rational(5, 8) - inner * inner) / Rational(n);
  });
}
Polygons warren_reference(const PolygonMesh& mesh) {
  return Reference(mesh).loop([](std::int64_t n) { return n == 3 ? Rational(3, 16) : Rational(3, 8 * n); });
}

TEST(CatmullClark, cube) {
  const PolygonMesh mesh = polygon_mesh(samples::cube());
  expect_mesh(*subdivided(mesh, Scheme::catmull_clark, 1), Reference(mesh).catmull_clark(), kRounded);
}

TEST(CatmullClark, unit_cube_by_hand) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back({i % 2 * 18.0, i / 2 % 2 * 18.0, i / 4 * 18.0});
  const PolygonMesh result = *subdivided(polygon_mesh(samples::cube(), points), Scheme::catmull_clark, 1);
  // Vertices move by 2/9 towards the middle; edge points are (18 + 18/2 ...)/4 inward: 9/4 * ... of the faces' middles.
  EXPECT_NEAR(result.point(VertexId(0)).approx.x, 4, 1e-14);
  EXPECT_EQ(result.point(VertexId(8)).approx, (Vec3{2.25, 9, 2.25}));  // edge 0-2
  EXPECT_EQ(result.point(VertexId(20)).approx, (Vec3{9, 9, 0}));       // face z = 0
}

TEST(CatmullClark, open_grid_is_exact) {
  const PolygonMesh mesh = polygon_mesh(samples::quadrilateral_grid(4, 3));
  expect_mesh(*subdivided(mesh, Scheme::catmull_clark, 1), Reference(mesh).catmull_clark(), kExact);
}

TEST(CatmullClark, polygons_and_triangles) {
  for (const auto& [name, mesh] : samples::manifold_polygon_meshes()) {
    SCOPED_TRACE(name);
    expect_mesh(*subdivided(mesh, Scheme::catmull_clark, 1), Reference(mesh).catmull_clark(), kRounded);
  }
  const PolygonMesh mesh = polygon_mesh(faces_of(samples::icosahedron()));
  expect_mesh(*subdivided(mesh, Scheme::catmull_clark, 1), Reference(mesh).catmull_clark(), kRounded);
}

TEST(Loop, exact_where_weights_are_binary) {
  for (const auto& triangles :
       {samples::tetrahedron(), samples::octahedron(), samples::torus(5, 7), samples::grid(4, 3, false, false),
        samples::grid(1, 1, false, false), samples::Triangles{{0, 1, 2}}}) {
    const PolygonMesh mesh = polygon_mesh(faces_of(triangles));
    expect_mesh(*subdivided(mesh, Scheme::loop, 1), loop_reference(mesh), kExact);
  }
}

TEST(Loop, icosahedron) {
  const PolygonMesh mesh = polygon_mesh(faces_of(samples::icosahedron()));
  expect_mesh(*subdivided(mesh, Scheme::loop, 1, {LoopWeights::warren}), warren_reference(mesh), kRounded);
  // cos(72 degrees) is (sqrt(5) - 1) / 4.
  const double inner = 3.0 / 8 + (std::sqrt(5.0) - 1) / 16, weight = (5.0 / 8 - inner * inner) / 5;
  const PolygonMesh result = *subdivided(mesh, Scheme::loop, 1);
  Vec3 expected = (1 - 5 * weight) * mesh.point(VertexId(0)).approx;
  for (const VertexId v : adjacent_vertices(mesh, VertexId(0))) expected = expected + weight * mesh.point(v).approx;
  EXPECT_LE(length(result.point(VertexId(0)).approx - expected), kRounded);
}

TEST(Loop, warren) {
  for (const auto& [name, mesh] : samples::manifold_triangle_meshes()) {
    SCOPED_TRACE(name);
    ASSERT_NO_FATAL_FAILURE(
        expect_mesh(*subdivided(mesh, Scheme::loop, 1, {LoopWeights::warren}), warren_reference(mesh), kRounded));
  }
}

TEST(Butterfly, all_meshes_are_exact) {
  for (const auto& [name, mesh] : samples::manifold_triangle_meshes()) {
    SCOPED_TRACE(name);
    ASSERT_NO_FATAL_FAILURE(
        expect_mesh(*subdivided(mesh, Scheme::butterfly, 1), Reference(mesh).butterfly(false), kExact));
  }
}

TEST(ModifiedButterfly, regular_and_few_edges) {
  for (const auto& triangles : {samples::octahedron(), samples::torus(5, 7), samples::grid(4, 3, false, false),
                                samples::grid(1, 1, false, false), samples::grid(1, 5, false, false),
                                samples::grid(4, 3, true, false), samples::Triangles{{0, 1, 2}}}) {
    const PolygonMesh mesh = polygon_mesh(faces_of(triangles));
    ASSERT_NO_FATAL_FAILURE(
        expect_mesh(*subdivided(mesh, Scheme::modified_butterfly, 1), Reference(mesh).butterfly(true), kExact));
  }
  const PolygonMesh mesh = polygon_mesh(faces_of(samples::tetrahedron()));
  expect_mesh(*subdivided(mesh, Scheme::modified_butterfly, 1), Reference(mesh).butterfly(true), kRounded);
}

/// The masks between regular vertices are exact for quadratic functions, also beside the boundary.
TEST(ModifiedButterfly, regular_vertices_reproduce_quadratic_functions) {
  for (const auto& [m, n] : {std::pair(6U, 5U), {2U, 6U}, {3U, 3U}}) {
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i <= m; ++i)
      for (std::uint32_t j = 0; j <= n; ++j) {
        const double x = 4.0 * i + j, y = 2.0 * j - i;
        points.push_back({x, y, x * x - 3 * x * y + 2 * y * y + x});
      }
    const PolygonMesh mesh = polygon_mesh(faces_of(samples::grid(m, n, false, false)), points);
    const PolygonMesh result = *subdivided(mesh, Scheme::modified_butterfly, 1);
    std::size_t seen = 0, made = mesh.vertex_count();
    for (const HalfedgeId h : edges(mesh)) {
      const Vec3 p = result.point(VertexId(made++)).approx;
      const auto valence = [&](VertexId v) { return std::ranges::distance(adjacent_vertices(mesh, v)); };
      const VertexId a = mesh.origin(h), b = mesh.target(h);
      // Corners have two or three neighbours, other vertices of the boundary four.
      const bool is_regular = (valence(a) == 4 || valence(a) == 6) && (valence(b) == 4 || valence(b) == 6);
      if (!is_regular || mesh.is_boundary(h)) continue;
      EXPECT_EQ(p.z, p.x * p.x - 3 * p.x * p.y + 2 * p.y * p.y + p.x);
      EXPECT_EQ(p.x, 0.5 * (mesh.point(a).approx.x + mesh.point(b).approx.x));
      EXPECT_EQ(p.y, 0.5 * (mesh.point(a).approx.y + mesh.point(b).approx.y));
      ++seen;
    }
    EXPECT_GT(seen, 3U);
  }
}

TEST(DooSabin, faces_with_rational_weights) {
  for (const auto& faces :
       {samples::cube(), faces_of(samples::tetrahedron()), faces_of(samples::icosahedron()),
        samples::quadrilateral_grid(4, 3), samples::quadrilateral_grid(1, 1), samples::Faces{{0, 1, 2, 3, 4, 5}}}) {
    const PolygonMesh mesh = polygon_mesh(faces);
    const double tolerance = mesh.common_degree() == 4 ? kExact : kRounded;
    ASSERT_NO_FATAL_FAILURE(
        expect_mesh(*subdivided(mesh, Scheme::doo_sabin, 1), Reference(mesh).doo_sabin(), tolerance));
  }
}

}  // namespace
}  // namespace algebra3d
