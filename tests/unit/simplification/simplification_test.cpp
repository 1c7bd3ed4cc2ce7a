// Simplified meshes: known results, targets, topology, deviations measured by CGAL at many points, and the validity of
// surfaces and solids by the proof and by CGAL.
#include "algebra3d/kernel/simplification/simplification.h"

#include <gtest/gtest.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A list of triangles by points; equal points become one vertex.
class Maker {
 public:
  std::uint32_t point(const Vec3& p) {
    const auto [place, is_new] = numbers_.try_emplace(p, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return place->second;
  }
  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const std::array<std::uint32_t, 4> v{point(a), point(b), point(c), point(d)};
    triangles_.push_back({v[0], v[1], v[2]});
    triangles_.push_back({v[0], v[2], v[3]});
  }
  /// n by n quads over the square of the parameters u and v from 0 to 1.
  void patch(std::uint32_t n, const std::function<Vec3(double, double)>& at) {
    const auto node = [&](std::uint32_t i, std::uint32_t j) {
      return at(static_cast<double>(i) / n, static_cast<double>(j) / n);
    };
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; j < n; ++j) quad(node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
  }
  /// The cube from -1 to 1 with n by n quads per side, each point mapped; outward, or inward for a cavity.
  void cube(std::uint32_t n, const std::function<Vec3(const Vec3&)>& map, bool is_cavity = false) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        patch(n, [&](double u, double v) {
          if ((side > 0) == is_cavity) std::swap(u, v);
          Vec3 p;
          p[axis] = side;
          p[(axis + 1) % 3] = 2 * u - 1;
          p[(axis + 2) % 3] = 2 * v - 1;
          return map(p);
        });
      }
    }
  }
  TriangleMesh make() const { return {PointArray(points_), triangles_}; }

 private:
  std::map<Vec3, std::uint32_t> numbers_;
  std::vector<Vec3> points_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

TriangleMesh cube_mesh(std::uint32_t n) {
  Maker maker;
  maker.cube(n, [](const Vec3& p) { return p; });
  return maker.make();
}

Vec3 on_sphere(const Vec3& p, double radius) {
  return (radius / std::sqrt(dot(p, p))) * p;
}

TriangleMesh sphere_mesh(std::uint32_t n) {
  Maker maker;
  maker.cube(n, [](const Vec3& p) { return on_sphere(p, 1); });
  return maker.make();
}

TriangleMesh wavy_grid(std::uint32_t n, double height) {
  Maker maker;
  maker.patch(n, [=](double u, double v) { return Vec3{u, v, height * std::sin(9 * u) * std::cos(7 * v)}; });
  return maker.make();
}

/// A shell whose two walls are much nearer to each other than they are to flat.
TriangleMesh thin_shell(std::uint32_t n) {
  Maker maker;
  const auto wave = [](const Vec3& p) { return 1 + 0.05 * std::sin(9 * p.x) * std::cos(8 * p.y + p.z); };
  maker.cube(n, [&](const Vec3& p) { return on_sphere(p, wave(on_sphere(p, 1))); });
  maker.cube(
      n, [&](const Vec3& p) { return on_sphere(p, 0.99 * wave(on_sphere(p, 1))); }, true);
  return maker.make();
}

Vec3 corner(const TriangleMesh& mesh, std::size_t f, std::size_t i) {
  return mesh.points().approx()[mesh.triangle(FaceId(f))[i]];
}

Kernel::Point_3 cgal_point(const Vec3& p) {
  return {p.x, p.y, p.z};
}

std::vector<Kernel::Triangle_3> cgal_triangles(const TriangleMesh& mesh) {
  std::vector<Kernel::Triangle_3> triangles;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    triangles.emplace_back(cgal_point(corner(mesh, f, 0)), cgal_point(corner(mesh, f, 1)),
                           cgal_point(corner(mesh, f, 2)));
  return triangles;
}

/// The largest distance of corners, middles of edges and centres of faces from the other mesh.
double sampled_deviation(const TriangleMesh& from, const TriangleMesh& to) {
  const std::vector<Kernel::Triangle_3> triangles = cgal_triangles(to);
  double largest = 0;
  for (std::size_t f = 0; f < from.face_count(); ++f) {
    const Vec3 a = corner(from, f, 0), b = corner(from, f, 1), c = corner(from, f, 2);
    for (const Vec3& p : {a, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (1.0 / 3) * (a + b + c)}) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& triangle : triangles)
        nearest = std::min(nearest, CGAL::to_double(CGAL::squared_distance(cgal_point(p), triangle)));
      largest = std::max(largest, std::sqrt(nearest));
    }
  }
  return largest;
}

bool crosses_itself(const TriangleMesh& mesh) {
  CGAL::Surface_mesh<Kernel::Point_3> result;
  using Vertex = CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index;
  for (const Vec3& p : mesh.points().approx()) result.add_vertex(cgal_point(p));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto [x, y, z] = mesh.triangle(FaceId(f));
    result.add_face(Vertex(x), Vertex(y), Vertex(z));
  }
  EXPECT_EQ(result.number_of_faces(), mesh.face_count());
  return CGAL::Polygon_mesh_processing::does_self_intersect(result);
}

std::size_t isolated_count(const TriangleMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) count += mesh.is_isolated(VertexId(v)) ? 1 : 0;
  return count;
}

void expect_same_topology(const TriangleMesh& before, const TriangleMesh& after) {
  EXPECT_EQ(audit(after), std::vector<std::string>());
  EXPECT_EQ(connected_components(after).count, connected_components(before).count);
  EXPECT_EQ(euler_characteristic(after), euler_characteristic(before));
  EXPECT_EQ(boundary_loops(after).size(), boundary_loops(before).size());
  EXPECT_EQ(is_manifold(after), is_manifold(before));
  EXPECT_EQ(isolated_count(after), isolated_count(before));
}

void expect_valid_volume(const TriangleMesh& mesh) {
  EXPECT_EQ(prove_volume(mesh)->text(), "");
  EXPECT_FALSE(crosses_itself(mesh));
}

TEST(Simplification, divided_cube_becomes_twelve_triangles) {
  for (const std::uint32_t n : {2U, 5U, 16U}) {
    const TriangleMesh mesh = cube_mesh(n);
    for (const auto& result : {simplified_volume(mesh, {0, 0.0}), simplified_volume(mesh, {12})}) {
      ASSERT_TRUE(result);
      EXPECT_EQ(result->mesh.face_count(), 12U) << n;
      EXPECT_EQ(result->mesh.vertex_count(), 8U);
      for (const Vec3& p : result->mesh.points().approx())
        for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(std::abs(p[axis]), 1);
      expect_same_topology(mesh, result->mesh);
      expect_valid_volume(result->mesh);
    }
    EXPECT_LT(simplified_volume(mesh, {0, 0.0})->deviation, 1e-12);
  }
}

TEST(Simplification, flat_grid_becomes_two_triangles) {
  const TriangleMesh mesh = wavy_grid(12, 0);
  const auto result = simplified_surface(mesh, {0, 0.0});
  EXPECT_EQ(result->mesh.face_count(), 2U);
  expect_same_topology(mesh, result->mesh);
  std::vector<Vec3> corners = result->mesh.points().approx();
  std::ranges::sort(corners);
  EXPECT_EQ(corners, (std::vector<Vec3>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}));
}

TEST(Simplification, targets_are_reached) {
  const TriangleMesh mesh = sphere_mesh(20);
  for (const std::size_t target : {4000U, 1001U, 100U, 4U}) {
    const auto result = simplified_volume(mesh, {target});
    EXPECT_LE(result->mesh.face_count(), target);
    EXPECT_GE(result->mesh.face_count() + 1, target);
    expect_same_topology(mesh, result->mesh);
    expect_valid_volume(result->mesh);
  }
  // A tetrahedron is the smallest one; what is small enough stays as it is.
  EXPECT_EQ(simplified_volume(mesh, {0})->mesh.face_count(), 4U);
  EXPECT_EQ(simplified_volume(mesh, {mesh.face_count()})->mesh.face_count(), mesh.face_count());
}

TEST(Simplification, deviation_holds) {
  for (const TriangleMesh& mesh : {sphere_mesh(14), wavy_grid(25, 0.1)}) {
    std::size_t last = mesh.face_count();
    for (const double deviation : {0.001, 0.01, 0.05}) {
      const auto result = simplified_surface(mesh, {0, deviation});
      EXPECT_LE(result->deviation, deviation);
      EXPECT_LE(sampled_deviation(mesh, result->mesh), result->deviation);
      EXPECT_LE(sampled_deviation(result->mesh, mesh), result->deviation);
      EXPECT_LE(result->mesh.face_count(), last);
      last = result->mesh.face_count();
      expect_same_topology(mesh, result->mesh);
      EXPECT_FALSE(crosses_itself(result->mesh));
    }
    EXPECT_LT(last, mesh.face_count() / 5);
  }
}

TEST(Simplification, volume_stays_valid_where_walls_are_near) {
  const TriangleMesh mesh = thin_shell(12);
  expect_valid_volume(mesh);
  // Without care the walls cross.
  EXPECT_TRUE(crosses_itself(simplified(mesh, {mesh.face_count() / 8})->mesh));
  for (const std::size_t share : {2U, 4U, 8U, 40U}) {
    const auto result = simplified_volume(mesh, {mesh.face_count() / share});
    expect_valid_volume(result->mesh);
    expect_same_topology(mesh, result->mesh);
  }
}

TEST(Simplification, surface_stays_valid_where_sheets_are_near) {
  Maker maker;
  for (const double z : {0.0, 0.002})
    maker.patch(20, [=](double u, double v) { return Vec3{u, v, z + 0.1 * std::sin(9 * u) * std::cos(7 * v)}; });
  const TriangleMesh mesh = maker.make();
  const auto result = simplified_surface(mesh, {mesh.face_count() / 10});
  EXPECT_FALSE(crosses_itself(result->mesh));
  EXPECT_TRUE(prove_surface(result->mesh)->is_valid());
  expect_same_topology(mesh, result->mesh);
}

TEST(Simplification, parts_are_kept) {
  Maker maker;
  for (int i = 0; i < 5; ++i)
    maker.cube(6, [i](const Vec3& p) { return on_sphere(p, 0.01) + Vec3{static_cast<double>(i * i), 0, 0}; });
  const TriangleMesh mesh = maker.make();
  const auto result = simplified_volume(mesh, {0});
  EXPECT_EQ(result->mesh.face_count(), 20U);
  expect_same_topology(mesh, result->mesh);
}

TEST(Simplification, handles_are_kept) {
  Maker maker;
  maker.patch(24, [](double u, double v) {
    // Equal doubles at both ends, so that the torus is closed.
    const double a = 2 * M_PI * (u == 1 ? 0 : u), b = 2 * M_PI * (v == 1 ? 0 : v);
    return Vec3{(2 + std::cos(b)) * std::cos(a), (2 + std::cos(b)) * std::sin(a), std::sin(b)};
  });
  const TriangleMesh mesh = maker.make();
  ASSERT_EQ(*genus(mesh), 1);
  const auto result = simplified_volume(mesh, {0});
  expect_same_topology(mesh, result->mesh);
  expect_valid_volume(result->mesh);
  EXPECT_LT(result->mesh.face_count(), 40U);
}

TEST(Simplification, boundary_is_kept) {
  // The boundary of this sheet is a square, whatever its inside.
  Maker maker;
  maker.patch(30, [](double u, double v) { return Vec3{u, v, u * (1 - u) * v * (1 - v) * std::sin(20 * u * v)}; });
  const TriangleMesh mesh = maker.make();
  const auto result = simplified_surface(mesh, {100});
  expect_same_topology(mesh, result->mesh);
  for (const BoundaryLoop& loop : boundary_loops(result->mesh)) {
    for (const HalfedgeId h : loop.halfedges) {
      const Vec3 p = result->mesh.point(result->mesh.origin(h)).approx;
      const double off = std::min({std::abs(p.x), std::abs(p.y), std::abs(1 - p.x), std::abs(1 - p.y)});
      EXPECT_EQ(off, 0);
      EXPECT_EQ(p.z, 0);
    }
  }
}

TEST(Simplification, nonmanifold_edges_stay) {
  // Two cubes with a common edge.
  Maker maker;
  maker.cube(4, [](const Vec3& p) { return p; });
  maker.cube(4, [](const Vec3& p) { return p + Vec3{2, 2, 0}; });
  const TriangleMesh mesh = maker.make();
  ASSERT_EQ(mesh.nonmanifold_edge_count(), 4U);
  const auto result = simplified_volume(mesh, {0, 0.0});
  EXPECT_EQ(result->mesh.nonmanifold_edge_count(), 4U);
  EXPECT_LT(result->mesh.face_count(), mesh.face_count() / 2);
  EXPECT_EQ(prove_volume(result->mesh)->text(), "");
}

TEST(Simplification, vertices_of_many_faces_stay) {
  constexpr int kCount = 3000;
  std::vector<Vec3> points{{0, 0, 1}, {0, 0, -1}};
  std::vector<TriangleMesh::Triangle> triangles;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2 * M_PI * i / kCount;
    points.push_back({std::cos(angle), std::sin(angle), 0});
    const auto a = static_cast<std::uint32_t>(2 + i), b = static_cast<std::uint32_t>(2 + (i + 1) % kCount);
    triangles.push_back({0, a, b});
    triangles.push_back({1, b, a});
  }
  const TriangleMesh mesh(PointArray(points), triangles);
  const auto result = simplified_volume(mesh, {60});
  EXPECT_EQ(result->mesh.face_count(), 60U);
  expect_same_topology(mesh, result->mesh);
  expect_valid_volume(result->mesh);
}

TEST(Simplification, locked_vertices_stay) {
  const TriangleMesh mesh = sphere_mesh(8);
  std::vector<std::uint8_t> locked(mesh.vertex_count(), 0);
  for (std::size_t v = 0; v < locked.size(); ++v) locked[v] = mesh.point(VertexId(v)).approx.z > 0.5 ? 1 : 0;
  const auto result = simplified(mesh, {0}, {}, locked);
  std::vector<Vec3> left = result->mesh.points().approx();
  for (std::size_t v = 0; v < locked.size(); ++v)
    EXPECT_TRUE(locked[v] == 0 || std::ranges::find(left, mesh.point(VertexId(v)).approx) != left.end());
}

TEST(Simplification, does_not_depend_on_threads) {
  const TriangleMesh mesh = sphere_mesh(60);
  TriangleMesh one, all = simplified(mesh, {2000})->mesh;
  with_threads(1, [&] { one = simplified(mesh, {2000})->mesh; });
  EXPECT_EQ(one.points(), all.points());
  EXPECT_EQ(one.origins(), all.origins());
}

TEST(Simplification, huge_and_tiny_coordinates) {
  for (const double scale : {1e-300, 1e300}) {
    Maker maker;
    maker.cube(6, [scale](const Vec3& p) { return scale * p; });
    const TriangleMesh mesh = maker.make();
    const auto result = simplified_volume(mesh, {12});
    EXPECT_EQ(result->mesh.face_count(), 12U);
    EXPECT_TRUE(prove_volume(result->mesh)->is_valid());
  }
}

TEST(Simplification, isolated_vertices_stay_in_their_order) {
  const TriangleMesh cube = cube_mesh(5);
  std::vector<Vec3> points{{7, 8, 9}};
  points.insert(points.end(), cube.points().approx().begin(), cube.points().approx().end());
  points.push_back({4, 5, 6});
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t f = 0; f < cube.face_count(); ++f) {
    const auto [a, b, c] = cube.triangle(FaceId(f));
    triangles.push_back({a + 1, b + 1, c + 1});
  }
  const std::size_t last = points.size() - 1;
  const auto result = simplified(TriangleMesh(PointArray(std::move(points)), triangles), {12});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->mesh.face_count(), 12U);
  ASSERT_EQ(result->mesh.vertex_count(), 10U);
  EXPECT_EQ(isolated_count(result->mesh), 2U);
  EXPECT_EQ(result->mesh.point(VertexId(0)).approx, (Vec3{7, 8, 9}));
  EXPECT_EQ(result->mesh.point(VertexId(9)).approx, (Vec3{4, 5, 6}));
  EXPECT_EQ(result->vertices.front(), 0U);
  EXPECT_EQ(result->vertices.back(), last);
}

TEST(Simplification, can_be_cancelled) {
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(simplified(sphere_mesh(20), {10}, &cancel).error().code, ErrorCode::interrupted);
  EXPECT_EQ(simplified_volume(sphere_mesh(20), {0, 0.1}, &cancel).error().code, ErrorCode::interrupted);
}

TEST(Simplification, empty_mesh) {
  EXPECT_TRUE(simplified(TriangleMesh(), {10})->mesh.is_empty());
  EXPECT_TRUE(simplified_volume(TriangleMesh(), {0, 1.0})->mesh.is_empty());
}

}  // namespace
}  // namespace algebra3d
