// One and two steps against CGAL's subdivision, which numbers vertices and faces in its own way: points are compared as
// sets, and faces by their middles.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/subdivision/subdivided.h"
#include "subdivision_samples.h"

namespace algebra3d {
namespace {

namespace method = CGAL::Subdivision_method_3;
using CgalMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using samples::polygon_mesh;
using Scheme = SubdivisionScheme;

/// Nothing if CGAL refuses a face.
bool to_cgal(const PolygonMesh& mesh, CgalMesh& result) {
  for (const Vec3& p : mesh.points().approx()) result.add_vertex({p.x, p.y, p.z});
  for (const FaceId f : faces(mesh)) {
    std::vector<CgalMesh::Vertex_index> corners;
    for (const VertexId v : vertices_of(mesh, f)) corners.emplace_back(v.index());
    if (result.add_face(corners) == CgalMesh::null_face()) return false;
  }
  return true;
}

/// Points in the order of coordinates that are rounded to 2^-20, so that roundings do not change it.
std::vector<Vec3> sorted(std::vector<Vec3> points) {
  const auto key = [](const Vec3& p) {
    return Vec3{std::nearbyint(p.x * 0x1p20), std::nearbyint(p.y * 0x1p20), std::nearbyint(p.z * 0x1p20)};
  };
  std::ranges::sort(points, {}, key);
  return points;
}

void expect_same_points(const std::vector<Vec3>& ours, const std::vector<Vec3>& theirs) {
  ASSERT_EQ(ours.size(), theirs.size());
  const auto a = sorted(ours), b = sorted(theirs);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LE(length(a[i] - b[i]), 1e-12);
}

Vec3 point_of(const CgalMesh& mesh, CgalMesh::Vertex_index v) {
  const auto& p = mesh.point(v);
  return {p.x(), p.y(), p.z()};
}

std::vector<Vec3> middles(const PolygonMesh& mesh) {
  std::vector<Vec3> result;
  for (const FaceId f : faces(mesh)) {
    Vec3 sum;
    for (const VertexId v : vertices_of(mesh, f)) sum = sum + mesh.point(v).approx;
    result.push_back(sum);
  }
  return result;
}
std::vector<Vec3> middles(const CgalMesh& mesh) {
  std::vector<Vec3> result;
  for (const auto f : mesh.faces()) {
    Vec3 sum;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) sum = sum + point_of(mesh, v);
    result.push_back(sum);
  }
  return result;
}

/// Calls subdivide(theirs, steps) for samples without isolated vertices.
template <typename Subdivide>
void compare(const std::vector<samples::NamedMesh>& meshes, Scheme scheme, const Subdivide& subdivide,
             const SubdivisionOptions& options = {}, unsigned most_steps = 2) {
  std::size_t count = 0;
  for (const auto& [name, mesh] : meshes) {
    const bool has_isolated = std::ranges::any_of(vertices(mesh), [&](VertexId v) { return mesh.is_isolated(v); });
    CgalMesh original;
    if (has_isolated || mesh.is_empty() || !to_cgal(mesh, original)) continue;
    SCOPED_TRACE(name);
    for (unsigned steps = 1; steps <= most_steps; ++steps) {
      CgalMesh theirs = original;
      subdivide(theirs, CGAL::parameters::number_of_iterations(steps));
      const PolygonMesh ours = *subdivided(mesh, scheme, steps, options);
      std::vector<Vec3> points;
      for (const auto v : theirs.vertices()) points.push_back(point_of(theirs, v));
      ASSERT_NO_FATAL_FAILURE(expect_same_points(ours.points().approx(), points));
      ASSERT_NO_FATAL_FAILURE(expect_same_points(middles(ours), middles(theirs)));
    }
    ++count;
  }
  EXPECT_GE(count, 3U);
}

TEST(AgainstCgal, loop) {
  compare(samples::manifold_triangle_meshes(), Scheme::loop,
          [](CgalMesh& mesh, const auto& parameters) { method::Loop_subdivision(mesh, parameters); });
}

TEST(AgainstCgal, catmull_clark) {
  const auto subdivide = [](CgalMesh& mesh, const auto& parameters) {
    method::CatmullClark_subdivision(mesh, parameters);
  };
  compare(samples::manifold_triangle_meshes(), Scheme::catmull_clark, subdivide);
  compare(samples::manifold_polygon_meshes(), Scheme::catmull_clark, subdivide);
}

TEST(AgainstCgal, doo_sabin) {
  const auto subdivide = [](CgalMesh& mesh, const auto& parameters) { method::DooSabin_subdivision(mesh, parameters); };
  // CGAL has Doo's weights and no faces at the boundary.
  const SubdivisionOptions open = samples::variant(Scheme::doo_sabin, "open");
  compare(samples::manifold_triangle_meshes(), Scheme::doo_sabin, subdivide, open);
  compare(samples::manifold_polygon_meshes(), Scheme::doo_sabin, subdivide, open);
}

TEST(AgainstCgal, sqrt3) {
  const auto subdivide = [](CgalMesh& mesh, const auto& parameters) { method::Sqrt3_subdivision(mesh, parameters); };
  compare(samples::manifold_triangle_meshes(), Scheme::sqrt3, subdivide, {}, 3);
}

}  // namespace
}  // namespace algebra3d
