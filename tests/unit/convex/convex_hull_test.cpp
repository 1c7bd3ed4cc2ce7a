// Hulls of random points, most of them degenerate. CGAL's exact kernel tells that a hull is the hull: it bounds a valid
// solid, no point is in front of a facet, and the normals at each vertex, which is one of the points, span the space.
#include "algebra3d/kernel/convex/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "support/cgal_verdict.h"
#include "support/rounds.h"
#include "unit/convex/clouds.h"

namespace algebra3d {
namespace {

using Kernel = oracle::ExactKernel;
using clouds::array_of;

int dimension_of(const std::vector<Kernel::Vector_3>& vectors) {
  for (const auto& u : vectors)
    for (const auto& v : vectors)
      for (const auto& w : vectors)
        if (CGAL::determinant(u, v, w) != 0) return 3;
  for (const auto& u : vectors)
    for (const auto& v : vectors)
      if (CGAL::cross_product(u, v) != CGAL::NULL_VECTOR) return 2;
  return std::ranges::any_of(vectors, [](const auto& u) { return u != CGAL::NULL_VECTOR; }) ? 1 : 0;
}

int dimension_of(const std::vector<Kernel::Point_3>& points) {
  std::vector<Kernel::Vector_3> vectors;
  for (const auto& p : points) vectors.push_back(p - points[0]);
  // Three that span the most are among these, if any are.
  const int plane = dimension_of(std::vector(
      vectors.begin(), vectors.begin() + std::min<std::ptrdiff_t>(8, static_cast<std::ptrdiff_t>(vectors.size()))));
  return plane == 3 ? 3 : dimension_of(vectors);
}

void expect_hull(const TriangleMesh& hull, const std::vector<ExactPoint>& points,
                 const std::vector<Kernel::Point_3>& cgal_points) {
  EXPECT_EQ(oracle::complaint(hull), "");
  std::vector<std::vector<Kernel::Vector_3>> normals(hull.vertex_count());
  for (std::uint32_t f = 0; f < hull.face_count(); ++f) {
    const Kernel::Triangle_3 triangle = oracle::cgal_triangle(hull, f);
    const Kernel::Plane_3 plane = triangle.supporting_plane();
    for (const auto& p : cgal_points) EXPECT_FALSE(plane.has_on_positive_side(p));
    for (const std::uint32_t v : hull.triangle(FaceId(f))) normals[v].push_back(plane.orthogonal_vector());
  }
  for (std::size_t v = 0; v < hull.vertex_count(); ++v) {
    EXPECT_EQ(dimension_of(normals[v]), 3);
    EXPECT_NE(std::ranges::find(points, hull.points().point(v)), points.end());
  }
}

void expect_equal(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_TRUE(a.points() == b.points());
  ASSERT_EQ(a.face_count(), b.face_count());
  for (std::size_t f = 0; f < a.face_count(); ++f) EXPECT_EQ(a.triangle(FaceId(f)), b.triangle(FaceId(f)));
}

TEST(convex_hull, cgal_agrees_on_random_sets) {
  const int count = rounds(50);
  int solid_count = 0;
  for (int seed = 0; seed < count; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<ExactPoint> points = clouds::Cloud(static_cast<std::uint64_t>(seed)).draw();
    std::vector<Kernel::Point_3> cgal_points;
    for (const ExactPoint& p : points) cgal_points.push_back(oracle::to_cgal<Kernel>(p));
    const auto hull = convex_hull(array_of(points));
    ASSERT_TRUE(hull.ok());
    ASSERT_EQ(hull->operator bool(), dimension_of(cgal_points) == 3);
    if (!*hull) continue;
    ++solid_count;
    expect_hull(**hull, points, cgal_points);
    std::ranges::reverse(points);
    std::rotate(points.begin(), points.begin() + 3, points.end());
    expect_equal(**hull, *convex_hull(array_of(points)).value());
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(solid_count, count / 2);
}

// By hand: of a grid only the corners are extreme, and a box has twelve triangles.
TEST(convex_hull, a_grid_gives_its_box) {
  std::vector<ExactPoint> points;
  for (int i = 0; i < 1000; ++i)
    points.emplace_back(
        Vec3{static_cast<double>(i / 100), static_cast<double>(i / 10 % 10), static_cast<double>(i % 10)});
  const auto hull = convex_hull(array_of(points));
  ASSERT_TRUE(hull.ok() && *hull);
  EXPECT_EQ((*hull)->vertex_count(), 8U);
  EXPECT_EQ((*hull)->face_count(), 12U);
}

TEST(convex_hull, flat_sets_have_a_reason) {
  const auto reason = [](const std::vector<ExactPoint>& points) {
    const auto hull = convex_hull(array_of(points));
    return *hull ? "none" : hull->reason();
  };
  const Vec3 a{0, 0, 0}, b{1, 2, 3}, c{2, 4, 6}, d{0, 1, 0}, e{1, 3, 3};
  EXPECT_EQ(reason({a, a}), "there is only one point, so the hull is not a solid");
  EXPECT_EQ(reason({a, b, c, a}), "all points lie on one line, so the hull is not a solid");
  EXPECT_EQ(reason({a, b, c, d, e}), "all points lie in one plane, so the hull is not a solid");
  EXPECT_TRUE(convex_hull(PointArray()).value().value().is_empty());
}

TEST(convex_hull, is_interruptible) {
  const std::atomic<bool> cancel = true;
  const auto hull = convex_hull(array_of({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}), &cancel);
  ASSERT_FALSE(hull.ok());
  EXPECT_EQ(hull.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d
