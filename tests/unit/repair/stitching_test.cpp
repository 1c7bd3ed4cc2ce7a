#include "algebra3d/kernel/repair/detail/stitching.h"

#include <map>
#include <set>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

using Corners = TriangleMesh::Triangle;

/// A triangle becomes three or four with a new vertex in the middle of one or two edges, while its neighbours stay.
void divide_at_random(TriangleSoup& soup, Chance& chance) {
  SoupTriangle& triangle = soup.triangles[index_below(chance, soup.triangles.size())];
  std::rotate(triangle.begin(), triangle.begin() + chance.below(3), triangle.end());
  const auto [a, b, c] = triangle;
  const Vec3 middle = 0.5 * a + 0.5 * b, other = 0.5 * a + 0.5 * c;
  if (chance.one_in(2)) {
    triangle = {a, middle, c};
    soup.triangles.push_back({middle, b, c});
    return;
  }
  triangle = {a, middle, other};
  soup.triangles.push_back({middle, b, c});
  soup.triangles.push_back({middle, c, other});
}

TEST(DivideEdges, closes_what_is_divided_on_one_side_only) {
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleMesh whole = on_grid(seed % 2 == 0 ? samples::torus(9, 7) : solids::box({0, 0, 0}, {4, 2, 3}));
    TriangleSoup soup = soup_of(whole);
    for (int n = chance.between(1, 12); n > 0; --n) divide_at_random(soup, chance);
    IndexedSoup indexed = indexed_soup(soup);
    const std::vector<Vec3> points = indexed.points;
    const bool was_closed = is_closed(*indexed.mesh());
    const std::size_t count = indexed.triangles.size();
    RepairReport report;
    split_t_junctions(indexed, report);
    EXPECT_TRUE(is_closed(*indexed.mesh()));
    EXPECT_TRUE(is_consistently_oriented(*indexed.mesh()));
    EXPECT_EQ(solids::exact_volume_of(*indexed.mesh()), solids::exact_volume_of(whole));
    EXPECT_EQ(indexed.points, points);
    // Each division makes one triangle more, and none is reported that was not made.
    EXPECT_EQ(count_of(report, RepairStep::t_junctions), indexed.triangles.size() - count);
    EXPECT_EQ(report.is_empty(), was_closed);
    EXPECT_EQ(report.deviation(), 0);
  }
}

TEST(DivideEdges, many_vertices_on_one_edge_and_on_all_three) {
  // A triangle whose neighbours are fans of a thousand triangles each.
  const std::array<Vec3, 3> corners{Vec3{0, 0, 0}, Vec3{1024, 0, 0}, Vec3{0, 1024, 0}};
  TriangleSoup soup;
  soup.triangles.push_back(corners);
  const Vec3 tip{300, 300, -5};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &from = corners[(i + 1) % 3], &to = corners[i];
    for (int k = 0; k < 1024; ++k)
      soup.triangles.push_back({from + (k / 1024.0) * (to - from), from + ((k + 1) / 1024.0) * (to - from), tip});
  }
  IndexedSoup indexed = indexed_soup(soup);
  RepairReport report;
  split_t_junctions(indexed, report);
  EXPECT_TRUE(is_closed(*indexed.mesh()));
  EXPECT_EQ(count_of(report, RepairStep::t_junctions), 3U * 1023U);
  for (const Corners& t : indexed.triangles) EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
}

TEST(DivideEdges, leaves_alone_what_is_closed_or_only_nearly_on_an_edge) {
  // A closed box whose edge a vertex of another one touches; and an open edge with a vertex an ulp beside it.
  IndexedSoup closed = indexed_soup(joined(cube_soup(0, 2), shifted(cube_soup(0, 2), {2, 2, 1})));
  const auto before = closed.triangles;
  RepairReport report;
  split_t_junctions(closed, report);
  EXPECT_EQ(closed.triangles, before);
  TriangleSoup open;
  open.triangles = {{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{0, 2, 0}},
                    {Vec3{0, 0, 0}, Vec3{0, 0, 2}, Vec3{1, std::nextafter(0.0, -1.0), 0}}};
  IndexedSoup beside = indexed_soup(open);
  split_t_junctions(beside, report);
  EXPECT_EQ(beside.triangles.size(), 2U);
  EXPECT_TRUE(report.is_empty());
}

TEST(DivideEdges, mends_what_a_degenerate_triangle_held_together) {
  TriangleSoup soup = cube_soup(0, 2);
  // The front has a corner in the middle of the top edge, the top has none, and a flat triangle was between them.
  const Vec3 a{0, 0, 0}, b{2, 0, 0}, c{2, 0, 2}, d{0, 0, 2}, m{1, 0, 2};
  std::erase_if(soup.triangles, [](const SoupTriangle& t) { return t[0].y == 0 && t[1].y == 0 && t[2].y == 0; });
  ASSERT_EQ(soup.triangles.size(), 10U);
  soup.triangles.insert(soup.triangles.end(), {{a, b, m}, {b, c, m}, {a, m, d}});
  IndexedSoup indexed = indexed_soup(soup);
  RepairReport report;
  split_t_junctions(indexed, report);
  EXPECT_TRUE(is_closed(*indexed.mesh()));
  EXPECT_EQ(solids::exact_volume_of(*indexed.mesh()), Rational(8));
  EXPECT_EQ(count_of(report, RepairStep::t_junctions), 1U);
}

/// Vertices at ends of edges that one triangle has, and the shortest such edge at each.
std::map<std::uint32_t, double> shortest_boundary_edges(const IndexedSoup& indexed) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const Corners& t : indexed.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(t[i], t[(i + 1) % 3])];
  std::map<std::uint32_t, double> result;
  for (const auto& [edge, count] : uses) {
    if (count != 1) continue;
    const double size = length(indexed.points[edge.first] - indexed.points[edge.second]);
    for (const std::uint32_t end : {edge.first, edge.second})
      result[end] = result.contains(end) ? std::min(result[end], size) : size;
  }
  return result;
}

// What the header promises, whatever the triangles are.
TEST(CloseGaps, keeps_its_promises_on_random_triangles) {
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup;
    for (int n = chance.between(1, 40); n > 0; --n) {
      const auto corner = [&] {
        return chance.grid_point(3) + 0.1 * Vec3{chance.unit(), chance.unit(), chance.unit()};
      };
      soup.triangles.push_back({corner(), corner(), corner()});
    }
    IndexedSoup indexed = indexed_soup(soup);
    const IndexedSoup given = indexed;
    const auto boundary = shortest_boundary_edges(given);
    const double tolerance = 0.3 * (1 + chance.unit());
    RepairReport report;
    stitch_gaps(indexed, tolerance, report);
    EXPECT_EQ(indexed.points, given.points);
    ASSERT_GE(indexed.triangles.size(), given.triangles.size());
    for (const Corners& t : indexed.triangles) EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    // Divided edges have their report, moved vertices theirs.
    EXPECT_EQ(count_of(report, RepairStep::t_junctions), indexed.triangles.size() - given.triangles.size());
    EXPECT_LE(report.deviation(), tolerance);
    const RepairEntry* moved = report.find(RepairStep::gaps);
    EXPECT_LE(moved == nullptr ? 0 : moved->largest, tolerance);
    std::uint64_t gone_count = 0;
    std::set<std::uint32_t> used;
    for (const Corners& t : indexed.triangles) used.insert(t.begin(), t.end());
    for (const Corners& t : given.triangles)
      for (const std::uint32_t corner : t)
        if (!used.contains(corner)) {
          EXPECT_TRUE(boundary.contains(corner));
          const auto may_hold = [&](const auto& other) {
            return other.first < corner && length(given.points[other.first] - given.points[corner]) <= tolerance;
          };
          EXPECT_TRUE(std::ranges::any_of(boundary, may_hold));
          used.insert(corner);
          ++gone_count;
        }
    EXPECT_EQ(moved == nullptr ? 0 : moved->count, gone_count);
  }
}

TEST(CloseGaps, joins_copies_of_vertices) {
  for (int seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    const TriangleMesh whole = seed % 2 == 0 ? samples::torus(12, 8) : solids::geodesic_sphere(3);
    TriangleSoup soup = soup_of(whole);
    for (SoupTriangle& t : soup.triangles)
      for (Vec3& corner : t) corner = corner + 1e-3 * Vec3{chance.unit(), chance.unit(), chance.unit()};
    IndexedSoup indexed = indexed_soup(soup);
    EXPECT_EQ(indexed.points.size(), 3 * whole.face_count());
    RepairReport report;
    stitch_gaps(indexed, 4e-3, report);
    EXPECT_EQ(indexed.triangles.size(), whole.face_count());
    const TriangleMesh mesh = submesh(*indexed.mesh(), [&] {
      std::vector<FaceId> all;
      for (std::uint32_t f = 0; f < whole.face_count(); ++f) all.emplace_back(f);
      return all;
    }());
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_TRUE(is_manifold(mesh));
    EXPECT_EQ(mesh.vertex_count(), whole.vertex_count());
    EXPECT_EQ(euler_characteristic(mesh), euler_characteristic(whole));
    EXPECT_EQ(count_of(report, RepairStep::gaps), 3 * whole.face_count() - whole.vertex_count());
    EXPECT_LE(report.deviation(), 2e-3 * std::sqrt(3.0));
  }
}

TEST(CloseGaps, tolerance_is_the_limit) {
  // Two triangles with a gap of 1/8 between their long sides.
  TriangleSoup soup;
  soup.triangles = {{Vec3{0, 0, 0}, Vec3{8, 0, 0}, Vec3{0, 8, 0}},
                    {Vec3{8, -0.125, 0}, Vec3{0, -0.125, 0}, Vec3{0, -8, 0}}};
  for (const bool is_enough : {false, true}) {
    IndexedSoup indexed = indexed_soup(soup);
    RepairReport report;
    stitch_gaps(indexed, is_enough ? 0.125 : 0.1249, report);
    EXPECT_EQ(count_of(report, RepairStep::gaps), is_enough ? 2U : 0U);
    EXPECT_EQ(report.deviation(), is_enough ? 0.125 : 0);
    // Those with the lower numbers stay where they are.
    EXPECT_EQ(indexed.triangles.values()[0], (Corners{0, 1, 2}));
    if (is_enough) {
      EXPECT_EQ(indexed.triangles.values()[1], (Corners{1, 0, 5}));
    }
  }
}

TEST(CloseGaps, a_vertex_beside_an_edge_divides_it) {
  TriangleSoup soup;
  soup.triangles = {{Vec3{0, 0, 0}, Vec3{8, 0, 0}, Vec3{4, 8, 0}},
                    {Vec3{4, -0.125, 0}, Vec3{0, 0, 0}, Vec3{4, -8, 0}},
                    {Vec3{8, 0, 0}, Vec3{4, -0.125, 0}, Vec3{4, -8, 0}}};
  IndexedSoup indexed = indexed_soup(soup);
  RepairReport report;
  stitch_gaps(indexed, 0.2, report);
  EXPECT_EQ(indexed.triangles.size(), 4U);
  EXPECT_EQ(count_of(report, RepairStep::t_junctions), 1U);
  EXPECT_EQ(count_of(report, RepairStep::gaps), 0U);
  EXPECT_EQ(report.deviation(), 0.125);
  // The outline is all that is open: four edges.
  std::size_t open_count = 0;
  const TriangleMesh mesh = *indexed.mesh();
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) open_count += mesh.is_boundary(HalfedgeId(h)) ? 1 : 0;
  EXPECT_EQ(open_count, 4U);
}

TEST(CloseGaps, small_triangles_do_not_vanish_whatever_the_tolerance) {
  IndexedSoup indexed =
      indexed_soup(joined(scaled(wall_of_squares(), 1e-3), shifted(scaled(wall_of_squares(), 1e-3), {1e-5, 0, 1e-5})));
  const std::size_t count = indexed.triangles.size();
  RepairReport report;
  stitch_gaps(indexed, 100, report);
  EXPECT_GE(indexed.triangles.size(), count);
  for (const Corners& t : indexed.triangles) EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
}

}  // namespace
}  // namespace algebra3d::soups
