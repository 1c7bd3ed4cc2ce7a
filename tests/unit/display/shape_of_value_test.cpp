#include "algebra3d/values/display/shape_of_value.h"

#include <atomic>
#include <cmath>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/values/types/all.h"
#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/time.h"
#include "unit/display/values.h"

namespace algebra3d {
namespace {

using Lines = std::set<std::pair<Vec3, Vec3>>;

/// Lines by their ends, which are ordered.
Lines lines_of(const DrawnShape& shape, const LargeVector<DrawnShape::Line>& lines) {
  Lines found;
  for (const auto& [a, b] : lines) {
    const Vec3 from = place(shape, a), to = place(shape, b);
    found.insert({std::min(from, to), std::max(from, to)});
  }
  EXPECT_EQ(found.size(), lines.size()) << "each once";
  return found;
}

/// The twelve edges of an axis-parallel box.
Lines edges_of_box(const Vec3& low, const Vec3& high) {
  Lines edges;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      Vec3 from = low;
      if ((corner & 1) != 0) from[(axis + 1) % 3] = high[(axis + 1) % 3];
      if ((corner & 2) != 0) from[(axis + 2) % 3] = high[(axis + 2) % 3];
      Vec3 to = from;
      to[axis] = high[axis];
      edges.insert({from, to});
    }
  return edges;
}

TEST(ShapeOfValue, of_a_cube_has_twelve_edges_and_four_vertices_for_each_side) {
  const DrawnShape shape = shape_of_solid(cube_triangles(1, 3));
  EXPECT_EQ(shape.kind, "volume3d");
  EXPECT_EQ(shape.box, (Box3{{1, 1, 1}, {3, 3, 3}}));
  EXPECT_EQ(shape.origin, (Vec3{2, 2, 2}));
  EXPECT_EQ(shape.triangle_count, 12U);
  EXPECT_EQ(shape.triangles.size(), 12U);
  EXPECT_EQ(shape.positions.size(), 24U);
  EXPECT_EQ(shape.normals.size(), 24U);
  EXPECT_EQ(lines_of(shape, shape.edges), edges_of_box({1, 1, 1}, {3, 3, 3}));
  EXPECT_TRUE(shape.boundary.empty() && shape.nonmanifold.empty() && shape.lines.empty() && shape.points.empty());
  EXPECT_TRUE(shape.face_ids.empty());
  EXPECT_FALSE(shape.deviation.has_value());
}

TEST(ShapeOfValue, normals_point_to_the_front_of_their_triangles) {
  const DrawnShape shape = shape_of_solid(cube_triangles(-1, 1));
  for (const IndexTriangle& triangle : shape.triangles) {
    const Vec3 area = doubled_area(shape, triangle);
    EXPECT_GT(dot(area, place(shape, triangle[0])), 0) << "counter-clockwise seen from outside";
    for (const std::uint32_t corner : triangle) {
      const auto& [x, y, z, filling] = shape.normals[corner];
      EXPECT_EQ((Vec3{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}), 127.0 / 4 * area);
      EXPECT_EQ(filling, 0);
    }
  }
}

TEST(ShapeOfValue, vertex_ids_tell_the_vertices_that_were_divided) {
  const TriangleMesh cube = cube_triangles(0, 1);
  const DrawnShape shape = shape_of_solid(cube);
  ASSERT_EQ(shape.vertex_ids.size(), shape.positions.size());
  for (std::uint32_t i = 0; i < shape.positions.size(); ++i)
    EXPECT_EQ(place(shape, i), cube.points().approx()[shape.vertex_ids[i]]);
}

TEST(ShapeOfValue, a_smooth_surface_keeps_its_vertices) {
  const TriangleMesh mesh = unit_sphere(40, 60);
  const DrawnShape shape = shape_of_solid(mesh);
  EXPECT_EQ(shape.positions.size(), mesh.vertex_count());
  EXPECT_TRUE(shape.vertex_ids.empty());
  for (std::uint32_t i = 0; i < shape.positions.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(shape.normals[i][axis], 127 * place(shape, i)[axis], 127 * 0.01) << "that of the sphere";
}

/// A finely divided lens of two caps: only its rim, where they meet, is a crease.
TEST(ShapeOfValue, of_large_meshes_only_creases_are_edges) {
  constexpr std::uint32_t kRings = 720, kColumns = 800;
  const TriangleMesh sphere = unit_sphere(kRings, kColumns);
  std::vector<Vec3> points = sphere.points().approx();
  for (Vec3& p : points) {
    // From the height over the equator to that over the chord: a cap of 60 degrees, twice.
    const double radius = std::hypot(p.x, p.y);
    p.z = (p.z < 0 ? -1 : 1) * (std::sqrt(4 - radius * radius) - std::sqrt(3.0));
  }
  const std::vector<TriangleMesh::Triangle> triangles = triangles_of(sphere);
  ASSERT_GT(triangles.size(), 1000000U);
  const DrawnShape shape = shape_of_solid(TriangleMesh(PointArray(std::move(points)), triangles));
  EXPECT_EQ(shape.edges.size(), kColumns);
  for (const auto& line : shape.edges)
    for (const std::uint32_t end : line) EXPECT_NEAR(place(shape, end).z, 0, 1e-6);
}

TEST(ShapeOfValue, far_from_zero_nothing_moves) {
  const DrawnShape shape = shape_of_solid(cube_triangles(1e9, 1e9 + 0.5));
  EXPECT_EQ(lines_of(shape, shape.edges), edges_of_box({1e9, 1e9, 1e9}, {1e9 + 0.5, 1e9 + 0.5, 1e9 + 0.5}));
}

/// A square of two triangles with a corner that is not a double.
TEST(ShapeOfValue, flat_surfaces_have_boundary_and_no_edges) {
  const DrawnShape shape = shape_from<Surface3d>("(((0 0 1/3) (1 0 1/3) (1 1 1/3)) ((0 0 1/3) (1 1 1/3) (0 1 1/3)))");
  EXPECT_EQ(shape.triangles.size(), 2U);
  EXPECT_EQ(shape.positions.size(), 4U);
  EXPECT_EQ(shape.boundary.size(), 4U);
  EXPECT_TRUE(shape.edges.empty());
}

TEST(ShapeOfValue, a_slight_bend_is_an_edge) {
  const DrawnShape shape = shape_from<Surface3d>("(((0 0 0) (1 0 0) (1 1 1e-300)) ((0 0 0) (1 1 1e-300) (0 1 0)))");
  EXPECT_EQ(shape.edges.size(), 1U);
}

TEST(ShapeOfValue, polygons_of_a_mesh_are_divided_and_keep_their_edges) {
  const DrawnShape shape = shape_from<Mesh3d>(cube_mesh(0, 2));
  EXPECT_EQ(shape.triangle_count, 12U);
  EXPECT_EQ(shape.triangles.size(), 12U);
  EXPECT_EQ(lines_of(shape, shape.edges), edges_of_box({0, 0, 0}, {2, 2, 2}));
  EXPECT_EQ(shape.face_ids, (LargeVector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}));
  const DrawnShape flat = shape_from<Mesh3d>("(((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((0 1 2) (0 2 3)))");
  EXPECT_EQ(lines_of(flat, flat.edges), (Lines{{{0, 0, 0}, {1, 1, 0}}})) << "between two faces, if flat";
}

TEST(ShapeOfValue, defects_of_a_mesh_are_shown) {
  const DrawnShape shape =
      shape_from<Mesh3d>("(((0 0 0) (0 0 1) (1 0 0) (0 1 0) (-1 -1 0) (5 5 5)) ((0 1 2) (1 0 3) (0 1 4)))");
  EXPECT_EQ(lines_of(shape, shape.nonmanifold), (Lines{{{0, 0, 0}, {0, 0, 1}}}));
  EXPECT_EQ(shape.boundary.size(), 6U);
  EXPECT_TRUE(shape.edges.empty());
  ASSERT_EQ(shape.points.size(), 1U);
  EXPECT_EQ(place(shape, shape.points[0]), (Vec3{5, 5, 5})) << "a vertex without faces";
  EXPECT_EQ(shape.vertex_ids[shape.points[0]], 5U);
  EXPECT_EQ(shape.normals.size(), shape.positions.size());
}

TEST(ShapeOfValue, of_points) {
  const DrawnShape shape = shape_from<Points3d>("((0 0 0) (1 2 3) (4 0 0))");
  ASSERT_EQ(shape.points, (LargeVector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(place(shape, 1), (Vec3{1, 2, 3}));
  EXPECT_EQ(place(shape_from<Point3d>("(1 2 3)"), 0), (Vec3{1, 2, 3}));
  EXPECT_EQ(place(shape_from<Point2d>("(1 2)"), 0), (Vec3{1, 2, 0}));
}

TEST(ShapeOfValue, a_vector_is_an_arrow) {
  const DrawnShape shape = shape_from<Vector3d>("(0 0 8)");
  ASSERT_EQ(shape.lines.size(), 5U);
  EXPECT_EQ(place(shape, shape.lines[0][0]), (Vec3{0, 0, 0}));
  EXPECT_EQ(place(shape, shape.lines[0][1]), (Vec3{0, 0, 8}));
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(place(shape, shape.lines[i][1]).z, 7, 1e-6) << "the head";
  EXPECT_EQ(shape_from<Vector3d>("(0 0 0)").points.size(), 1U);
}

TEST(ShapeOfValue, a_plane_is_a_square_round_the_point_nearest_to_the_origin) {
  const DrawnShape shape = shape_from<Plane3d>("(6.0 2.0 1.0 2.0)");  // foot (4 2 4)
  ASSERT_EQ(shape.triangles.size(), 2U);
  Vec3 area;
  for (const IndexTriangle& triangle : shape.triangles) {
    area = area + 0.5 * doubled_area(shape, triangle);
    for (const std::uint32_t corner : triangle)
      EXPECT_NEAR(dot(place(shape, corner), Vec3{2, 1, 2}), 18, 1e-5) << "in the plane";
  }
  EXPECT_NEAR(dot(area, (Vec3{2.0 / 3, 1.0 / 3, 2.0 / 3})), 144, 1e-4) << "12 by 12, front where the normal points";
  EXPECT_EQ(shape.lines.size(), 4U + 5U) << "frame and arrow";
}

TEST(ShapeOfValue, boxes_have_as_many_lines_as_edges) {
  const DrawnShape shape = shape_from<Box3>("(0 1 0 2 0 3)");
  EXPECT_EQ(lines_of(shape, shape.lines), edges_of_box({0, 0, 0}, {1, 2, 3}));
  EXPECT_EQ(shape_from<Box3>("(0 1 0 2 3 3)").lines.size(), 4U);
  EXPECT_EQ(shape_from<Box3>("(0 1 2 2 3 3)").lines.size(), 1U);
  EXPECT_EQ(shape_from<Box3>("(1 1 2 2 3 3)").points.size(), 1U);
  EXPECT_EQ(shape_from<Box3>("(1 1 2 2 3 3)").positions.size(), 1U);
}

TEST(ShapeOfValue, values_in_the_plane_look_up) {
  const DrawnShape rect = shape_from<Rect>("(0 2 0 3)");
  EXPECT_EQ(rect.lines.size(), 4U);
  ASSERT_EQ(rect.triangles.size(), 2U);
  for (const IndexTriangle& triangle : rect.triangles) EXPECT_EQ(doubled_area(rect, triangle), (Vec3{0, 0, 6}));

  const DrawnShape region = shape_from<Region>("((((0 0) (4 0) (4 4) (0 4)) ((1 1) (2 1) (2 2) (1 2))))");
  EXPECT_EQ(region.lines.size(), 8U);
  double area = 0;
  for (const IndexTriangle& triangle : region.triangles) {
    EXPECT_GT(doubled_area(region, triangle).z, 0);
    area += doubled_area(region, triangle).z / 2;
  }
  EXPECT_EQ(area, 15);
  EXPECT_EQ(region.normals[0], (DrawnShape::Normal{0, 0, 127, 0}));
}

TEST(ShapeOfValue, is_empty_for_undefined_and_empty_values) {
  for (const Type* type : all_types()) {
    if (!is_drawable(*type)) continue;
    const Result<DrawnShape> shape = shape_of(Value(*type));
    ASSERT_TRUE(shape.ok());
    EXPECT_TRUE(shape->is_empty());
    EXPECT_EQ(shape->kind, type->name());
    EXPECT_TRUE(shape->box.is_empty());
  }
  EXPECT_TRUE(shape_of(Value::of(Volume3d()))->is_empty());
  EXPECT_TRUE(shape_of(Value::of(Mesh3d()))->is_empty());
  EXPECT_TRUE(shape_of(Value::of(Points3d()))->is_empty());
  EXPECT_TRUE(shape_of(Value::of(Region()))->is_empty());
}

/// The example of each spatial type has a shape of its own kind within its box.
TEST(ShapeOfValue, all_spatial_types_but_moving_ones_are_drawable) {
  std::set<std::string_view> others;
  for (const Type* type : all_types()) {
    if (!is_drawable(*type)) {
      others.insert(type->name());
      continue;
    }
    Diagnostics diagnostics;
    Context context{diagnostics, nullptr, {}};
    const auto value = value_from_nested(*type, *NestedList::parse(type->example()), context);
    ASSERT_TRUE(value.ok()) << type->name();
    const Result<DrawnShape> shape = shape_of(*value);
    ASSERT_TRUE(shape.ok()) << type->name();
    EXPECT_FALSE(shape->is_empty()) << type->name();
    if (type->is_spatial()) {
      EXPECT_EQ(shape->box, value->header().box) << type->name();
    }
  }
  EXPECT_EQ(others, (std::set<std::string_view>{"int", "real", "bool", "string", "text", "bytes", "instant", "duration",
                                                "interval", "tid", "uregion", "mregion"}));
}

TEST(ShapeOfValue, a_nested_relation_has_the_shapes_of_its_tuples) {
  const auto type_of = [](std::string_view tuple) -> const Type& {
    return **NestedRelationType::of(*TypeExpr::from_nested(*NestedList::parse(tuple)));
  };
  EXPECT_FALSE(is_drawable(type_of("(tuple ((A int)))")));
  EXPECT_TRUE(is_drawable(type_of("(tuple ((A int) (R (arel (tuple ((P point3d)))))))")));
  const Type& type = type_of("(tuple ((B rect3) (R (arel (tuple ((P point3d) (T surface3d)))))))");
  Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};
  const auto value =
      value_from_nested(type,
                        *NestedList::parse("(((0 2 0 2 0 2) (((9 9 9) (((8 0 0) (9 0 0) (8 1 0)))) (undefined ())))"
                                           " (undefined undefined) ((10 20 0 2 0 2) (((15 1 1) undefined))))"),
                        context);
  ASSERT_TRUE(value.ok()) << value.error().text();
  const Result<DrawnShape> shape = shape_of(*value);
  ASSERT_TRUE(shape.ok());
  EXPECT_EQ(shape->kind, "arel");
  EXPECT_EQ(shape->box, (Box3{{0, 0, 0}, {20, 9, 9}}));
  EXPECT_EQ(shape->triangles.size(), 1U);
  EXPECT_EQ(shape->triangle_count, 1U);
  EXPECT_EQ(shape->lines.size(), 24U);
  EXPECT_EQ(shape->points.size(), 2U);
  EXPECT_EQ(shape->normals.size(), shape->positions.size());
  const auto place_of = [&](std::uint32_t position) {
    const DrawnShape::Position& p = shape->positions[position];
    return shape->origin + Vec3{p[0], p[1], p[2]};
  };
  EXPECT_EQ(place_of(shape->points[0]), (Vec3{9, 9, 9}));
  EXPECT_EQ(place_of(shape->points[1]), (Vec3{15, 1, 1}));
  for (const std::uint32_t corner : shape->triangles[0]) {
    EXPECT_GE(place_of(corner).x, 8);
    EXPECT_EQ(place_of(corner).z, 0);
    EXPECT_NE(shape->normals[corner], DrawnShape::Normal());
  }
  EXPECT_TRUE(shape_of(Value(type))->is_empty());
}

TEST(ShapeOfValue, refuses_what_floats_cannot_hold) {
  const Result<DrawnShape> shape = shape_of(value_of<Box3>("(0 1e300 0 1 0 1)"));
  ASSERT_FALSE(shape.ok());
  EXPECT_EQ(shape.error().code, ErrorCode::limit_exceeded);
  EXPECT_EQ(shape.error().text(),
            "nothing of this size can be drawn: it reaches from 0 to 1e+300 along x; at most 1.7e+38 are possible");
}

TEST(ShapeOfValue, what_floats_cannot_resolve_is_a_point) {
  for (const double size : {1e-30, 1e-160}) {
    const TriangleMesh cube = cube_triangles(0, size);
    const Result<DrawnShape> shape = shape_of(Value::of(Volume3d::trusted(cube)));
    ASSERT_TRUE(shape.ok());
    EXPECT_EQ(shape->box.max, (Vec3{size, size, size}));
    EXPECT_EQ(shape->triangle_count, 12U);
    EXPECT_EQ(shape->kind, "volume3d");
    if (size > 0x1p-100) {
      EXPECT_EQ(shape->triangles.size(), 12U);
      EXPECT_TRUE(shape->points.empty());
      continue;
    }
    EXPECT_TRUE(shape->triangles.empty() && shape->edges.empty() && shape->normals.empty());
    EXPECT_EQ(shape->origin, (Vec3{size / 2, size / 2, size / 2}));
    ASSERT_EQ(shape->positions.size(), 1U);
    EXPECT_EQ(shape->positions[0], (DrawnShape::Position{0, 0, 0}));
    ASSERT_EQ(shape->points.size(), 1U);
    EXPECT_EQ(shape->points[0], 0U);
  }
}

TEST(ShapeOfValue, can_be_interrupted) {
  const std::atomic<bool> cancel = true;
  const Result<DrawnShape> shape = shape_of(Value::of(Volume3d::trusted(cube_triangles(0, 1))), Monitor(&cancel));
  ASSERT_FALSE(shape.ok());
  EXPECT_EQ(shape.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d
