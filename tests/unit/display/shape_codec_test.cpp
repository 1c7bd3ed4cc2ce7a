#include "algebra3d/values/display/shape_codec.h"

#include <string>

#include <gtest/gtest.h>

#include "algebra3d/values/display/glb.h"
#include "algebra3d/values/display/triangle_tree.h"
#include "unit/display/values.h"

namespace algebra3d {
namespace {

/// A shape with something in every field.
DrawnShape full_shape() {
  DrawnShape shape = shape_of_solid(unit_sphere(30, 40));
  add_tree(shape);
  shape.boundary = {{0, 1}};
  shape.nonmanifold = {{1, 2}, {2, 3}};
  shape.lines = {{3, 4}};
  shape.points = {5, 6, 7};
  shape.face_ids.assign(shape.triangles.size(), 8);
  shape.vertex_ids.assign(shape.positions.size(), 9);
  shape.deviation = 0.125;
  return shape;
}

TEST(ShapeCodec, gives_back_what_was_encoded) {
  const DrawnShape shape = full_shape();
  ASSERT_FALSE(shape.tree.empty());
  const auto decoded = decode_shape(encode_shape(shape));
  ASSERT_TRUE(decoded.ok());
  EXPECT_EQ(decoded->kind, shape.kind);
  EXPECT_EQ(decoded->box, shape.box);
  EXPECT_EQ(decoded->origin, shape.origin);
  EXPECT_EQ(decoded->triangle_count, shape.triangle_count);
  EXPECT_EQ(decoded->deviation, shape.deviation);
  EXPECT_EQ(decoded->positions, shape.positions);
  EXPECT_EQ(decoded->normals, shape.normals);
  EXPECT_EQ(decoded->triangles, shape.triangles);
  EXPECT_EQ(decoded->edges, shape.edges);
  EXPECT_EQ(decoded->boundary, shape.boundary);
  EXPECT_EQ(decoded->nonmanifold, shape.nonmanifold);
  EXPECT_EQ(decoded->lines, shape.lines);
  EXPECT_EQ(decoded->points, shape.points);
  EXPECT_EQ(decoded->face_ids, shape.face_ids);
  EXPECT_EQ(decoded->vertex_ids, shape.vertex_ids);
  EXPECT_EQ(decoded->tree, shape.tree);
}

TEST(ShapeCodec, refuses_bytes_that_are_cut_or_longer) {
  const std::string bytes = encode_shape(full_shape());
  for (std::size_t size = 0; size < bytes.size(); size += size < 400 ? 1 : 997) {
    const auto decoded = decode_shape(std::string_view(bytes).substr(0, size));
    ASSERT_FALSE(decoded.ok()) << size;
    EXPECT_EQ(decoded.error().code, ErrorCode::database_corrupt);
  }
  EXPECT_FALSE(decode_shape(bytes + '\0').ok());
}

TEST(ShapeCodec, refuses_lengths_that_cannot_be) {
  std::string bytes = encode_shape(full_shape());
  // The length of the kind comes first, that of the positions after kind, box, origin, count and deviation.
  for (const std::size_t at : {std::size_t{8}, std::size_t{16 + 8 + 48 + 24 + 8 + 16}}) {
    std::string damaged = bytes;
    for (std::size_t i = 0; i < 8; ++i) damaged[at + i] = '\xff';
    EXPECT_FALSE(decode_shape(damaged).ok());
  }
}

TEST(ShapeCodec, names_a_newer_version) {
  std::string bytes = encode_shape(full_shape());
  bytes[4] = 2;
  const auto decoded = decode_shape(bytes);
  ASSERT_FALSE(decoded.ok());
  EXPECT_EQ(decoded.error().code, ErrorCode::database_version);
  EXPECT_EQ(decoded.error().text(), "a stored shape of version 2; this program reads version 1");
}

}  // namespace
}  // namespace algebra3d
