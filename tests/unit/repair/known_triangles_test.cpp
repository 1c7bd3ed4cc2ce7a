#include "algebra3d/kernel/repair/detail/known_triangles.h"

#include <memory>
#include <tuple>

#include "unit/repair/soups.h"

namespace algebra3d::soups {
namespace {

/// With what a proof finds out about it.
KnownTriangles known_triangles_of(const TriangleSoup& soup) {
  auto mesh = std::make_shared<const TriangleMesh>(mesh_of(soup));
  const auto examined = examine_volume(*mesh);
  EXPECT_TRUE(examined.ok());
  Rational volume = solids::exact_volume_of(*mesh);
  return {std::move(mesh), examined->free, std::move(volume)};
}

std::size_t recognised_count(const FaceMatches& recognised) {
  return static_cast<std::size_t>(std::ranges::count_if(recognised, &FaceId::is_valid));
}

TriangleSoup torus_and_cube() {
  return joined(soup_of(on_grid(samples::torus(14, 8))), cube_soup(1, 4));
}

TEST(KnownTriangles, are_all_that_cross_nothing) {
  const TriangleSoup soup = torus_and_cube();
  const KnownTriangles known = known_triangles_of(soup);
  const auto recognised = known.recognise(*known.mesh());
  const auto entangled = prove_volume(*known.mesh());
  EXPECT_GT(entangled->count(Defect::intersecting_triangles), 0U);
  const std::size_t count = recognised_count(recognised);
  EXPECT_GT(count, soup.triangles.size() / 2);
  EXPECT_LT(count, soup.triangles.size());
  std::vector<FaceId> faces;
  for (const FaceId f : recognised.ids())
    if (recognised[f].is_valid()) faces.push_back(f);
  EXPECT_EQ(prove_surface(submesh(*known.mesh(), faces))->text(), "");
}

TEST(KnownTriangles, are_recognised_in_any_order_and_looking_any_way) {
  Chance chance(3);
  TriangleSoup soup = torus_and_cube();
  const KnownTriangles known = known_triangles_of(soup);
  const std::size_t count = recognised_count(known.recognise(*known.mesh()));
  shuffle(soup, chance);
  for (SoupTriangle& t : soup.triangles)
    if (chance.one_in(3)) t = turned(t);
  soup.triangles.push_back({Vec3{50, 0, 0}, Vec3{51, 0, 0}, Vec3{50, 1, 0}});
  const TriangleMesh mesh = mesh_of(soup);
  const auto recognised = known.recognise(mesh);
  EXPECT_EQ(recognised_count(recognised), count);
  const auto place = [](const Vec3& p) { return std::tuple(p.x, p.y, p.z); };
  for (const FaceId f : recognised.ids()) {
    if (!recognised[f].is_valid()) continue;
    SoupTriangle one = soup.triangles[f.index()], other = soup_of(*known.mesh()).triangles[recognised[f].index()];
    std::ranges::sort(one, {}, place);
    std::ranges::sort(other, {}, place);
    EXPECT_EQ(one, other);
  }
}

TEST(KnownTriangles, are_recognised_once) {
  const TriangleSoup torus = soup_of(on_grid(samples::torus(14, 8)));
  const KnownTriangles known = known_triangles_of(torus);
  const TriangleMesh twice = mesh_of(joined(torus, torus));
  EXPECT_EQ(recognised_count(known.recognise(twice)), torus.triangles.size());
  // Where a point is there as two vertices, nothing is said of the faces at the second one.
  const TriangleMesh once = mesh_of(torus);
  PointArray points = once.points();
  points.push_back(once.point(VertexId(0)));
  std::vector<TriangleMesh::Triangle> triangles;
  std::size_t moved = 0;
  for (std::uint32_t f = 0; f < once.face_count(); ++f) {
    triangles.push_back(once.triangle(FaceId(f)));
    for (std::uint32_t& corner : triangles.back())
      if (corner == 0 && f % 2 == 0) corner = static_cast<std::uint32_t>(once.vertex_count());
    if (triangles.back() != once.triangle(FaceId(f))) ++moved;
  }
  EXPECT_GT(moved, 0U);
  EXPECT_EQ(recognised_count(known.recognise(TriangleMesh(points, triangles))), torus.triangles.size() - moved);
}

TEST(KnownTriangles, nothing_is_known_of_points_that_are_no_doubles) {
  const TriangleSoup torus = soup_of(on_grid(samples::torus(14, 8)));
  const KnownTriangles known = known_triangles_of(torus);
  const TriangleMesh mesh = mesh_of(torus);
  PointArray points;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    RationalVec3 p = mesh.points()[i].rational();
    if (i == 0) p.x = p.x + Rational(1, 3) * Rational(1e-30);
    points.push_back(ExactPoint(p));
  }
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) triangles.push_back(mesh.triangle(FaceId(f)));
  EXPECT_LT(recognised_count(known.recognise(TriangleMesh(points, triangles))), torus.triangles.size());
}

TEST(KnownTriangles, volume_is_the_sum_over_all_faces) {
  for (int seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = torus_and_cube();
    const KnownTriangles known = known_triangles_of(soup);
    for (SoupTriangle& t : soup.triangles)
      if (chance.one_in(10)) t = turned(t);
    for (int n = chance.below(5); n > 0; --n) soup.triangles.erase(soup.triangles.begin() + chance.below(20));
    for (int n = chance.below(5); n > 0; --n) soup.triangles.push_back(soup.triangles[index_below(chance, 20)]);
    for (int n = chance.below(5); n > 0; --n)
      soup.triangles.push_back({chance.grid_point(9), chance.grid_point(9), chance.grid_point(9)});
    shuffle(soup, chance);
    const TriangleMesh mesh = mesh_of(soup);
    EXPECT_EQ(*known.volume_of(mesh, known.recognise(mesh), nullptr), solids::exact_volume_of(mesh));
  }
}

/// What is known of a file makes no difference to a proof, whatever became of its triangles.
TEST(KnownTriangles, proofs_are_those_that_know_nothing) {
  int valid = 0;
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(static_cast<std::uint64_t>(seed));
    TriangleSoup soup = soup_of(on_grid(samples::torus(14, 8)));
    const TriangleSoup clean = soup;
    for (int n = chance.below(3); n > 0; --n)
      soup = joined(std::move(soup), cube_soup(chance.below(9), 9 + chance.below(9)));
    for (int n = chance.below(6); n > 0; --n)
      soup.triangles.push_back({chance.grid_point(9), chance.grid_point(9), chance.grid_point(9)});
    const KnownTriangles known = known_triangles_of(soup);
    // What is added is among the known, and crosses them.
    if (chance.one_in(2)) soup = clean;
    if (chance.one_in(2)) soup = joined(std::move(soup), shifted(cube_soup(0, 3), chance.grid_point(9)));
    if (chance.one_in(2)) soup.triangles.push_back(soup.triangles[index_below(chance, soup.triangles.size())]);
    if (chance.one_in(3)) soup.triangles.push_back({chance.grid_point(9), chance.grid_point(9), chance.grid_point(9)});
    const TriangleMesh mesh = mesh_of(soup);
    const FaceSet recognised = recognised_faces(known.recognise(mesh));
    const auto proof = prove_volume(mesh, {.known = recognised});
    EXPECT_EQ(proof->text(), prove_volume(mesh)->text());
    EXPECT_EQ(*disentangle(mesh, nullptr, recognised), *disentangle(mesh));
    valid += proof->is_valid() ? 1 : 0;
  }
  EXPECT_GT(valid, 0);
}

}  // namespace
}  // namespace algebra3d::soups
