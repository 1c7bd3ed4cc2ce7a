// Limit positions: what repeated steps approach, and limits that are known.
#include <cmath>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/kernel/subdivision/subdivided.h"
#include "subdivision_samples.h"
#include "support/rounds.h"

namespace algebra3d {
namespace {

using samples::faces_of;
using samples::polygon_mesh;
using Scheme = SubdivisionScheme;

double largest_distance(const PolygonMesh& limit, const PolygonMesh& mesh) {
  double largest = 0;
  for (const VertexId v : vertices(limit))
    largest = std::max(largest, length(limit.point(v).approx - mesh.point(v).approx));
  return largest;
}

/// Steps bring vertices ever nearer to their limits, and limits do not change by a step.
void expect_limit(const PolygonMesh& mesh, Scheme scheme, const SubdivisionOptions& options = {}) {
  const auto limit = limit_mesh(mesh, scheme, options);
  ASSERT_TRUE(limit.ok()) << limit.error().message;
  ASSERT_EQ(audit(*limit), std::vector<std::string>());
  ASSERT_EQ(limit->origins(), mesh.origins());
  const double at_start = largest_distance(*limit, mesh);
  const PolygonMesh refined = *subdivided(mesh, scheme, 3, options);
  EXPECT_LE(largest_distance(*limit, refined), at_start / 4 + 1e-13);
  EXPECT_LE(largest_distance(*limit, *limit_mesh(refined, scheme, options)), 1e-13);
}

TEST(LimitMesh, steps_approach_it) {
  for (const auto& [name, mesh] : samples::manifold_triangle_meshes()) {
    SCOPED_TRACE(name);
    ASSERT_NO_FATAL_FAILURE(expect_limit(mesh, Scheme::loop, samples::variant(Scheme::loop, "warren")));
    if (mesh.face_count() > 20) continue;
    ASSERT_NO_FATAL_FAILURE(expect_limit(mesh, Scheme::catmull_clark));
  }
  for (const auto& [name, mesh] : samples::manifold_polygon_meshes()) {
    SCOPED_TRACE(name);
    ASSERT_NO_FATAL_FAILURE(expect_limit(mesh, Scheme::catmull_clark));
  }
}

TEST(LimitMesh, eight_steps_are_within_a_thousandth) {
  for (const auto& triangles :
       {samples::tetrahedron(), samples::octahedron(), samples::icosahedron(), samples::grid(2, 2, false, false)}) {
    const PolygonMesh mesh = polygon_mesh(faces_of(triangles));
    for (const char* name : {"loop", "warren"}) {
      const SubdivisionOptions weights = samples::variant(Scheme::loop, name);
      const PolygonMesh refined = *subdivided(mesh, Scheme::loop, 7, weights);
      EXPECT_LE(largest_distance(*limit_mesh(mesh, Scheme::loop, weights), refined), 1e-3);
    }
  }
  const PolygonMesh cube = polygon_mesh(samples::cube());
  EXPECT_LE(largest_distance(*limit_mesh(cube, Scheme::catmull_clark), *subdivided(cube, Scheme::catmull_clark, 8)),
            1e-3);
}

/// The mask on quadrilaterals themselves: (16 v + 4 e + f) / 36 with four edges, (9 v + 4 e + f) / 24 with three.
TEST(LimitMesh, catmull_clark_masks) {
  for (const auto& faces : {samples::cube(), samples::quadrilateral_grid(4, 3)}) {
    const PolygonMesh mesh = polygon_mesh(faces);
    const PolygonMesh limit = *limit_mesh(mesh, Scheme::catmull_clark);
    for (const VertexId v : vertices(mesh)) {
      if (mesh.is_boundary(mesh.outgoing(v))) continue;
      Vec3 sum;
      double n = 0;
      for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
        sum = sum + 4 * mesh.point(mesh.target(h)).approx + mesh.point(mesh.target(mesh.next(h))).approx;
        ++n;
      }
      const Vec3 expected = (1 / (n * (n + 5))) * (n * n * mesh.point(v).approx + sum);
      EXPECT_LE(length(limit.point(v).approx - expected), 1e-14);
    }
  }
}

/// Regular parts are B-splines and box splines, of which these are known values: (v * 6 + neighbours) / 12 for Loop,
/// and (a + 4 b + c) / 6 on every boundary.
TEST(LimitMesh, regular_values) {
  const PolygonMesh grid = polygon_mesh(faces_of(samples::torus(5, 7)));
  const PolygonMesh limit = *limit_mesh(grid, Scheme::loop);
  for (const VertexId v : vertices(grid)) {
    Vec3 sum = 6 * grid.point(v).approx;
    for (const VertexId u : adjacent_vertices(grid, v)) sum = sum + grid.point(u).approx;
    EXPECT_LE(length(limit.point(v).approx - (1.0 / 12) * sum), 1e-14);
  }
  const PolygonMesh square = polygon_mesh({{0, 1, 2, 3}}, {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}});
  EXPECT_EQ(limit_mesh(square, Scheme::catmull_clark)->point(VertexId(0)).approx, (Vec3{1, 1, 0}));
}

/// The face that Doo-Sabin makes of a vertex keeps its number among the faces, since later steps write faces first.
TEST(LimitMesh, doo_sabin_faces_of_vertices_shrink_to_it) {
  std::vector<samples::NamedMesh> meshes = samples::manifold_polygon_meshes();
  for (auto& mesh : samples::manifold_triangle_meshes()) meshes.push_back(std::move(mesh));
  std::erase_if(meshes, [](const auto& named) { return named.mesh.halfedge_count() > 50; });
  meshes.resize(std::min<std::size_t>(meshes.size(), 20));
  for (const auto& [name, mesh] : meshes) {
    for (const char* rules : {"mean", "doo"}) {
      SCOPED_TRACE(name + ", " + rules);
      const SubdivisionOptions options = samples::variant(Scheme::doo_sabin, rules);
      const PolygonMesh limit = *limit_mesh(mesh, Scheme::doo_sabin, options);
      ASSERT_EQ(limit.origins(), mesh.origins());
      const int steps = is_thorough() ? 7 : 6;
      const PolygonMesh refined = *subdivided(mesh, Scheme::doo_sabin, steps, options);
      auto face = static_cast<std::uint32_t>(mesh.face_count() + element_count(mesh, MeshElement::edge));
      for (const VertexId v : vertices(mesh)) {
        const Vec3 p = limit.point(v).approx;
        if (mesh.is_isolated(v)) {
          EXPECT_EQ(p, mesh.point(v).approx);
          continue;
        }
        const FaceId of_vertex(face++);
        if (mesh.is_boundary(mesh.outgoing(v))) continue;
        Vec3 sum;
        for (const VertexId u : vertices_of(refined, of_vertex)) {
          ASSERT_LE(length(refined.point(u).approx - p), 128.0 / (1 << steps));
          sum = sum + refined.point(u).approx;
        }
        ASSERT_LE(length((1.0 / refined.degree(of_vertex)) * sum - p), 1e-12);
      }
    }
  }
}

/// The quadratic B-spline at a control point has 1/8, 3/4 and 1/8; its points after many steps of corner cutting are
/// dense on it.
TEST(LimitMesh, doo_sabin_boundary_is_a_quadratic_spline) {
  const PolygonMesh square = polygon_mesh({{0, 1, 2, 3}}, {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}});
  EXPECT_EQ(limit_mesh(square, Scheme::doo_sabin)->point(VertexId(0)).approx, (Vec3{1, 1, 0}));
  const PolygonMesh mesh = polygon_mesh(samples::mixed_faces());
  const PolygonMesh limit = *limit_mesh(mesh, Scheme::doo_sabin), refined = *subdivided(mesh, Scheme::doo_sabin, 8);
  for (const VertexId v : vertices(mesh)) {
    if (!mesh.is_boundary(mesh.outgoing(v))) continue;
    double nearest = 1e9;
    for (const VertexId u : vertices(refined))
      if (refined.is_boundary(refined.outgoing(u)))
        nearest = std::min(nearest, length(refined.point(u).approx - limit.point(v).approx));
    EXPECT_LE(nearest, 0.15);
  }
}

TEST(LimitMesh, doo_sabin_open_boundary) {
  const SubdivisionOptions open = samples::variant(Scheme::doo_sabin, "open");
  const auto refused = limit_mesh(polygon_mesh(samples::quadrilateral_grid(2, 2)), Scheme::doo_sabin, open);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message,
            "vertex 0 is on the boundary, where the rule open makes no faces, so it has no limit");
  const PolygonMesh cube = polygon_mesh(samples::cube());
  EXPECT_EQ(limit_mesh(cube, Scheme::doo_sabin, open)->points(), limit_mesh(cube, Scheme::doo_sabin)->points());
}

/// Numbers of vertices go where the points go.
TEST(LimitMesh, attributes_that_equal_the_coordinates) {
  const PolygonMesh mesh = polygon_mesh(samples::cube());
  AttributeValues values(AttributeKind::vector, mesh.vertex_count());
  for (const VertexId v : vertices(mesh)) {
    const Vec3 p = mesh.point(v).approx;
    values.set(v.index(), std::array{p.x, p.y, p.z});
  }
  const auto attributes = MeshAttributes().with(MeshElement::vertex, "p", values);
  for (const Scheme& scheme : {Scheme::catmull_clark, Scheme::doo_sabin}) {
    const SubdividedMesh limit = *limit_mesh(mesh, attributes, scheme);
    for (const VertexId v : vertices(mesh)) {
      const auto p = limit.attributes.find(MeshElement::vertex, "p")->values->numbers(v.index());
      EXPECT_EQ((Vec3{p[0], p[1], p[2]}), limit.mesh.point(v).approx);
    }
  }
}

TEST(LimitMesh, errors) {
  EXPECT_EQ(limit_mesh(polygon_mesh(samples::cube()), Scheme::loop).error().code, ErrorCode::invalid_value);
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(limit_mesh(polygon_mesh(samples::cube()), Scheme::catmull_clark, {}, {&cancel}).error().code,
            ErrorCode::interrupted);
  EXPECT_TRUE(limit_mesh(PolygonMesh(), Scheme::loop)->is_empty());
}

}  // namespace
}  // namespace algebra3d
