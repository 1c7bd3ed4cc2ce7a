// Verdicts and texts that follow from the definition (validity/report.h) by hand.
#include "algebra3d/kernel/validity/validity.h"

#include <gtest/gtest.h>

#include "algebra3d/kernel/validity/detail/winding.h"
#include "base/scheduler.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using samples::MeshMaker;

ValidityReport volume_report(const TriangleMesh& mesh, const ProofOptions& options = {}) {
  auto report = prove_volume(mesh, options);
  EXPECT_TRUE(report.ok());
  return *std::move(report);
}

ValidityReport surface_report(const TriangleMesh& mesh, const ProofOptions& options = {}) {
  auto report = prove_surface(mesh, options);
  EXPECT_TRUE(report.ok());
  return *std::move(report);
}

std::string volume_text(const MeshMaker& maker) {
  return volume_report(maker.mesh()).text();
}

/// A shape in units that are doubles and in others, near the origin and far from it.
std::vector<MeshMaker> makers() {
  return {MeshMaker(),
          MeshMaker(Rational(1, 3)),
          MeshMaker(Rational(1e-9)),
          MeshMaker(1, Rational(1e9)),
          MeshMaker(Rational(1, 7), Rational(1'000'000'000)),
          MeshMaker(Rational(1e-300)),
          MeshMaker(Rational(1e300))};
}

TEST(validity, the_empty_mesh_is_a_surface_and_a_volume) {
  EXPECT_TRUE(volume_report({}).is_valid());
  EXPECT_TRUE(surface_report({}).is_valid());
}

TEST(validity, solids_with_cavities_and_bodies_in_them_are_volumes) {
  for (MeshMaker maker : makers()) {
    EXPECT_EQ(volume_text(maker.box({0, 0, 0}, {9, 9, 9})), "");
    EXPECT_EQ(volume_text(maker.box({1, 1, 1}, {8, 8, 8}, true)), "");
    EXPECT_EQ(volume_text(maker.box({2, 2, 2}, {7, 7, 7})), "");
    EXPECT_EQ(volume_text(maker.box({20, 0, 0}, {29, 9, 9})), "");
  }
}

TEST(validity, an_inside_out_solid_has_a_wrong_winding) {
  for (MeshMaker maker : makers()) {
    const TriangleMesh mesh = maker.box({0, 0, 0}, {1, 1, 1}, true).mesh();
    const ValidityReport report = volume_report(mesh);
    EXPECT_EQ(report.count(Defect::wrong_winding), 1U);
    EXPECT_EQ(report.total(), 1U);
    EXPECT_TRUE(surface_report(mesh).is_valid());
    const auto shells = find_shell_windings(mesh);
    ASSERT_TRUE(shells.ok());
    EXPECT_EQ(shells->fronts, std::vector<int>{-1});
    EXPECT_TRUE(shells->is_inside_out());
  }
}

TEST(validity, nested_shells_of_equal_orientation_have_a_wrong_winding) {
  MeshMaker maker;
  maker.box({0, 0, 0}, {9, 9, 9}).box({1, 1, 1}, {8, 8, 8}).box({2, 2, 2}, {7, 7, 7}, true);
  EXPECT_EQ(volume_text(maker), "2 shells with a wrong winding number (first at triangle 12, near (1.0 1.0 1.0))");
  const auto shells = find_shell_windings(maker.mesh());
  EXPECT_EQ(shells->fronts, (std::vector<int>{0, 1, 1}));
  EXPECT_FALSE(shells->is_inside_out());
}

TEST(validity, bodies_may_touch_in_points) {
  for (MeshMaker maker : makers()) {
    maker.box({0, 0, 0}, {2, 2, 2});
    maker.box({2, 2, 2}, {3, 3, 3});                                            // corner to corner
    maker.tetrahedron({-1, 1, 1.25}, {0, 1.5, 1}, {-1, 2, 0.5}, {-1, 1.5, 2});  // corner to face
    maker.tetrahedron({2, 0.75, 2}, {3, 0.5, 5}, {2, 0.5, 5}, {3, 1, 5});       // corner to edge
    maker.tetrahedron({-1, 1, -1}, {1, -1, -1}, {-2, -2, -1}, {-1, -1, -4});    // far below
    EXPECT_EQ(volume_text(maker), "");
  }
}

TEST(validity, an_edge_may_cross_an_edge_in_a_point) {
  for (MeshMaker maker : makers()) {
    maker.tetrahedron({-1, 0, 0}, {1, 0, 0}, {0, -1, -1}, {0, 1, -1});
    maker.tetrahedron({0, -1, 0}, {0, 1, 0}, {-1, 0, 1}, {1, 0, 1});
    EXPECT_EQ(volume_text(maker), "");
  }
}

TEST(validity, bodies_may_touch_along_whole_edges) {
  for (MeshMaker maker : makers()) {
    maker.box({0, 0, 0}, {1, 1, 1}).box({1, 1, 0}, {2, 2, 1});
    EXPECT_EQ(volume_text(maker), "");
    const auto shells = find_shell_windings(maker.mesh());
    EXPECT_EQ(shells->fronts.size(), 1U);
  }
  for (MeshMaker three : makers()) {
    three.tetrahedron({0, 0, 0}, {0, 0, 1}, {2, 1, 0}, {2, -1, 0});
    three.tetrahedron({0, 0, 0}, {0, 0, 1}, {-2, 1, 0}, {-1, 2, 0});
    three.tetrahedron({0, 0, 0}, {0, 0, 1}, {-1, -2, 0}, {-2, -1, 0});
    EXPECT_EQ(volume_text(three), "");
  }
}

TEST(validity, a_body_and_another_turned_over_at_one_edge_do_not_alternate) {
  MeshMaker maker;
  maker.box({0, 0, 0}, {1, 1, 1}).box({1, 1, 0}, {2, 2, 1}, true);
  EXPECT_EQ(volume_text(maker), "1 non-manifold edge (first triangles 7 and 10, near (1.0 1.0 0.5))");
}

TEST(validity, bodies_that_share_a_face_have_duplicate_triangles) {
  MeshMaker maker;
  maker.box({0, 0, 0}, {1, 1, 1}).box({1, 0, 0}, {2, 1, 1});
  const ValidityReport report = volume_report(maker.mesh());
  EXPECT_FALSE(report.is_valid());
  EXPECT_EQ(report.count(Defect::duplicate_triangle) + report.count(Defect::intersecting_triangles), report.total());
}

TEST(validity, bodies_whose_faces_overlap_intersect) {
  for (MeshMaker maker : makers()) {
    maker.box({0, 0, 0}, {2, 2, 2}).box({2, 0.5, 0.5}, {3, 1.5, 1.5});
    const ValidityReport report = volume_report(maker.mesh());
    EXPECT_GT(report.count(Defect::intersecting_triangles), 0U);
    EXPECT_EQ(report.count(Defect::intersecting_triangles), report.total());
  }
}

TEST(validity, bodies_that_overlap_intersect) {
  for (MeshMaker maker : makers()) {
    maker.box({0, 0, 0}, {2, 2, 2}).box({1, 1, 1}, {3, 3, 3});
    EXPECT_GT(volume_report(maker.mesh()).count(Defect::intersecting_triangles), 0U);
  }
}

TEST(validity, touching_along_part_of_an_edge_is_an_intersection) {
  MeshMaker maker;
  maker.box({0, 0, 0}, {1, 1, 2}).box({1, 1, 0}, {2, 2, 1});
  EXPECT_GT(volume_report(maker.mesh()).count(Defect::intersecting_triangles), 0U);
}

TEST(validity, a_hole_is_counted_with_its_place) {
  MeshMaker maker;
  maker.box({0, 0, 0}, {1, 1, 1}).drop();
  EXPECT_EQ(volume_text(maker), "3 boundary edges (first at triangle 2, near (1.0 0.5 1.0))");
  EXPECT_TRUE(surface_report(maker.mesh()).is_valid());
}

TEST(validity, a_triangle_turned_over_gives_inconsistent_edges) {
  MeshMaker maker;
  maker.box({0, 0, 0}, {1, 1, 1});
  std::swap(maker.triangles()[0][1], maker.triangles()[0][2]);
  const ValidityReport report = volume_report(maker.mesh());
  EXPECT_EQ(report.count(Defect::inconsistent_edge), 3U);
  EXPECT_EQ(report.total(), 3U);
}

TEST(validity, a_moebius_strip_is_a_surface_and_no_volume) {
  const TriangleMesh strip = samples::twisted_band(40, 1);
  EXPECT_EQ(surface_report(strip).text(), "");
  const ValidityReport report = volume_report(strip);
  EXPECT_EQ(report.count(Defect::boundary_edge), 80U);
  EXPECT_EQ(report.count(Defect::inconsistent_edge), 1U);
}

TEST(validity, three_triangles_at_an_edge_are_a_surface_and_no_volume) {
  for (MeshMaker maker : makers()) {
    for (const Vec3& apex : {Vec3{1, 0, 0}, Vec3{-1, 1, 0}, Vec3{-1, -1, 0}})
      maker.triangle({0, 0, 0}, {0, 0, 1}, apex);
    EXPECT_EQ(surface_report(maker.mesh()).text(), "");
    EXPECT_EQ(volume_report(maker.mesh()).count(Defect::nonmanifold_edge), 1U);
  }
}

TEST(validity, a_corner_inside_an_edge_is_an_intersection_of_a_surface_only_if_edges_overlap) {
  MeshMaker touching;
  touching.triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0}).triangle({1, 0, 0}, {1, -1, 1}, {1, -1, 0});
  EXPECT_EQ(surface_report(touching.mesh()).text(), "");
  MeshMaker junction;
  junction.triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0}).triangle({0, 0, 0}, {1, -1, 0}, {1, 0, 0});
  EXPECT_EQ(surface_report(junction.mesh()).text(),
            "1 intersecting pair (first triangles 0 and 1, near (0.5 0.0 0.0))");
}

TEST(validity, a_t_junction_is_no_volume) {
  MeshMaker maker;  // the face x = 1 is split at the middle of an edge, its neighbour is not
  maker.box({0, 0, 0}, {1, 1, 1}).drop().triangle({1, 0, 0}, {1, 1, 1}, {1, 0.5, 0.5});
  const ValidityReport report = volume_report(maker.mesh());
  EXPECT_FALSE(report.is_valid());
  EXPECT_GT(report.count(Defect::boundary_edge), 0U);
}

TEST(validity, degenerate_triangles_are_named_as_such_only) {
  for (MeshMaker maker : makers()) {
    maker.triangle({0, 0, 0}, {1, 2, 4}, {3, 6, 12}).triangle({0, 0, 9}, {1, 0, 9}, {0, 1, 9});
    maker.triangle({5, 0, 0}, {5, 0, 0}, {6, 0, 0}).triangle({7, 7, 7}, {7, 7, 7}, {7, 7, 7});
    const ValidityReport report = surface_report(maker.mesh());
    EXPECT_EQ(report.count(Defect::degenerate_triangle), 3U);
    EXPECT_EQ(report.total(), 3U);
  }
}

TEST(validity, duplicates_are_found_in_any_order_of_corners) {
  MeshMaker maker;
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  maker.triangle(a, b, c).triangle(b, c, a).triangle(c, b, a).triangle({5, 5, 5}, {6, 5, 5}, {5, 6, 5});
  EXPECT_EQ(surface_report(maker.mesh()).text(), "2 duplicate triangles (first triangles 0 and 1, near (0.0 0.0 0.0))");
  MeshMaker opposite;
  opposite.triangle(a, b, c).triangle(c, b, a);
  EXPECT_EQ(surface_report(opposite.mesh()).count(Defect::duplicate_triangle), 1U);
  EXPECT_EQ(volume_report(opposite.mesh()).total(), 1U);
}

TEST(validity, a_flap_folded_flat_intersects) {
  for (MeshMaker maker : makers()) {
    maker.triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0}).triangle({2, 0, 0}, {0, 0, 0}, {1, 3, 0});
    EXPECT_EQ(surface_report(maker.mesh()).count(Defect::intersecting_triangles), 1U);
    maker.triangle({0, 0, 0}, {-1, 1, 0}, {1, 1, 0});
    EXPECT_EQ(surface_report(maker.mesh()).count(Defect::intersecting_triangles), 3U);
  }
}

TEST(validity, defects_of_all_kinds_are_reported_together) {
  MeshMaker maker;
  maker.box({0, 0, 0}, {2, 2, 2}).drop().box({1, 1, 1}, {3, 3, 3});
  const ValidityReport report = volume_report(maker.mesh());
  EXPECT_EQ(report.count(Defect::boundary_edge), 3U);
  EXPECT_GT(report.count(Defect::intersecting_triangles), 0U);
  const ValidityReport first = volume_report(maker.mesh(), {.thoroughness = Thoroughness::first_defect});
  EXPECT_EQ(first.count(Defect::boundary_edge), 3U);
  EXPECT_EQ(first.total(), 3U);
}

TEST(validity, counting_of_pairs_ends_at_the_limit) {
  MeshMaker maker;
  for (int i = 0; i < 40; ++i) {
    const double x = i * 0.01;
    maker.triangle({x, -1, 0}, {x, 1, 0.1}, {x, 0, 1}).triangle({-1, x, 0}, {1, x, 0.1}, {0, x, 1});
  }
  const ValidityReport all = surface_report(maker.mesh());
  EXPECT_FALSE(all.is_cut_short);
  EXPECT_GT(all.total(), 100U);
  const ValidityReport some = surface_report(maker.mesh(), {.max_intersecting_pairs = 100});
  EXPECT_TRUE(some.is_cut_short);
  EXPECT_EQ(some.total(), 100U);
  EXPECT_EQ(some.text().substr(0, 31), "at least 100 intersecting pairs");
  EXPECT_EQ(surface_report(maker.mesh(), {.thoroughness = Thoroughness::first_defect}).total(), 1U);
}

// Large meshes are searched in parts, by several threads.
TEST(validity, of_a_large_mesh_does_not_depend_on_the_threads) {
  const TriangleMesh one = samples::torus(120, 60), other = samples::torus(120, 60, {0.5, 0.25, 0.125});
  std::vector<Vec3> points = one.points().approx();
  const auto first = static_cast<std::uint32_t>(points.size());
  points.insert(points.end(), other.points().approx().begin(), other.points().approx().end());
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t f = 0; f < one.face_count(); ++f) triangles.push_back(one.triangle(FaceId(f)));
  for (std::size_t f = 0; f < other.face_count(); ++f) {
    const auto [a, b, c] = other.triangle(FaceId(f));
    triangles.push_back({first + a, first + b, first + c});
  }
  const TriangleMesh mesh(PointArray(std::move(points)), triangles);
  ASSERT_GT(mesh.face_count(), 20'000U);
  for (const Thoroughness thoroughness : {Thoroughness::first_defect, Thoroughness::all_defects}) {
    std::string alone;
    with_threads(1, [&] { alone = prove_surface(mesh, {.thoroughness = thoroughness})->text(); });
    EXPECT_NE(alone, "");
    for (int i = 0; i < 3; ++i) EXPECT_EQ(prove_surface(mesh, {.thoroughness = thoroughness})->text(), alone);
  }
  EXPECT_EQ(prove_surface(mesh, {.thoroughness = Thoroughness::first_defect})->count(Defect::intersecting_triangles),
            1U);
}

TEST(validity, cancelling_gives_the_error_interrupted) {
  const std::atomic<bool> cancel = true;
  const auto report = prove_volume(samples::torus(30, 20), {.cancel = &cancel});
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().code, ErrorCode::interrupted);
  EXPECT_EQ(report.error().message, "interrupted");
  EXPECT_FALSE(find_shell_windings(samples::torus(30, 20), &cancel).ok());
}

TEST(validity, smooth_solids_are_volumes_near_and_far) {
  for (const double far : {0.0, 1e3, 1e9})
    EXPECT_EQ(volume_report(samples::torus(60, 40, {far, -far, far})).text(), "");
}

TEST(validity, slivers_that_meet_in_one_corner_are_not_paired) {
  const TriangleMesh solid = samples::cone(20'000);
  std::vector<TriangleMesh::Triangle> slope;
  for (std::size_t f = 0; f < solid.face_count(); f += 2) slope.push_back(solid.triangle(FaceId(f)));
  const TriangleMesh mesh(solid.points(), slope);
  reset_exact_counters();
  EXPECT_EQ(surface_report(mesh).text(), "");
  EXPECT_LT(exact_counters().calls, 10 * slope.size());
  EXPECT_EQ(volume_report(samples::cone(500)).text(), "");
}

TEST(validity, proving_a_smooth_solid_asks_few_exact_questions) {
  const TriangleMesh mesh = samples::torus(200, 100);
  reset_exact_counters();
  EXPECT_TRUE(volume_report(mesh).is_valid());
  const ExactCounters counters = exact_counters();
  EXPECT_LT(counters.calls, 10 * mesh.face_count());
  EXPECT_LT(counters.big_fallbacks, 100U);
}

TEST(validity, reports_do_not_depend_on_the_order_of_corners) {
  MeshMaker maker;
  maker.box({0, 0, 0}, {2, 2, 2}).box({1, 1, 1}, {3, 3, 3}).box({1, 0, 5}, {2, 3, 6}).drop();
  const std::string expected = volume_text(maker);
  for (auto& triangle : maker.triangles()) std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
  EXPECT_EQ(volume_report(maker.mesh()).count(Defect::boundary_edge), 3U);
  EXPECT_EQ(volume_text(maker).substr(0, 20), expected.substr(0, 20));
}

TEST(validity, many_bodies_are_proved_with_one_ray_each) {
  MeshMaker maker;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 low{2.0 * (i % 10), 2.0 * (i / 10 % 10), 2.0 * (i / 100)};
    maker.box(low, low + Vec3{1, 1, 1});
  }
  const TriangleMesh mesh = maker.mesh();
  EXPECT_EQ(volume_report(mesh).text(), "");
  EXPECT_EQ(find_shell_windings(mesh)->fronts, std::vector<int>(1000, 0));
}

}  // namespace
}  // namespace algebra3d
