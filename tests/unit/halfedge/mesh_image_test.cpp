#include "algebra3d/kernel/halfedge/mesh_image.h"

#include <limits>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"

namespace algebra3d {
namespace {

/// A tetrahedron with thirds as coordinates, whose planes are known.
TriangleMesh thirds() {
  PointArray points;
  const Rational third(1, 3);
  for (const RationalVec3& p :
       {RationalVec3(0, 0, third), RationalVec3(1, 0, 0), RationalVec3(0, third, 0), RationalVec3(third, third, 2)})
    points.push_back(ExactPoint(p));
  const std::vector<TriangleMesh::Triangle> triangles{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 2}};
  FacePlanes planes;
  for (std::uint32_t f = 0; f < 4; ++f) {
    const auto& [a, b, c] = triangles[f];
    planes.set(f, planes.add(IntegerPlane::through({points[a], points[b], points[c]})));
  }
  return {std::move(points), triangles, std::move(planes)};
}

std::vector<AffineMap> maps() {
  const RationalVec3 centre(Rational(1, 7), 2, -3);
  return {AffineMap::translation(RationalVec3(Vec3{0.1, -5, 1e-9})),
          *AffineMap::rotation(centre, RationalVec3(0, 0, -2), 90),
          *AffineMap::rotation(centre, RationalVec3(1, 2, 3), 37),
          AffineMap::reflection(*ExactPlane::through(centre, RationalVec3(0, 1, 1))),
          AffineMap::scaling(centre, RationalVec3(Rational(1, 2), -3, Rational(5, 4)))};
}

TEST(MeshImage, has_the_images_of_corners_and_planes) {
  const TriangleMesh mesh = thirds();
  for (const AffineMap& map : maps()) {
    const TriangleMesh image = **exact_image(map, mesh);
    EXPECT_TRUE(audit(image).empty()) << audit(image).front();
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
      EXPECT_EQ(image.points()[i].rational(), map.apply(mesh.points()[i].rational()));
    for (std::uint32_t f = 0; f < 4; ++f) {
      ASSERT_NE(image.planes().find(f), nullptr);
      EXPECT_EQ(*image.planes().find(f), IntegerPlane::through(image.corners(FaceId(f))));
    }
  }
}

TEST(MeshImage, beyond_the_largest_double_is_undefined) {
  const AffineMap far = AffineMap::translation(RationalVec3(Vec3{std::numeric_limits<double>::max(), 0, 0}));
  // 1/3 more than the largest double is rounded to it, and has no box of doubles.
  EXPECT_FALSE((*exact_image(far, thirds())).is_defined());
  EXPECT_TRUE((*exact_image(AffineMap::translation(RationalVec3(Vec3{1e308, 0, 0})), thirds())).is_defined());
}

TEST(MeshImage, interrupted) {
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(exact_image(maps()[0], thirds(), &cancel).error().code, ErrorCode::interrupted);
}

std::vector<Vec3> rounded_points(const AffineMap& map, const TriangleMesh& mesh) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) points.push_back(map.apply_rounded(mesh.points()[i]));
  return points;
}

TEST(MeshImage, preimage_helps_where_triangles_are_parallel_to_axes) {
  const std::vector<Vec3> corners{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const std::vector<TriangleMesh::Triangle> halves{{0, 1, 2}, {0, 2, 3}};
  const TriangleMesh square(PointArray(corners), halves);
  const auto preimage = [&](const AffineMap& map, const TriangleMesh& mesh) {
    return preimage_of(map, mesh, rounded_points(map, mesh));
  };
  const AffineMap slanted = *AffineMap::rotation(RationalVec3(), RationalVec3(1, 2, 3), 37);
  const Preimage found = preimage(slanted, square);
  EXPECT_EQ(found.mesh, &square);
  EXPECT_GT(found.reach, 0x1p-53);
  EXPECT_LT(found.reach, 0x1p-46);
  // Scaled, the boxes are flat as before; flattened, nothing is far from anything.
  EXPECT_EQ(preimage(AffineMap::scaling(RationalVec3(), RationalVec3(3, 3, 3)), square).mesh, nullptr);
  EXPECT_EQ(preimage(AffineMap::scaling(RationalVec3(), RationalVec3(1, 0, 1)), square).mesh, nullptr);
  EXPECT_EQ(preimage(slanted, thirds()).mesh, nullptr);
}

}  // namespace
}  // namespace algebra3d
