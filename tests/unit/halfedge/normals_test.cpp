// Normals and angles against closed forms and CGAL.
#include "algebra3d/kernel/halfedge/normals.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <gtest/gtest.h>

#include <numeric>
#include <optional>
#include <random>
#include <tuple>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/detail/angles.h"
#include "algebra3d/kernel/halfedge/detail/face_normal.h"
#include "base/scheduler.h"
#include "polygon_lists.h"
#include "support/to_cgal.h"

namespace algebra3d {
namespace {

using namespace samples;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

void expect_near(const Vec3& found, const Vec3& expected, double error = 1e-14) {
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[axis], error);
}
double cubed_root_of_third() {
  return std::sqrt(1.0 / 3);
}

TriangleMesh torus_mesh(std::uint32_t m, std::uint32_t n) {
  return {torus_points(m, n), torus(m, n)};
}

TEST(Angles, of_directions_are_those_of_the_c_library) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 100'000; ++i) {
    const double y = std::abs(number(random)), x = number(random);
    ASSERT_NEAR(detail::angle_of_direction(y, x), std::atan2(y, x), 2e-15);
  }
  EXPECT_EQ(detail::angle_of_direction(0, -1), std::numbers::pi);
  EXPECT_EQ(detail::angle_of_direction(0, 0), 0);
  EXPECT_EQ(detail::angle_of_direction(1, 0) * detail::kDegreesPerRadian, 90);
  EXPECT_EQ(detail::angle_of_direction(1, 1) * detail::kDegreesPerRadian, 45);
  for (const double small : {1e-300, 1e-20, 1e-9}) EXPECT_DOUBLE_EQ(detail::angle_of_direction(small, 1), small);
}

TEST(FaceNormals, of_a_cube_are_its_axes) {
  const std::vector<Vec3> normals = face_normals(polygon_mesh(cube_faces(), cube_points()));
  const std::vector<Vec3> expected{{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  EXPECT_EQ(normals, expected);
}

TEST(FaceNormals, of_triangles_agree_with_cgal) {
  const TriangleMesh mesh = torus_mesh(9, 7);
  const auto theirs = oracle::to_cgal_mesh<Kernel>(mesh);
  const std::vector<Vec3> normals = face_normals(mesh);
  for (const FaceId f : faces(mesh)) {
    const auto n = CGAL::Polygon_mesh_processing::compute_face_normal(
        CGAL::Surface_mesh<Kernel::Point_3>::Face_index(f.index()), *theirs);
    expect_near(normals[f.index()], {n.x(), n.y(), n.z()});
    expect_near(vector_area(mesh, f).normal, normals[f.index()]);
  }
}

TEST(FaceNormals, of_slivers_and_of_huge_and_tiny_faces_are_good) {
  for (const double scale : {1.0, 1e-170, 1e140}) {
    const double e = scale * 1e-14;
    const PointArray points(std::vector<Vec3>{{0, 0, 0}, {scale, 0, 0}, {0.3 * scale, e, 2 * e}});
    const TriangleMesh mesh(points, Triangles{{0, 1, 2}});
    expect_near(face_normals(mesh)[0], {0, -2 / std::sqrt(5.0), 1 / std::sqrt(5.0)}, 1e-9);
  }
}

// Rounding the corners is allowed only where it is good enough: of faces that are small beside their coordinates, and
// of slivers, the exact corners decide.
TEST(FaceNormals, of_corners_that_are_no_doubles_are_by_doubles_where_that_is_good_enough) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> number(-1000, 1000);
  const auto coordinate = [&](double base, int unit) { return Rational(base) + Rational(number(random), unit); };
  for (const std::uint32_t degree : {3U, 4U})
    for (const auto& [base, unit, is_always_quick] :
         {std::tuple{0.0, 3, true}, {1e3, 7, true}, {1e9, 3'000'000, false}, {1e15, 3, false}}) {
      std::vector<std::uint32_t> corners(degree);
      std::iota(corners.begin(), corners.end(), 0U);
      int quick_count = 0;
      for (int i = 0; i < 200; ++i) {
        PointArray points;
        for (std::uint32_t corner = 0; corner < degree; ++corner)
          points.push_back(ExactPoint(
              RationalVec3(coordinate(base, unit), coordinate(base, unit), coordinate(i % 4 == 0 ? 0 : base, unit))));
        const std::optional<Vec3> quick = detail::quick_normal(points, corners);
        if (!quick) continue;
        ++quick_count;
        expect_near(*quick, nearest_vector_area(points, corners).normal, 1e-9);
      }
      EXPECT_TRUE(is_always_quick ? quick_count >= 198 : quick_count == 0) << base << " " << quick_count;
    }
}

/// An L of height 0 and its normal, though the first corner and its neighbours turn the other way.
TEST(FaceNormals, of_a_concave_polygon_is_that_of_its_area) {
  const PointArray points(std::vector<Vec3>{{1, 1, 0}, {1, 3, 0}, {0, 3, 0}, {0, 0, 0}, {3, 0, 0}, {3, 1, 0}});
  const PolygonMesh mesh = polygon_mesh({{0, 1, 2, 3, 4, 5}}, points);
  EXPECT_EQ(face_normals(mesh)[0], (Vec3{0, 0, 1}));
  EXPECT_EQ(vector_area(mesh, FaceId(0)).area, 5);
}

TEST(VertexNormals, of_a_cube_are_its_diagonals_however_it_is_divided) {
  const double r = cubed_root_of_third();
  const Triangles halves{{0, 3, 2}, {0, 2, 1}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                         {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const TriangleMesh triangles(cube_points(), halves);
  const PolygonMesh quads = polygon_mesh(cube_faces(), cube_points());
  const auto of_triangles = vertex_normals(triangles);
  const auto of_quads = vertex_normals(quads);
  for (const VertexId v : vertices(quads)) {
    const Vec3 p = quads.point(v).approx;
    const Vec3 expected{r * (2 * p.x - 1), r * (2 * p.y - 1), r * (2 * p.z - 1)};
    expect_near(of_triangles[v.index()], expected);
    expect_near(of_quads[v.index()], expected);
    expect_near(vertex_normal(quads, v), expected);
  }
}

TEST(VertexNormals, reflex_corners_count_with_their_angle) {
  // Three quarters of a square lie in z = 0, at a reflex corner; a fourth face stands on one of its edges.
  const PointArray points(
      std::vector<Vec3>{{0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 0, 0}, {1, 0, 1}});
  const PolygonMesh mesh = polygon_mesh({{0, 1, 2, 3, 4, 5}, {0, 5, 6}}, points);
  const double a = 1.5 * std::numbers::pi, b = std::numbers::pi / 4;
  const double size = std::hypot(a, b);
  expect_near(vertex_normal(mesh, VertexId(0)), {0, -b / size, a / size});
}

TEST(VertexNormals, that_cancel_are_none) {
  const TriangleMesh both_sides(points_for(3), Triangles{{0, 1, 2}, {0, 2, 1}});
  EXPECT_EQ(vertex_normal(both_sides, VertexId(0)), Vec3{});
  const TriangleMesh isolated(points_for(4), Triangles{{0, 1, 2}});
  EXPECT_EQ(vertex_normal(isolated, VertexId(3)), Vec3{});
}

/// The sums by brute force over all corners, with angles by the arc cosine.
TEST(VertexNormals, are_weighted_by_angle) {
  const TriangleMesh mesh = torus_mesh(6, 8);
  const std::vector<Vec3> of_faces = face_normals(mesh), found = vertex_normals(mesh);
  for (const VertexId v : vertices(mesh)) {
    Vec3 sum;
    for (const FaceId f : faces(mesh)) {
      const auto t = mesh.triangle(f);
      for (std::size_t i = 0; i < 3; ++i) {
        if (t[i] != v.index()) continue;
        const Vec3 p = mesh.points().approx()[t[i]];
        const Vec3 u = mesh.points().approx()[t[(i + 1) % 3]] - p, w = mesh.points().approx()[t[(i + 2) % 3]] - p;
        sum = sum + std::acos(dot(u, w) / (length(u) * length(w))) * of_faces[f.index()];
      }
    }
    expect_near(found[v.index()], 1 / length(sum) * sum, 1e-12);
    expect_near(vertex_normal(mesh, v), found[v.index()]);
  }
}

/// A torus of faces with three, four and five corners in random order, larger than a block of vertices.
PolygonList mixed_torus(std::uint32_t m, std::uint32_t n, std::mt19937& random) {
  PolygonList list;
  for (std::uint32_t i = 0; i < m; ++i) {
    for (std::uint32_t j = 0; j < n; j += 2) {
      const auto at = [&](std::uint32_t row, std::uint32_t column) { return (row % m) * n + column % n; };
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1), e = at(i + 1, j + 2),
                          f = at(i, j + 2);
      switch (random() % 3) {
        case 0:
          list.insert(list.end(), {{a, b, c}, {a, c, d}, {d, c, e, f}});
          break;
        case 1:
          list.insert(list.end(), {{a, b, c, d}, {d, c, e, f}});
          break;
        default:
          list.insert(list.end(), {{a, b, c, e, d}, {d, e, f}});
          break;
      }
    }
  }
  std::ranges::shuffle(list, random);
  return list;
}

template <typename Mesh>
void expect_normals_of_single_vertices(const Mesh& mesh) {
  const std::vector<Vec3> found = vertex_normals(mesh);
  ASSERT_EQ(found.size(), mesh.vertex_count());
  for (const VertexId v : vertices(mesh)) expect_near(found[v.index()], vertex_normal(mesh, v), 1e-12);
}

TEST(VertexNormals, of_all_are_those_of_each) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const PolygonList& list : all_polygon_lists()) {
    std::uint32_t count = 0;
    for (const auto& polygon : list) count = std::max(count, *std::ranges::max_element(polygon) + 1);
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i < count; ++i) points.push_back({number(random), number(random), number(random)});
    expect_normals_of_single_vertices(polygon_mesh(list, PointArray(points)));
  }
  expect_normals_of_single_vertices(polygon_mesh(mixed_torus(200, 240, random), torus_points(200, 240)));
}

TEST(VertexNormals, do_not_depend_on_the_order_of_the_vertices_or_the_number_of_threads) {
  std::mt19937 random(4);
  const PolygonList list = mixed_torus(200, 240, random);
  const PointArray points = torus_points(200, 240);
  const std::vector<Vec3> expected = vertex_normals(polygon_mesh(list, points));
  with_threads(1, [&] { EXPECT_EQ(vertex_normals(polygon_mesh(list, points)), expected); });

  std::vector<std::uint32_t> place(points.size());
  std::iota(place.begin(), place.end(), 0U);
  std::ranges::shuffle(place, random);
  PolygonList moved = list;
  std::vector<Vec3> moved_points(points.size());
  for (auto& polygon : moved)
    for (std::uint32_t& corner : polygon) corner = place[corner];
  for (std::size_t i = 0; i < place.size(); ++i) moved_points[place[i]] = points.approx()[i];
  const std::vector<Vec3> found = vertex_normals(polygon_mesh(moved, PointArray(moved_points)));
  for (std::size_t i = 0; i < place.size(); ++i) expect_near(found[place[i]], expected[i]);
}

TEST(VertexNormals, of_corners_that_are_no_doubles) {
  PointArray points(std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {1, 1, 1e-300}});
  points.push_back(ExactPoint(RationalVec3(Rational(1, 3), Rational(1, 3), Rational(1, 3))));
  const TriangleMesh mesh(points, Triangles{{3, 0, 1}, {3, 0, 2}, {0, 3, 1}});
  expect_normals_of_single_vertices(mesh);
}

TEST(VertexNormals, of_slivers_and_of_huge_and_tiny_faces) {
  for (const double scale : {1.0, 1e-170, 1e140, 1e300}) {
    const PointArray points(std::vector<Vec3>{
        {0, 0, 0}, {scale, 0, 0}, {scale, scale, scale * 1e-14}, {0, scale, 0}, {0.5 * scale, 1e-15 * scale, 0}});
    expect_normals_of_single_vertices(polygon_mesh({{0, 1, 2, 3}, {0, 4, 1}, {3, 2, 4}}, points));
    expect_normals_of_single_vertices(TriangleMesh(points, Triangles{{0, 1, 2}, {0, 4, 1}, {3, 2, 4}, {0, 0, 1}}));
  }
}

TEST(CornerNormals, of_a_cube_with_and_without_creases) {
  const PolygonMesh cube = polygon_mesh(cube_faces(), cube_points());
  const std::vector<Vec3> of_faces = face_normals(cube);
  const CornerNormals sharp = corner_normals(cube, of_faces, 30);
  EXPECT_EQ(sharp.normals.size(), 24U);
  for (const HalfedgeId h : halfedges(cube))
    expect_near(sharp.normals[sharp.of_corner[h.index()]], of_faces[cube.face(h).index()]);
  EXPECT_EQ(corner_normals(cube, of_faces, 89.999).normals.size(), 24U);
  // 90 degrees is not more than 90.
  const CornerNormals smooth = corner_normals(cube, of_faces, 90);
  EXPECT_EQ(smooth.normals.size(), 8U);
  const std::vector<Vec3> of_vertices = vertex_normals(cube);
  for (const HalfedgeId h : halfedges(cube))
    expect_near(smooth.normals[smooth.of_corner[h.index()]], of_vertices[cube.origin(h).index()]);
}

TEST(CornerNormals, one_crease_at_a_closed_vertex_divides_nothing) {
  // The walk round a fan begins at its crease, so that the parts on both sides of one alone are the same part.
  const PointArray points(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}});
  const PolygonMesh flat = polygon_mesh({{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}}, points);
  std::vector<Vec3> normals(5, Vec3{0, 0, 1});
  EXPECT_EQ(corner_normals(flat, normals, 0).normals.size(), 6U);
  normals[0] = {1, 0, 0};  // two creases at vertex 0
  const CornerNormals divided = corner_normals(flat, normals, 30);
  EXPECT_NE(divided.of_corner[0], divided.of_corner[3]);
  EXPECT_EQ(divided.of_corner[3], divided.of_corner[6]);
  EXPECT_EQ(divided.of_corner[3], divided.of_corner[12]);
}

/// CGAL's dihedral angle is that between the half planes, 180 where the faces are flat.
TEST(DihedralAngles, agree_with_cgal) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    std::vector<Vec3> points;
    for (int j = 0; j < 4; ++j) points.push_back({number(random), number(random), number(random)});
    const TriangleMesh mesh(PointArray(points), Triangles{{0, 1, 2}, {1, 0, 3}});
    const auto p = [&](std::size_t j) { return Kernel::Point_3(points[j].x, points[j].y, points[j].z); };
    const double theirs = CGAL::approximate_dihedral_angle(p(0), p(1), p(2), p(3));
    const double ours = *dihedral_angle_degrees(mesh, HalfedgeId(0));
    ASSERT_NEAR(180 - std::abs(theirs), std::abs(ours), 1e-9);
    // Convex if each face has the other's third corner behind it.
    ASSERT_EQ(CGAL::orientation(p(0), p(1), p(2), p(3)) == CGAL::NEGATIVE, ours > 0);
  }
}

TEST(DihedralAngles, of_flat_folded_and_open_edges) {
  const auto angle = [](const Vec3& last) {
    const TriangleMesh mesh(PointArray(std::vector<Vec3>{{0, 0, 0}, {0.1, 0.2, 0}, {-1, 0.7, 0}, last}),
                            Triangles{{0, 1, 2}, {1, 0, 3}});
    return dihedral_angle_degrees(mesh, HalfedgeId(0));
  };
  EXPECT_EQ(angle({0.3, 0.1, 0}), 0);
  EXPECT_EQ(angle({-0.3, 0.9, 0}), 180);
  EXPECT_GT(*angle({-0.3, 0.9, -1e-9}), 179);
  EXPECT_LT(*angle({-0.3, 0.9, 1e-9}), -179);
  EXPECT_LT(*angle({-0.3, 0.9, 1e-200}), -179);
  EXPECT_EQ(angle({0.2, 0.4, 0}), std::nullopt);  // no area
  const TriangleMesh one(points_for(3), Triangles{{0, 1, 2}});
  EXPECT_EQ(dihedral_angle_degrees(one, HalfedgeId(0)), std::nullopt);
}

}  // namespace
}  // namespace algebra3d
