#include "algebra3d/kernel/validity/detail/height_fields.h"

#include <gtest/gtest.h>

#include <set>

#include "algebra3d/kernel/validity/validity.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using samples::MeshMaker;

std::size_t faces_in_fields(const TriangleMesh& mesh) {
  const HeightFields fields(mesh);
  std::size_t count = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) count += fields.field(FaceId(f)).is_none() ? 0U : 1U;
  return count;
}

std::size_t inner_vertices(const TriangleMesh& mesh) {
  const HeightFields fields(mesh);
  std::size_t count = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) count += fields.is_inside(VertexId(v)) ? 1U : 0U;
  return count;
}

std::size_t field_count(const TriangleMesh& mesh) {
  const HeightFields fields(mesh);
  std::set<RegionId> found;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) found.insert(fields.field(FaceId(f)));
  found.erase(RegionId());
  return found.size();
}

/// A ramp that winds up round the z axis, `steps` quads of 30 degrees, seen from above; each turn is `rise` higher.
TriangleMesh ramp(int steps, double rise) {
  MeshMaker maker;
  const auto corner = [&](int step, double radius) {
    // By a table, so that the corners of two turns are exactly above each other.
    constexpr std::array<double, 12> kCosines{1, 0.875, 0.5, 0, -0.5, -0.875, -1, -0.875, -0.5, 0, 0.5, 0.875};
    const auto at = [&](int i) { return kCosines[static_cast<std::size_t>(i % 12)]; };
    return Vec3{radius * at(step), radius * at(step + 9), rise * step / 12};
  };
  for (int i = 0; i < steps; ++i) maker.quad(corner(i, 1), corner(i, 2), corner(i + 1, 2), corner(i + 1, 1));
  return maker.mesh();
}

TEST(height_fields, are_the_sides_of_a_box) {
  const TriangleMesh box = MeshMaker().box({0, 0, 0}, {1, 2, 3}).mesh();
  const HeightFields fields(box);
  EXPECT_EQ(field_count(box), 6U);
  for (std::uint32_t f = 0; f < 12; ++f)
    for (std::uint32_t g = 0; g < 12; ++g)
      EXPECT_EQ(fields.are_in_one(FaceId(f), FaceId(g)), f / 2 == g / 2) << f << " " << g;
  EXPECT_EQ(inner_vertices(box), 0U);
}

TEST(height_fields, cover_smooth_solids_with_few_parts) {
  const TriangleMesh torus = samples::torus(60, 40);
  EXPECT_EQ(faces_in_fields(torus), torus.face_count());
  EXPECT_LE(field_count(torus), 12U);
  EXPECT_GT(inner_vertices(torus), torus.vertex_count() / 2);
  EXPECT_EQ(faces_in_fields(samples::cone(100)), 200U);
}

TEST(height_fields, are_not_claimed_for_sheets_above_each_other) {
  EXPECT_EQ(faces_in_fields(ramp(11, 1)), 22U);
  EXPECT_EQ(faces_in_fields(ramp(13, 1)), 0U);
  EXPECT_EQ(inner_vertices(ramp(30, 1)), 0U);
  EXPECT_TRUE(prove_surface(ramp(30, 1))->is_valid());
}

TEST(height_fields, do_not_hide_a_sheet_that_crosses_itself_far_from_its_neighbours) {
  // The second turn begins above the first one and ends below it.
  MeshMaker maker;
  const TriangleMesh wound = ramp(24, 0.1);
  for (std::size_t f = 0; f < wound.face_count(); ++f) {
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = wound.corners(FaceId(f))[i].approx;
      if (corners[i].z > 0.1) corners[i].z = 0.6 - 4 * corners[i].z;
    }
    maker.triangle(corners[0], corners[1], corners[2]);
  }
  const TriangleMesh mesh = maker.mesh();
  EXPECT_EQ(faces_in_fields(mesh), 0U);
  EXPECT_GT(prove_surface(mesh)->count(Defect::intersecting_triangles), 0U);
}

TEST(height_fields, need_doubles_and_area) {
  EXPECT_EQ(faces_in_fields(MeshMaker(Rational(1, 3)).box({0, 0, 0}, {1, 2, 4}).mesh()), 0U);
  EXPECT_EQ(faces_in_fields(MeshMaker().triangle({0, 0, 0}, {1, 1, 1}, {3, 3, 3}).mesh()), 0U);
  EXPECT_EQ(faces_in_fields(MeshMaker().triangle({0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}).mesh()), 0U);
  EXPECT_EQ(faces_in_fields(MeshMaker().triangle({0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0}).mesh()), 0U);
}

TEST(height_fields, do_not_have_a_vertex_inside_where_fans_of_two_fields_touch) {
  const Vec3 tip{0, 0, 0};
  MeshMaker maker;
  for (const double z : {1.0, -1.0}) {
    const std::array<Vec3, 3> base{Vec3{3, 0, z}, Vec3{-2, 2, z}, Vec3{-2, -2, z}};
    for (std::size_t i = 0; i < 3; ++i) maker.triangle(tip, base[i], base[(i + 1) % 3]);
  }
  const TriangleMesh mesh = maker.mesh();
  EXPECT_EQ(field_count(mesh), 2U);
  EXPECT_EQ(inner_vertices(mesh), 0U);
}

}  // namespace
}  // namespace algebra3d
