// Attributes through subdivision. The oracle is the geometry: an attribute that equals the position of its vertex stays
// equal. Corners are interpolated linearly, and on a flat regular grid every scheme reproduces linear functions.
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "subdivision_samples.h"

namespace algebra3d {
namespace {

constexpr std::uint32_t kCells = 6;

/// The cells of a square of unit squares, or their halves, with the positions and numbers of their elements.
struct Grid {
  PolygonMesh mesh;
  MeshAttributes attributes;
};

AttributeValues positions_of(const PolygonMesh& mesh, std::span<const std::uint32_t> vertices) {
  AttributeValues values(AttributeKind::pair, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3& p = mesh.points().approx()[vertices[i]];
    values.set(i, std::array{p.x, p.y});
  }
  return values;
}

Grid flat_grid(bool has_triangles) {
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i <= kCells; ++i)
    for (std::uint32_t j = 0; j <= kCells; ++j) points.push_back({1.0 * i, 1.0 * j, 0});
  PolygonMesh mesh =
      samples::polygon_mesh(has_triangles ? samples::faces_of(samples::grid(kCells, kCells, false, false))
                                          : samples::quadrilateral_grid(kCells, kCells),
                            points);
  std::vector<std::uint32_t> all(mesh.vertex_count());
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
  AttributeValues cells(AttributeKind::text, mesh.face_count()), edge_values(AttributeKind::real, edge_count(mesh));
  for (const FaceId f : faces(mesh)) {
    const std::size_t cell = has_triangles ? f.index() / 2 : f.index();
    cells.set_text(f.index(), cells.add_text(std::to_string(cell)));
  }
  std::size_t e = 0;
  for (const HalfedgeId h : edges(mesh)) {
    // The line that the edge is on: 0 for x constant, 1 for y constant, 2 for diagonals.
    const Vec3 along = mesh.point(mesh.target(h)).approx - mesh.point(mesh.origin(h)).approx;
    edge_values.set(e++, std::array{along.x == 0 ? 0.0 : along.y == 0 ? 1.0 : 2.0});
  }
  return {mesh, MeshAttributes()
                    .with(MeshElement::vertex, "p", positions_of(mesh, all))
                    .with(MeshElement::halfedge, "p", positions_of(mesh, mesh.origins()))
                    .with(MeshElement::face, "cell", cells)
                    .with(MeshElement::edge, "line", edge_values)};
}

bool is_inside(const Vec3& p, double margin) {
  return p.x > margin && p.x < kCells - margin && p.y > margin && p.y < kCells - margin;
}

void expect_near(std::span<const double> pair, const Vec3& p) {
  EXPECT_NEAR(pair[0], p.x, 1e-13);
  EXPECT_NEAR(pair[1], p.y, 1e-13);
}

class SubdividedAttributes : public testing::TestWithParam<SubdivisionScheme> {
 protected:
  SubdividedAttributes()
      : grid_(flat_grid(takes_triangles_only(GetParam()))),
        result_(*subdivided(grid_.mesh, grid_.attributes, GetParam(), 2)) {}
  const AttributeValues& values(MeshElement element, const char* name) const {
    return *result_.attributes.find(element, name)->values;
  }

  static bool makes_faces_between_others() {
    return GetParam() == SubdivisionScheme::doo_sabin || GetParam() == SubdivisionScheme::sqrt3;
  }

  Grid grid_;
  SubdividedMesh result_;
};

TEST_P(SubdividedAttributes, mesh_is_the_same_as_without) {
  const PolygonMesh alone = *subdivided(grid_.mesh, GetParam(), 2);
  EXPECT_EQ(alone.points(), result_.mesh.points());
  EXPECT_EQ(alone.origins(), result_.mesh.origins());
  ASSERT_TRUE(result_.attributes.fits(result_.mesh));
  EXPECT_EQ(result_.attributes.all().size(), 4U);
}

TEST_P(SubdividedAttributes, linear_functions_stay_so_away_from_the_boundary) {
  const PolygonMesh& mesh = result_.mesh;
  const AttributeValues &at_vertices = values(MeshElement::vertex, "p"),
                        &at_corners = values(MeshElement::halfedge, "p");
  std::size_t seen = 0;
  for (const HalfedgeId h : halfedges(mesh)) {
    const Vec3 p = mesh.point(mesh.origin(h)).approx;
    EXPECT_EQ(at_vertices.numbers(mesh.origin(h).index())[0], p.x);
    EXPECT_EQ(at_vertices.numbers(mesh.origin(h).index())[1], p.y);
    // A corner of sqrt3 has the mean of two triangles, and its new place only inside.
    if (!is_inside(p, 2)) continue;
    expect_near(at_corners.numbers(h.index()), p);
    ++seen;
  }
  EXPECT_GT(seen, 100U);
}

TEST_P(SubdividedAttributes, faces_have_the_texts_of_what_they_were) {
  const AttributeValues& cells = values(MeshElement::face, "cell");
  std::size_t defined = 0;
  for (const FaceId f : faces(result_.mesh)) {
    Vec3 centre;
    for (const VertexId v : vertices_of(result_.mesh, f))
      centre = centre + (1.0 / result_.mesh.degree(f)) * result_.mesh.point(v).approx;
    if (!is_inside(centre, 1)) continue;
    // Doo-Sabin and sqrt3 make faces between cells, which have no common text.
    ASSERT_TRUE(cells.is_defined(f.index()) || makes_faces_between_others());
    if (!cells.is_defined(f.index())) continue;
    ++defined;
    const auto cell = static_cast<int>(kCells * std::floor(centre.x) + std::floor(centre.y));
    EXPECT_EQ(cells.text(f.index()), std::to_string(cell));
  }
  EXPECT_GE(defined, GetParam() == SubdivisionScheme::sqrt3 ? 8U : 16U);
}

TEST_P(SubdividedAttributes, halves_of_edges_have_their_values) {
  const AttributeValues& lines = values(MeshElement::edge, "line");
  std::size_t e = 0, defined = 0;
  for (const HalfedgeId h : edges(result_.mesh)) {
    const std::size_t edge = e++;
    if (!lines.is_defined(edge)) continue;
    ++defined;
    const Vec3 from = result_.mesh.point(result_.mesh.origin(h)).approx;
    const Vec3 to = result_.mesh.point(result_.mesh.target(h)).approx;
    if (!is_inside(from, 2) || !is_inside(to, 2)) continue;
    const double line = lines.numbers(edge)[0];
    const double place = line == 0 ? from.x : line == 1 ? from.y : from.x - from.y;
    EXPECT_NEAR(place, std::round(place), 1e-12);
    EXPECT_NEAR(place, line == 0 ? to.x : line == 1 ? to.y : to.x - to.y, 1e-12);
  }
  // Sqrt3 keeps those of the boundary, which two steps divide into three.
  if (GetParam() == SubdivisionScheme::sqrt3)
    EXPECT_EQ(defined, std::size_t{3} * 4 * kCells);
  else
    EXPECT_EQ(defined, GetParam() == SubdivisionScheme::doo_sabin ? 0 : 4 * edge_count(grid_.mesh));
}

INSTANTIATE_TEST_SUITE_P(Schemes, SubdividedAttributes,
                         testing::Values(SubdivisionScheme::catmull_clark, SubdivisionScheme::doo_sabin,
                                         SubdivisionScheme::loop, SubdivisionScheme::butterfly,
                                         SubdivisionScheme::modified_butterfly, SubdivisionScheme::sqrt3));

AttributeValues all_coordinates(const PolygonMesh& mesh) {
  AttributeValues values(AttributeKind::vector, mesh.vertex_count());
  for (const VertexId v : vertices(mesh)) {
    const Vec3 p = mesh.point(v).approx;
    values.set(v.index(), std::array{p.x, p.y, p.z});
  }
  return values;
}

/// Also at boundaries, with every variant and in every step.
TEST(SubdivisionAttributes, what_equals_the_coordinates_stays_equal) {
  std::vector<samples::NamedMesh> meshes = samples::manifold_triangle_meshes();
  const std::size_t triangle_mesh_count = meshes.size();
  for (auto& mesh : samples::manifold_polygon_meshes()) meshes.push_back(std::move(mesh));
  std::size_t seen = 0;
  for (const SubdivisionScheme& scheme : subdivision_schemes())
    for (std::size_t i = 0; i < (takes_triangles_only(scheme) ? triangle_mesh_count : meshes.size()); ++i) {
      const PolygonMesh& mesh = meshes[i].mesh;
      SCOPED_TRACE(meshes[i].name + ", " + std::string(name_of(scheme)));
      const auto given = MeshAttributes().with(MeshElement::vertex, "p", all_coordinates(mesh));
      for (std::size_t variant = 0; variant < std::max<std::size_t>(1, variants_of(scheme).size()); ++variant)
        for (std::size_t steps = 1; steps <= 2; ++steps) {
          const SubdividedMesh result = *subdivided(mesh, given, scheme, steps, {variant});
          const AttributeValues& values = *result.attributes.find(MeshElement::vertex, "p")->values;
          ASSERT_EQ(values, all_coordinates(result.mesh).canonical());
          ++seen;
        }
    }
  EXPECT_GT(seen, 100U);
}

/// The weights of Doo-Sabin are within a face, so corners that agree at each vertex stay what the vertices are.
TEST(SubdivisionAttributes, corners_of_doo_sabin_follow_the_points) {
  for (const auto& [name, mesh] : samples::manifold_polygon_meshes())
    for (std::size_t variant = 0; variant < 3; ++variant) {
      SCOPED_TRACE(name);
      const AttributeValues at_vertices = all_coordinates(mesh);
      const auto given = MeshAttributes().with(MeshElement::halfedge, "p", at_vertices.selected(mesh.origins()));
      const SubdividedMesh result = *subdivided(mesh, given, SubdivisionScheme::doo_sabin, 2, {variant});
      const AttributeValues& corners = *result.attributes.find(MeshElement::halfedge, "p")->values;
      ASSERT_EQ(corners, all_coordinates(result.mesh).selected(result.mesh.origins()).canonical());
    }
}

/// Where a vertex without a value counts: there another attribute, 1 at that vertex and else 0, is not 0.
TEST(SubdivisionAttributes, undefined_values_spread_as_far_as_the_weights) {
  const PolygonMesh mesh = samples::polygon_mesh(samples::faces_of(samples::grid(3, 3, false, false)));
  AttributeValues values(AttributeKind::real, mesh.vertex_count());
  for (std::size_t i = 1; i < values.size(); ++i) values.set(i, std::array{1.0});
  const SubdividedMesh result =
      *subdivided(mesh, MeshAttributes().with(MeshElement::vertex, "x", values), SubdivisionScheme::loop, 1);
  const AttributeValues& after = *result.attributes.find(MeshElement::vertex, "x")->values;
  AttributeValues marks(AttributeKind::real, mesh.vertex_count());
  for (std::size_t i = 0; i < marks.size(); ++i) marks.set(i, std::array{i == 0 ? 1.0 : 0.0});
  const SubdividedMesh marked =
      *subdivided(mesh, MeshAttributes().with(MeshElement::vertex, "x", marks), SubdivisionScheme::loop, 1);
  const AttributeValues& weights = *marked.attributes.find(MeshElement::vertex, "x")->values;
  std::size_t undefined = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after.is_defined(i), weights.numbers(i)[0] == 0);
    undefined += after.is_defined(i) ? 0 : 1;
  }
  // The vertex, its three neighbours, and the new ones on its three edges and on the two edges opposite.
  EXPECT_EQ(undefined, 9U);
}

TEST(SubdivisionAttributes, seams_stay_seams) {
  // Two quadrilaterals, whose corners have 0 on the left and 8 on the right side of their common edge.
  const PolygonMesh mesh = samples::polygon_mesh(samples::quadrilateral_grid(2, 1));
  AttributeValues sides(AttributeKind::real, 8);
  for (std::size_t h = 0; h < 8; ++h) sides.set(h, std::array{h < 4 ? 0.0 : 8.0});
  const auto result =
      *subdivided(mesh, MeshAttributes().with(MeshElement::halfedge, "s", sides), SubdivisionScheme::catmull_clark, 3);
  const AttributeValues& after = *result.attributes.find(MeshElement::halfedge, "s")->values;
  for (const HalfedgeId h : halfedges(result.mesh))
    EXPECT_EQ(after.numbers(h.index())[0], h.index() < result.mesh.halfedge_count() / 2 ? 0 : 8);
}

}  // namespace
}  // namespace algebra3d
