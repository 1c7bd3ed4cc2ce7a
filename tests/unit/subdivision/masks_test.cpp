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
  expect_mesh(*subdivided(mesh, Scheme::loop, 1, samples::variant(Scheme::loop, "warren")), warren_reference(mesh),
              kRounded);
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
    ASSERT_NO_FATAL_FAILURE(expect_mesh(*subdivided(mesh, Scheme::loop, 1, samples::variant(Scheme::loop, "warren")),
                                        warren_reference(mesh), kRounded));
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

/// A grid of triangles as a lattice with the steps (1, 0), (0, 1) and (1, 1). Masks between regular vertices are given
/// by places on it, not by links: the corner across the edge p q from r is at p + q - r.
class Lattice {
 public:
  struct Place {
    int i, j;
    Place operator+(const Place& other) const { return {i + other.i, j + other.j}; }
    Place operator-(const Place& other) const { return {i - other.i, j - other.j}; }
    auto operator<=>(const Place&) const = default;
  };

  Lattice(std::uint32_t m, std::uint32_t n)
      : m_(static_cast<int>(m)),
        n_(static_cast<int>(n)),
        mesh_(polygon_mesh(faces_of(samples::grid(m, n, false, false)))) {}

  const PolygonMesh& mesh() const { return mesh_; }
  Place place(VertexId v) const {
    const int index = static_cast<int>(v.index());
    return {index / (n_ + 1), index % (n_ + 1)};
  }
  bool has(const Place& p) const { return p.i >= 0 && p.i <= m_ && p.j >= 0 && p.j <= n_; }
  RationalVec3 point(const Place& p) const {
    return mesh_.point(VertexId(static_cast<std::uint32_t>(p.i * (n_ + 1) + p.j))).rational();
  }
  /// Both triangles at the steps k and k + 1 from a place are there exactly if all three places are.
  static Place step(std::size_t k) {
    constexpr std::array<Place, 6> kSteps{Place{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}};
    return kSteps[k % 6];
  }
  std::size_t neighbour_count(const Place& p) const {
    std::size_t count = 0;
    for (std::size_t k = 0; k < 6; ++k) count += has(p + step(k)) ? 1 : 0;
    return count;
  }
  /// At a vertex of a side with three triangles, the first of its four neighbours counter-clockwise.
  std::size_t first_step(const Place& p) const {
    std::size_t k = 0;
    while (has(p + step(k + 5)) || !has(p + step(k))) ++k;
    return k;
  }

  /// The new point on an edge inside between regular vertices, by the table of [zorin2000], chapter 4.
  RationalVec3 regular_point(Place a, Place b) const {
    reference::Mask mask;
    const bool is_a_outer = neighbour_count(a) == 4, is_b_outer = neighbour_count(b) == 4;
    // The corners of the triangles beside the edge: at 60 degrees to both sides.
    std::size_t k = 0;
    while (step(k) != b - a) ++k;
    const std::array<Place, 2> sides{a + step(k + 1), a + step(k + 5)};
    const auto across = [](const Place& p, const Place& q, const Place& r) { return p + q - r; };
    if (!is_a_outer && !is_b_outer) {
      mask.add({1, 2}, point(a)).add({1, 2}, point(b));
      for (const Place& c : sides)
        mask.add({1, 8}, point(c)).add({-1, 16}, point(across(a, c, b))).add({-1, 16}, point(across(b, c, a)));
      return mask.sum();
    }
    if (is_a_outer != is_b_outer) {
      if (is_b_outer) std::swap(a, b);
      const std::size_t first = first_step(a);
      const Place start = a + step(first), end = a + step(first + 3);
      const bool is_second = a + step(first + 1) == b;
      const Place outer = is_second ? start : end, far = is_second ? end : start;
      const Place inner = a + step(is_second ? first + 2 : first + 1);
      return mask.add({3, 8}, point(a))
          .add({5, 8}, point(b))
          .add({1, 16}, point(outer))
          .add({3, 16}, point(inner))
          .add({-1, 16}, point(far))
          .add({-1, 16}, point(across(b, outer, a)))
          .add({-1, 8}, point(across(b, inner, a)))
          .sum();
    }
    mask.add({1, 2}, point(a)).add({1, 2}, point(b));
    // A side whose corner has this triangle only.
    const auto is_ear = [&](const Place& c) { return neighbour_count(c) == 2; };
    if (is_ear(sides[0]) == is_ear(sides[1])) return mask.sum();
    const Place wide = is_ear(sides[0]) ? sides[1] : sides[0];
    return mask.add({1, 4}, point(wide))
        .add({-1, 8}, point(across(a, wide, b)))
        .add({-1, 8}, point(across(b, wide, a)))
        .sum();
  }

 private:
  int m_, n_;
  PolygonMesh mesh_;
};

/// On all sides of a grid, in both directions; the rules by how many of the ends are at the boundary.
TEST(ModifiedButterfly, masks_between_regular_vertices_by_places) {
  std::array<std::size_t, 3> seen = {};
  for (const auto& [m, n] : {std::pair(6U, 5U), {2U, 6U}, {6U, 2U}, {1U, 6U}, {5U, 1U}, {3U, 3U}, {2U, 2U}}) {
    const Lattice lattice(m, n);
    const PolygonMesh& mesh = lattice.mesh();
    const PolygonMesh result = *subdivided(mesh, Scheme::modified_butterfly, 1);
    auto made = static_cast<std::uint32_t>(mesh.vertex_count());
    for (const HalfedgeId h : edges(mesh)) {
      const RationalVec3 point = result.point(VertexId(made++)).rational();
      const Lattice::Place a = lattice.place(mesh.origin(h)), b = lattice.place(mesh.target(h));
      const auto is_regular = [&](const Lattice::Place& p) {
        return lattice.neighbour_count(p) == 4 || lattice.neighbour_count(p) == 6;
      };
      if (mesh.is_boundary(h) || !is_regular(a) || !is_regular(b)) continue;
      ASSERT_EQ(point, lattice.regular_point(a, b)) << m << " by " << n << ", edge " << h.index();
      ++seen[(lattice.neighbour_count(a) == 4 ? 1 : 0) + (lattice.neighbour_count(b) == 4 ? 1 : 0)];
    }
  }
  EXPECT_GT(seen[0], 5U);
  EXPECT_GT(seen[1], 20U);
  EXPECT_GT(seen[2], 10U);
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

TEST(DooSabin, mean_rule) {
  std::vector<samples::NamedMesh> meshes = samples::manifold_polygon_meshes();
  for (auto& mesh : samples::manifold_triangle_meshes()) meshes.push_back(std::move(mesh));
  for (const auto& [name, mesh] : meshes) {
    SCOPED_TRACE(name);
    const double tolerance = mesh.common_degree() == 4 ? kExact : kRounded;
    ASSERT_NO_FATAL_FAILURE(expect_mesh(*subdivided(mesh, Scheme::doo_sabin, 1),
                                        Reference(mesh).doo_sabin(Reference::mean_weight, true), tolerance));
  }
}

TEST(DooSabin, weights_of_doo) {
  for (const auto& faces :
       {samples::cube(), faces_of(samples::tetrahedron()), faces_of(samples::icosahedron()),
        samples::quadrilateral_grid(4, 3), samples::quadrilateral_grid(1, 1), samples::Faces{{0, 1, 2, 3, 4, 5}}}) {
    const PolygonMesh mesh = polygon_mesh(faces);
    const double tolerance = mesh.common_degree() == 4 ? kExact : kRounded;
    for (const bool has_boundary : {true, false})
      ASSERT_NO_FATAL_FAILURE(expect_mesh(
          *subdivided(mesh, Scheme::doo_sabin, 1, samples::variant(Scheme::doo_sabin, has_boundary ? "doo" : "open")),
          Reference(mesh).doo_sabin(Reference::doo_weight, has_boundary), tolerance));
  }
}

/// The boundary of a strip of two squares is the quadratic B-spline of its six vertices: every step has the points of
/// Chaikin's corner cutting, and the strip stays as long and as wide as the curve.
TEST(DooSabin, boundary_is_a_quadratic_spline) {
  const PolygonMesh strip =
      polygon_mesh({{0, 1, 4, 3}, {1, 2, 5, 4}}, {{0, 0, 0}, {8, 0, 0}, {16, 0, 0}, {0, 8, 0}, {8, 8, 0}, {16, 8, 0}});
  std::vector<Vec3> curve = {{0, 0, 0}, {8, 0, 0}, {16, 0, 0}, {16, 8, 0}, {8, 8, 0}, {0, 8, 0}};
  for (std::size_t steps = 1; steps <= 6; ++steps) {
    std::vector<Vec3> cut;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const Vec3 &a = curve[i], &b = curve[(i + 1) % curve.size()];
      cut.push_back(0.75 * a + 0.25 * b);
      cut.push_back(0.25 * a + 0.75 * b);
    }
    curve = std::move(cut);
    const PolygonMesh result = *subdivided(strip, Scheme::doo_sabin, steps);
    std::vector<Vec3> boundary;
    for (const VertexId v : vertices(result))
      if (result.is_boundary(result.outgoing(v))) boundary.push_back(result.point(v).approx);
    const auto less = [](const Vec3& p) { return std::pair(p.x, p.y); };
    std::vector<Vec3> expected = curve;
    std::ranges::sort(expected, {}, less);
    std::ranges::sort(boundary, {}, less);
    ASSERT_EQ(boundary, expected) << steps;
    // The middles of the edges at both ends are on the curve.
    EXPECT_EQ(boundary.front().x, 0);
    EXPECT_EQ(boundary.back().x, 16);
  }
}

}  // namespace
}  // namespace algebra3d
