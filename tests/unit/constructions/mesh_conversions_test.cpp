#include "algebra3d/values/constructions/mesh_conversions.h"

#include <random>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "unit/operators/call_operator.h"
#include "unit/validity/sample_meshes.h"

namespace algebra3d {
namespace {

using calls::call;
using samples::MeshMaker;

Volume3d solid_of(const MeshMaker& maker) {
  auto solid = Volume3d::prove(maker.mesh());
  EXPECT_TRUE(solid.ok() && solid->is_defined());
  return **solid;
}

PolygonMesh merged(const TriangleMesh& mesh) {
  auto result = polygon_mesh_of(mesh, Merging::coplanar_facets);
  EXPECT_TRUE(result.ok());
  return *std::move(result);
}

void expect_flat_faces(const PolygonMesh& mesh) {
  for (const FaceId f : faces(mesh)) {
    std::vector<PointRef> corners;
    for (const VertexId v : vertices_of(mesh, f)) corners.push_back(mesh.point(v));
    for (std::size_t i = 3; i < corners.size(); ++i)
      for (std::size_t j = 2; j < i; ++j) ASSERT_EQ(orient3d(corners[0], corners[1], corners[j], corners[i]), 0);
  }
}

bool is_same_solid(const Value& a, const Value& b) {
  return a.is_defined() && b.is_defined() && compare(a, b) == std::strong_ordering::equal;
}

/// There and back again, with triangles and with polygons.
void expect_round_trips(const Volume3d& solid) {
  for (const bool is_merged : {false, true}) {
    const Mesh3d mesh = call("volume2mesh", solid, is_merged).get<Mesh3d>();
    EXPECT_TRUE(audit(mesh.mesh()).empty());
    expect_flat_faces(mesh.mesh());
    EXPECT_TRUE(is_same_solid(call("mesh2volume", mesh).single(), Value::of(solid)));
    const Mesh3d triangles = call("triangulate", mesh).get<Mesh3d>();
    EXPECT_TRUE(is_same_solid(call("mesh2volume", triangles).single(), Value::of(solid)));
  }
}

Volume3d united(const Volume3d& a, const Volume3d& b) {
  return call("union", a, b).get<Volume3d>();
}

TEST(MeshConversions, cube_has_six_quads_whatever_its_triangles) {
  const PolygonMesh cube = merged(MeshMaker().box({0, 0, 0}, {1, 1, 1}).mesh());
  EXPECT_EQ(cube.face_count(), 6U);
  EXPECT_EQ(cube.common_degree(), 4U);
  EXPECT_EQ(cube.vertex_count(), 8U);
  EXPECT_EQ(euler_characteristic(cube), 2);
  // Two halves of which the union has vertices in the middle of edges, or not: the polygons do not tell.
  const Volume3d whole =
      united(solid_of(MeshMaker().box({0, 0, 0}, {1, 1, 1})), solid_of(MeshMaker().box({1, 0, 0}, {2, 1, 1})));
  EXPECT_EQ(merged(whole.mesh()).common_degree(), 4U);
  EXPECT_EQ(merged(whole.mesh()).face_count(), 6U);
}

TEST(MeshConversions, vertices_in_straight_edges_of_two_polygons_go) {
  // Two triangles on each side of a line through the middle of a square: 9 vertices, of which 4 are corners.
  const Vec3 a{0, 0, 0}, b{2, 0, 0}, c{2, 2, 0}, d{0, 2, 0}, centre{1, 1, 0};
  const PolygonMesh square = merged(MeshMaker()
                                        .triangle(a, {1, 0, 0}, centre)
                                        .triangle({1, 0, 0}, b, centre)
                                        .triangle(b, c, centre)
                                        .triangle(c, d, centre)
                                        .triangle(d, a, centre)
                                        .mesh());
  EXPECT_EQ(square.face_count(), 1U);
  EXPECT_EQ(square.vertex_count(), 4U);
}

TEST(MeshConversions, facets_with_holes_stay_triangulated) {
  const Volume3d frame =
      call("minus", solid_of(MeshMaker().box({0, 0, 0}, {3, 3, 1})), solid_of(MeshMaker().box({1, 1, -1}, {2, 2, 2})))
          .get<Volume3d>();
  const PolygonMesh mesh = merged(frame.mesh());
  std::size_t quads = 0, triangles = 0;
  for (const FaceId f : faces(mesh)) ++(mesh.degree(f) == 4 ? quads : triangles);
  EXPECT_EQ(quads, 8U);
  EXPECT_EQ(triangles, 16U);  // n + 2h - 2 of each of two facets
  EXPECT_EQ(*genus(mesh), 1);
  expect_round_trips(frame);
}

TEST(MeshConversions, solids_come_back_equal) {
  expect_round_trips(Volume3d());
  expect_round_trips(solid_of(MeshMaker().tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1})));
  expect_round_trips(solid_of(MeshMaker(Rational(1, 3), Rational(1, 7)).box({0, 0, 0}, {1, 2, 3})));
  expect_round_trips(solid_of(MeshMaker().box({1, 1, 1}, {2, 2, 2}, true).box({0, 0, 0}, {4, 4, 4})));
  // Two that touch along an edge, and two that touch in a point.
  expect_round_trips(solid_of(MeshMaker().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 0}, {2, 2, 1})));
  expect_round_trips(solid_of(MeshMaker().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 1}, {2, 2, 2})));
}

TEST(MeshConversions, random_unions_and_differences_of_boxes_come_back_equal) {
  std::mt19937 random(12);
  const auto box = [&] {
    const auto number = [&] { return static_cast<double>(random() % 5); };
    const Vec3 low{number(), number(), number()};
    return solid_of(MeshMaker(Rational(1, random() % 2 == 0 ? 1 : 3))
                        .box(low, low + Vec3{1 + number(), 1 + number(), 1 + number()}));
  };
  for (int round = 0; round < 25; ++round) {
    const Volume3d solid = call("minus", united(united(box(), box()), box()), box()).get<Volume3d>();
    expect_round_trips(solid);
    EXPECT_EQ(call("volume2mesh", solid).get<Mesh3d>().mesh().face_count(), solid.mesh().face_count());
  }
}

TEST(MeshConversions, unused_points_are_left_out) {
  const TriangleMesh mesh(PointArray(std::vector<Vec3>{{9, 9, 9}, {0, 0, 0}, {8, 8, 8}, {1, 0, 0}, {0, 1, 0}}),
                          std::vector<TriangleMesh::Triangle>{{4, 1, 3}});
  const auto polygons = polygon_mesh_of(mesh, Merging::none);
  ASSERT_TRUE(polygons.ok());
  EXPECT_EQ(polygons->vertex_count(), 3U);
  EXPECT_EQ(polygons->origins(), (LargeVector<std::uint32_t>{2, 0, 1}));
}

TEST(MeshConversions, the_corners_of_a_mirrored_face_are_reversed) {
  const auto plane = calls::call("makePlane3D", Point3d{Vec3{0, 0, 0}}, Vector3d{Vec3{1, 0, 0}});
  const Mesh3d square(PolygonMesh(PointArray(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
                                  PolygonLayout::of_degree(4), {0, 1, 2, 3}));
  EXPECT_EQ(call("mirror", square, plane.get<Plane3d>()).text(),
            "(((0.0 0.0 0.0) (-1.0 0.0 0.0) (-1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 3 2 1)))");
  EXPECT_EQ(call("scaleDir", square, Point3d{Vec3{0, 0, 0}}, Vector3d{Vec3{2, 0, 1}}).text(),
            "(((0.0 0.0 0.0) (2.0 0.0 0.0) (2.0 0.0 0.0) (0.0 0.0 0.0)) ((0 1 2 3)))");
}

}  // namespace
}  // namespace algebra3d
