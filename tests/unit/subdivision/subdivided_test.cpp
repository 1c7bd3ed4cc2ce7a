// What holds for every scheme: links, Euler's formula, threads, interruption, limits of input.
#include "algebra3d/kernel/subdivision/subdivided.h"

#include <atomic>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "base/scheduler.h"
#include "subdivision_samples.h"

namespace algebra3d {
namespace {

using samples::faces_of;
using samples::NamedMesh;
using samples::polygon_mesh;
using Scheme = SubdivisionScheme;

const std::array kSchemes = {Scheme::catmull_clark, Scheme::doo_sabin,          Scheme::loop,
                             Scheme::butterfly,     Scheme::modified_butterfly, Scheme::sqrt3};

/// Calls test(options) for each variant of a scheme.
template <typename Test>
void for_each_variant(Scheme scheme, const Test& test) {
  for (std::size_t variant = 0; variant < std::max<std::size_t>(1, variants_of(scheme).size()); ++variant)
    ASSERT_NO_FATAL_FAILURE(test(SubdivisionOptions{variant}));
}

/// Calls test(mesh, scheme) for all manifold samples that the scheme takes.
template <typename Test>
void for_each_sample(const Test& test) {
  std::vector<NamedMesh> meshes = samples::manifold_triangle_meshes();
  const std::size_t triangle_mesh_count = meshes.size();
  for (NamedMesh& mesh : samples::manifold_polygon_meshes()) meshes.push_back(std::move(mesh));
  for (const Scheme scheme : kSchemes) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      if (i >= triangle_mesh_count && takes_triangles_only(scheme)) continue;
      SCOPED_TRACE(meshes[i].name + ", " + std::string(name_of(scheme)));
      ASSERT_NO_FATAL_FAILURE(test(meshes[i].mesh, scheme));
    }
  }
}

bool same_bits(const PolygonMesh& a, const PolygonMesh& b) {
  if (a.origins() != b.origins() || !(a.points() == b.points())) return false;
  for (const HalfedgeId h : halfedges(a))
    if (a.opposite(h) != b.opposite(h)) return false;
  for (const VertexId v : vertices(a))
    if (a.outgoing(v) != b.outgoing(v)) return false;
  return true;
}

TEST(Subdivided, links_are_those_of_the_faces) {
  for_each_sample([](const PolygonMesh& mesh, Scheme scheme) {
    for_each_variant(scheme, [&](const SubdivisionOptions& options) {
      for (std::size_t steps = 1; steps <= 2; ++steps) {
        const auto result = subdivided(mesh, scheme, steps, options);
        ASSERT_TRUE(result.ok()) << result.error().message;
        ASSERT_EQ(audit(*result), std::vector<std::string>());
        ASSERT_TRUE(same_bits(*result, PolygonMesh(result->points(), result->layout(), result->origins())));
        ASSERT_TRUE(is_manifold(*result));
      }
    });
  });
}

TEST(Subdivided, topology_stays) {
  for_each_sample([](const PolygonMesh& mesh, Scheme scheme) {
    for_each_variant(scheme, [&](const SubdivisionOptions& options) {
      const PolygonMesh result = *subdivided(mesh, scheme, 2, options);
      ASSERT_EQ(euler_characteristic(result), euler_characteristic(mesh));
      ASSERT_EQ(boundary_loops(result).size(), boundary_loops(mesh).size());
      ASSERT_EQ(connected_components(result).count, connected_components(mesh).count);
    });
  });
}

TEST(Subdivided, no_step_gives_the_mesh) {
  const PolygonMesh mesh = polygon_mesh({{0, 1, 2}, {0, 1, 2}, {0, 1, 3}});
  for (const Scheme scheme : kSchemes) EXPECT_TRUE(same_bits(*subdivided(mesh, scheme, 0), mesh));
  for (const Scheme scheme : kSchemes) EXPECT_TRUE(subdivided(PolygonMesh(), scheme, 3)->is_empty());
}

TEST(Subdivided, isolated_vertices_stay) {
  const PolygonMesh mesh = polygon_mesh({{0, 1, 3}}, {{0, 0, 0}, {1, 0, 0}, {5, 6, 7}, {0, 1, 0}});
  for (const Scheme scheme : kSchemes) {
    const PolygonMesh result = *subdivided(mesh, scheme, 1);
    EXPECT_EQ(audit(result), std::vector<std::string>());
    if (scheme == Scheme::doo_sabin) continue;
    EXPECT_TRUE(result.is_isolated(VertexId(2)));
    EXPECT_EQ(result.point(VertexId(2)).approx, (Vec3{5, 6, 7}));
  }
}

/// With more blocks than threads.
PolygonMesh large_mesh(Scheme scheme) {
  return takes_triangles_only(scheme) ? polygon_mesh(faces_of(samples::grid(60, 50, true, false)))
                                      : polygon_mesh(samples::quadrilateral_grid(70, 60));
}

TEST(Subdivided, threads_do_not_matter) {
  for (const Scheme scheme : kSchemes) {
    const PolygonMesh mesh = large_mesh(scheme);
    PolygonMesh expected;
    with_threads(1, [&] { expected = *subdivided(mesh, scheme, 2); });
    for (const int threads : {2, 16}) {
      PolygonMesh result;
      with_threads(threads, [&] { result = *subdivided(mesh, scheme, 2); });
      EXPECT_TRUE(same_bits(result, expected)) << name_of(scheme) << ", " << threads;
    }
  }
}

TEST(Subdivided, interruption) {
  for (const Scheme scheme : kSchemes) {
    const PolygonMesh mesh = large_mesh(scheme);
    std::atomic<bool> cancel = true;
    EXPECT_EQ(subdivided(mesh, scheme, 1, {}, {&cancel}).error().code, ErrorCode::interrupted);
    // In the middle of the work, wherever progress is reported.
    std::size_t reports = 0;
    Monitor::Report report = [&](const std::string&) { ++reports; };
    cancel = false;
    ASSERT_TRUE(subdivided(mesh, scheme, 2, {}, {&cancel, &report}).ok());
    EXPECT_GT(reports, 2U);
    const std::size_t all = reports;
    for (std::size_t stop = 1; stop <= all; stop += 1 + all / 7) {
      cancel = false;
      reports = 0;
      report = [&](const std::string&) { cancel = ++reports == stop || cancel; };
      const auto result = subdivided(mesh, scheme, 2, {}, {&cancel, &report});
      // Which reports come depends on the threads.
      if (reports < stop) continue;
      ASSERT_FALSE(result.ok()) << name_of(scheme) << ", report " << stop;
      ASSERT_EQ(result.error().code, ErrorCode::interrupted);
    }
  }
}

TEST(Subdivided, progress_names_the_step) {
  std::vector<std::string> told;
  const Monitor::Report report = [&](const std::string& how_far) { told.push_back(how_far); };
  ASSERT_TRUE(subdivided(polygon_mesh(samples::cube()), Scheme::catmull_clark, 2, {}, {nullptr, &report}).ok());
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front(), "subdividing, step 1 of 2");
}

void expect_error(const PolygonMesh& mesh, Scheme scheme, std::size_t steps, ErrorCode code,
                  const std::string& message) {
  const auto result = subdivided(mesh, scheme, steps);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, code);
  EXPECT_EQ(result.error().message, message);
}

TEST(Subdivided, input_that_is_refused) {
  expect_error(polygon_mesh(samples::cube()), Scheme::loop, 1, ErrorCode::invalid_value,
               "face 0 has 4 corners, but loop takes triangles only; triangulate the mesh first");
  expect_error(polygon_mesh({{0, 1, 2}, {0, 1, 3}}), Scheme::catmull_clark, 1, ErrorCode::invalid_value,
               "the edge between vertices 0 and 1 is non-manifold: 2 half-edges run along it, expected two in opposite "
               "directions, or one at the boundary");
  expect_error(polygon_mesh({{0, 1, 2}, {0, 3, 4}}), Scheme::loop, 1, ErrorCode::invalid_value,
               "vertex 0 is non-manifold: its faces form 2 fans, expected one; components divides solids and surfaces "
               "that touch in vertices");
  for (const Scheme scheme :
       {Scheme::doo_sabin, Scheme::loop, Scheme::butterfly, Scheme::modified_butterfly, Scheme::sqrt3})
    expect_error(
        polygon_mesh({{0, 1, 2}, {0, 2, 1}}), scheme, 1, ErrorCode::invalid_value,
        "vertex 0 has 2 edges and is on no boundary, but " + std::string(name_of(scheme)) + " needs three edges");
  expect_error(polygon_mesh({{0, 1, 2, 1}}), Scheme::catmull_clark, 1, ErrorCode::invalid_value,
               "face 0 is on both sides of the edge between vertices 0 and 1; triangulate the mesh first");
  expect_error(polygon_mesh({{0, 1, 2}}, {{0, 0, 0}, {1, 0, 0}, {0, 1e300, 0}}), Scheme::loop, 1,
               ErrorCode::limit_exceeded, "vertex 2 has a coordinate beyond 2^960");
  expect_error(polygon_mesh(samples::cube()), Scheme::catmull_clark, 14, ErrorCode::limit_exceeded,
               "14 steps make more than 2147483645 half-edges of 24; at most 13 steps are possible");
  expect_error(polygon_mesh(samples::cube()), Scheme::catmull_clark, 1'000'000'000'000, ErrorCode::limit_exceeded,
               "1000000000000 steps make more than 2147483645 half-edges of 24; at most 13 steps are possible");
  expect_error(polygon_mesh(faces_of(samples::tetrahedron())), Scheme::sqrt3, 18, ErrorCode::limit_exceeded,
               "18 steps make more than 2147483645 half-edges of 12; at most 17 steps are possible");
  // A square of 4 half-edges has 32 after a step of Doo-Sabin and 160 after two: 4 (h + b), with b doubled.
  expect_error(polygon_mesh({{0, 1, 2, 3}}), Scheme::doo_sabin, 14, ErrorCode::limit_exceeded,
               "14 steps make more than 2147483645 half-edges of 4; at most 13 steps are possible");
}

TEST(Subdivided, two_triangles_back_to_back) {
  const PolygonMesh result = *subdivided(polygon_mesh({{0, 1, 2}, {0, 2, 1}}), Scheme::catmull_clark, 3);
  EXPECT_EQ(audit(result), std::vector<std::string>());
  EXPECT_EQ(euler_characteristic(result), 2);
}

/// An annulus of one octagon that meets itself in an edge.
TEST(Subdivided, face_beside_itself) {
  const PolygonMesh mesh = polygon_mesh({{0, 1, 2, 0, 3, 4, 5, 3}});
  const PolygonMesh result = *subdivided(mesh, Scheme::doo_sabin, 2);
  EXPECT_EQ(audit(result), std::vector<std::string>());
  EXPECT_EQ(euler_characteristic(result), euler_characteristic(mesh));
}

/// The cost of a step is not the square of the edges at a vertex or of the corners of a face: that would take minutes.
TEST(Subdivided, large_fans_and_faces) {
  constexpr std::uint32_t kCount = 50'000;
  const PolygonMesh fan = polygon_mesh(faces_of(samples::fan(kCount, true)));
  for (const Scheme scheme : kSchemes) EXPECT_GE(subdivided(fan, scheme, 1)->face_count(), kCount);
  std::vector<std::uint32_t> face(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) face[i] = i;
  EXPECT_EQ(subdivided(polygon_mesh({face}), Scheme::doo_sabin, 1)->halfedge_count(), 8 * kCount);
}

TEST(Subdivided, flat_meshes_stay_in_their_plane) {
  for_each_sample([](const PolygonMesh& mesh, Scheme scheme) {
    std::vector<Vec3> points;
    for (const Vec3& p : mesh.points().approx()) points.push_back({p.x, p.y, 3});
    const PolygonMesh flat(PointArray(std::move(points)), mesh.layout(), mesh.origins());
    const PolygonMesh result = *subdivided(flat, scheme, 2);
    for (const Vec3& p : result.points().approx()) ASSERT_NEAR(p.z, 3, 1e-13);
  });
}

/// As many half-edges as check_input counts on.
TEST(Subdivided, sizes) {
  for_each_sample([](const PolygonMesh& mesh, Scheme scheme) {
    std::size_t boundary = 0;
    for (const HalfedgeId h : halfedges(mesh)) boundary += mesh.is_boundary(h) ? 1 : 0;
    const std::size_t h = mesh.halfedge_count(), made = subdivided(mesh, scheme, 2)->halfedge_count();
    if (scheme == Scheme::doo_sabin) {
      ASSERT_EQ(made, 16 * h + 24 * boundary);
    } else {
      ASSERT_EQ(made, scheme == Scheme::sqrt3 ? 9 * h : 16 * h);
    }
  });
}

TEST(SubdivisionScheme, names) {
  ASSERT_EQ(subdivision_schemes().size(), kSchemes.size());
  for (const Scheme scheme : kSchemes) EXPECT_EQ(subdivision_scheme(name_of(scheme)), scheme);
  EXPECT_FALSE(subdivision_scheme("Loop").has_value());
  EXPECT_EQ(subdivision_scheme_names(), "catmull-clark, doo-sabin, loop, butterfly, modified-butterfly, sqrt3");
  EXPECT_EQ(subdivision_scheme_names(has_limit), "catmull-clark, doo-sabin, loop");
  EXPECT_EQ(subdivision_scheme_names(honours_creases), "catmull-clark, loop");
  EXPECT_EQ(*subdivision_variant(Scheme::loop, "warren"), 1U);
  EXPECT_EQ(*subdivision_variant(Scheme::doo_sabin, "doo"), 1U);
  EXPECT_FALSE(subdivision_variant(Scheme::loop, "").ok());
  EXPECT_TRUE(variants_of(Scheme::sqrt3).empty());
}

}  // namespace
}  // namespace algebra3d
