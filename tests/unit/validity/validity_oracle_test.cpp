// Verdicts against the definition itself, by oracles that are not ours: CGAL's constructed intersections of all pairs
// of triangles with exact numbers, and winding numbers as sums of solid angles just before and behind each triangle.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "algebra3d/kernel/validity/validity.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using samples::MeshMaker;

Kernel::Point_3 cgal_point(const Vec3& p) {
  return {p.x, p.y, p.z};
}

bool is_whole_edge(const Kernel::Segment_3& part, const Kernel::Triangle_3& t) {
  for (int i = 0; i < 3; ++i) {
    const Kernel::Segment_3 edge(t[i], t[i + 1]);
    if (edge == part || edge.opposite() == part) return true;
  }
  return false;
}

bool is_improper(const Kernel::Triangle_3& s, const Kernel::Triangle_3& t) {
  const auto common = CGAL::intersection(s, t);
  if (!common) return false;
  if (boost::get<Kernel::Point_3>(&*common) != nullptr) return false;
  if (const auto* segment = boost::get<Kernel::Segment_3>(&*common))
    return !is_whole_edge(*segment, s) || !is_whole_edge(*segment, t);
  return true;
}

struct Verdict {
  std::uint64_t degenerate_count = 0, improper_count = 0;
  bool is_volume = false;
};

/// Winding number times 4 pi. Source: the solid angle of a triangle by van Oosterom and Strackee.
double solid_angle(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    const Vec3 a = t[0].approx - p, b = t[1].approx - p, c = t[2].approx - p;
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum;
}

bool has_right_windings(const TriangleMesh& mesh) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    const Vec3 &a = t[0].approx, &b = t[1].approx, &c = t[2].approx;
    const Vec3 normal = cross(b - a, c - a);
    const Vec3 step = (1e-3 / std::sqrt(dot(normal, normal))) * normal;
    // Off the middle, so that the point has no special place among others on the grid.
    const Vec3 middle = 0.301 * a + 0.337 * b + 0.362 * c;
    const double whole = 4 * std::numbers::pi;
    if (std::abs(solid_angle(mesh, middle + step)) > 1e-6) return false;
    if (std::abs(solid_angle(mesh, middle - step) - whole) > 1e-6) return false;
  }
  return true;
}

Verdict by_definition(const TriangleMesh& mesh) {
  Verdict verdict;
  std::vector<Kernel::Triangle_3> triangles;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    triangles.emplace_back(cgal_point(t[0].approx), cgal_point(t[1].approx), cgal_point(t[2].approx));
    verdict.degenerate_count += triangles.back().is_degenerate() ? 1U : 0U;
  }
  if (verdict.degenerate_count != 0) return verdict;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t j = i + 1; j < triangles.size(); ++j)
      verdict.improper_count += is_improper(triangles[i], triangles[j]) ? 1U : 0U;
  verdict.is_volume = verdict.improper_count == 0 && has_right_windings(mesh);
  return verdict;
}

/// Tally of what the random cases were, to see that the test asks in earnest.
struct Tally {
  int valid_surfaces = 0, valid_volumes = 0, cases = 0;
};

void compare(const TriangleMesh& mesh, Tally& tally) {
  const Verdict expected = by_definition(mesh);
  const auto surface = prove_surface(mesh), volume = prove_volume(mesh);
  ASSERT_TRUE(surface.ok() && volume.ok());
  EXPECT_EQ(surface->count(Defect::degenerate_triangle), expected.degenerate_count);
  ++tally.cases;
  if (expected.degenerate_count != 0) return;
  // A repeated triangle is counted once, and what it meets besides its twin is counted for the twin.
  if (surface->count(Defect::duplicate_triangle) == 0) {
    EXPECT_EQ(surface->count(Defect::intersecting_triangles), expected.improper_count);
  } else {
    EXPECT_GT(expected.improper_count, 0U);
  }
  EXPECT_EQ(surface->is_valid(), expected.improper_count == 0) << surface->text();
  EXPECT_EQ(volume->is_valid(), expected.is_volume) << volume->text();
  tally.valid_surfaces += surface->is_valid() ? 1 : 0;
  tally.valid_volumes += volume->is_valid() ? 1 : 0;
}

TEST(validity_oracle, random_triangles_on_a_small_grid_are_judged_by_the_definition) {
  std::mt19937 random(11);  // NOLINT(cert-msc51-cpp): the same in every run
  Tally tally;
  for (int round = 0; round < 400; ++round) {
    std::uniform_int_distribution<int> coordinate(0, round % 2 == 0 ? 2 : 5), plane(0, round % 3 == 0 ? 0 : 5);
    const auto point = [&] {
      return Vec3{static_cast<double>(coordinate(random)), static_cast<double>(coordinate(random)),
                  static_cast<double>(std::min(plane(random), coordinate(random)))};
    };
    MeshMaker maker;
    const int count = 2 + round % 5;
    while (static_cast<int>(maker.triangles().size()) < count) {
      const Vec3 a = point(), b = point(), c = point();
      // Few degenerate ones: they end the comparison early.
      if (cross(b - a, c - a) != Vec3{} || round % 20 == 0) maker.triangle(a, b, c);
    }
    compare(maker.mesh(), tally);
  }
  EXPECT_GT(tally.valid_surfaces, 40);
  EXPECT_LT(tally.valid_surfaces, 360);
}

TEST(validity_oracle, random_boxes_on_a_small_grid_are_judged_by_the_definition) {
  std::mt19937 random(12);  // NOLINT(cert-msc51-cpp): the same in every run
  Tally tally;
  for (int round = 0; round < 150; ++round) {
    std::uniform_int_distribution<int> coordinate(0, 4), chance(0, 9);
    const auto interval = [&]() -> std::array<double, 2> {
      const int a = coordinate(random), b = coordinate(random);
      return {1.0 * std::min(a, b), 1.0 * std::max(a, b) + (a == b ? 1 : 0)};
    };
    MeshMaker maker;
    for (int n = 0; n < 2 + round % 2; ++n) {
      const auto [x0, x1] = interval();
      const auto [y0, y1] = interval();
      const auto [z0, z1] = interval();
      maker.box({x0, y0, z0}, {x1, y1, z1}, chance(random) < 2);
    }
    if (chance(random) == 0) maker.drop();
    if (chance(random) == 0) std::ranges::swap(maker.triangles()[0][0], maker.triangles()[0][1]);
    compare(maker.mesh(), tally);
  }
  EXPECT_GT(tally.valid_volumes, 5);
  EXPECT_LT(tally.valid_volumes, 140);
}

TEST(validity_oracle, random_stars_of_a_corner_are_judged_by_the_definition) {
  // Closed fans round one corner: most are not graphs, some go round twice, some fold.
  std::mt19937 random(13);  // NOLINT(cert-msc51-cpp): the same in every run
  Tally tally;
  for (int round = 0; round < 300; ++round) {
    std::uniform_int_distribution<int> jitter(-2, 2), height(-3, 3);
    const int count = 3 + round % 6, turns = 1 + round % 2;
    std::vector<Vec3> ring;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * turns * i / count;
      ring.push_back({std::round(5 * std::cos(angle)) + jitter(random),
                      std::round(5 * std::sin(angle)) + jitter(random), static_cast<double>(height(random))});
    }
    MeshMaker maker;
    for (std::size_t i = 0; i < ring.size(); ++i) maker.triangle({0, 0, 0}, ring[i], ring[(i + 1) % ring.size()]);
    compare(maker.mesh(), tally);
  }
  EXPECT_GT(tally.valid_surfaces, 60);
  EXPECT_LT(tally.valid_surfaces, 280);
}

TEST(validity_oracle, near_misses_between_tiny_and_huge_are_judged_by_the_definition) {
  // Two sheets whose distance is far below the rounding of any plane equation.
  Tally tally;
  for (const double gap : {0.0, 5e-324, 1e-300, 1e-17, -5e-324, -1e-17}) {
    MeshMaker maker;
    maker.triangle({0, 0, 0}, {3, 0, 0}, {0, 3, 0});
    maker.triangle({1, 1, gap}, {-1, 0.3, gap}, {0.7, -1, 1});
    maker.triangle({2, 2, gap}, {5, 0.3, gap}, {0.7, 5, gap});
    compare(maker.mesh(), tally);
  }
  EXPECT_GT(tally.valid_surfaces, 0);
}

TEST(validity_oracle, a_twisted_torus_is_judged_by_the_definition) {
  Tally tally;
  compare(samples::torus(8, 5), tally);
  compare(samples::cone(12), tally);
  compare(samples::twisted_band(12, 3), tally);
  EXPECT_EQ(tally.valid_surfaces, 3);
  EXPECT_EQ(tally.valid_volumes, 2);
}

}  // namespace
}  // namespace algebra3d
