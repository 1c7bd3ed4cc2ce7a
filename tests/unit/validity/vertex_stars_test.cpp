#include "algebra3d/kernel/validity/detail/vertex_stars.h"

#include <gtest/gtest.h>

#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using samples::MeshMaker;

std::size_t embedded_count(const TriangleMesh& mesh) {
  const EmbeddedStars stars(mesh);
  std::size_t count = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) count += stars.is_embedded(VertexId(v)) ? 1U : 0U;
  return count;
}

TEST(embedded_stars, are_all_corners_of_smooth_and_of_convex_solids) {
  EXPECT_EQ(embedded_count(samples::torus(30, 20)), 600U);
  EXPECT_EQ(embedded_count(samples::cone(1000)), 1002U);
  EXPECT_EQ(embedded_count(MeshMaker().box({0, 0, 0}, {1, 2, 3}).mesh()), 8U);
  EXPECT_EQ(embedded_count(MeshMaker().box({1e9, 0, 0}, {1e9 + 1, 1e-3, 1e3}).mesh()), 8U);
}

TEST(embedded_stars, are_found_where_coordinates_are_rounded_unless_that_could_hide_a_fold) {
  EXPECT_EQ(embedded_count(MeshMaker(Rational(1, 3)).box({0, 0, 0}, {1, 1, 1}).mesh()), 8U);
  EXPECT_EQ(embedded_count(MeshMaker(Rational(1, 3)).box({1e6, 0, 0}, {1e6 + 1, 1, 1}).mesh()), 8U);
  EXPECT_EQ(embedded_count(MeshMaker(Rational(1, 3)).box({1e15, 0, 0}, {1e15 + 1, 1, 1}).mesh()), 0U);
}

TEST(embedded_stars, are_not_claimed_for_coordinates_out_of_range) {
  EXPECT_EQ(embedded_count(MeshMaker(Rational(1e-200)).box({0, 0, 0}, {1, 1, 1}).mesh()), 0U);
  EXPECT_EQ(embedded_count(MeshMaker(Rational(1e200)).box({0, 0, 0}, {1, 1, 1}).mesh()), 0U);
}

TEST(embedded_stars, are_not_claimed_where_two_bodies_touch) {
  EXPECT_EQ(embedded_count(MeshMaker().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 1}, {2, 2, 2}).mesh()), 14U);
  EXPECT_EQ(embedded_count(MeshMaker().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 0}, {2, 2, 1}).mesh()), 12U);
}

TEST(embedded_stars, are_not_claimed_for_a_fan_that_goes_round_twice) {
  for (const Rational& scale : {Rational(1), Rational(1, 3)}) {
    MeshMaker maker(scale);
    std::vector<Vec3> ring;
    for (int i = 0; i < 10; ++i)
      ring.push_back({std::cos(0.4 * std::numbers::pi * i), std::sin(0.4 * std::numbers::pi * i), 0.01 * i});
    for (std::size_t i = 0; i < 10; ++i) maker.triangle({0, 0, 0}, ring[i], ring[(i + 1) % 10]);
    EXPECT_EQ(embedded_count(maker.mesh()), 0U);
  }
}

TEST(embedded_stars, are_not_claimed_for_a_flat_fold_or_a_boundary) {
  MeshMaker fold;
  const Vec3 centre{0, 0, 0}, a{1, 0, 0}, b{0, 1, 0}, c{-1, 0, 0}, d{0.5, 0.5, 0};
  fold.triangle(centre, a, b).triangle(centre, b, c).triangle(centre, c, d).triangle(centre, d, a);
  EXPECT_EQ(embedded_count(fold.mesh()), 0U);
  EXPECT_EQ(embedded_count(MeshMaker().triangle(centre, a, b).triangle(centre, b, c).mesh()), 0U);
  EXPECT_EQ(embedded_count({}), 0U);
}

}  // namespace
}  // namespace algebra3d
