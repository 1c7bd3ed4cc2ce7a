// mesh3d: texts and their errors, order and hash, and bytes that were damaged.
#include "algebra3d/values/types/mesh3d.h"

#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/values/types/codec.h"
#include "unit/types/reading.h"

namespace algebra3d {
namespace {

constexpr std::string_view kSquare = "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2 3)))";

const Type& mesh_type() {
  return TypeOf<Mesh3d>::type();
}
Value mesh_of(std::string_view text) {
  Reading reading = reading_of(mesh_type(), text);
  EXPECT_TRUE(reading.value.ok() && reading.value->is_defined()) << text;
  return *reading.value;
}
std::string mesh_error(std::string_view text) {
  const Reading reading = reading_of(mesh_type(), text);
  return reading.value.ok() ? "no error" : reading.value.error().text();
}

TEST(mesh3d_text, what_is_printed_is_what_was_read) {
  for (const std::string_view text :
       {kSquare, std::string_view("(() ())"), std::string_view("(((1/3 0.0 0.0)) ())"),
        std::string_view("(((0.0 0.0 0.0) (1.0 0.0 0.0) (2.0 0.0 0.0)) ((2 1 0) (0 1 2 1) (0 0 0)))")})
    EXPECT_EQ(mesh_of(text).to_nested().print(), text);
}

TEST(mesh3d_text, errors_name_the_place_and_what_was_expected) {
  const std::string notation = "mesh3d: expected ((points) (faces)) or ((points) (faces) (attributes)), got ";
  EXPECT_TRUE(mesh_error("()").starts_with(notation)) << mesh_error("()");
  EXPECT_TRUE(mesh_error("5").starts_with(notation)) << mesh_error("5");
  EXPECT_TRUE(mesh_error("(() () () ())").starts_with(notation)) << mesh_error("(() () () ())");
  EXPECT_TRUE(mesh_error("(5 ())").starts_with(notation)) << mesh_error("(5 ())");
  EXPECT_EQ(mesh_error("(((0 0 0) (1 0 0)) ((0 1)))"),
            "mesh3d: face 0: expected the numbers of three or more vertices, got (0 1)");
  EXPECT_EQ(mesh_error("(((0 0 0) (1 0 0)) ((0 1 1) 7))"),
            "mesh3d: face 1: expected the numbers of three or more vertices, got 7");
  EXPECT_EQ(mesh_error("(((0 0 0) (1 0 0)) ((0 1 2)))"),
            "mesh3d: face 0: expected the number of a vertex below 2, got 2");
  EXPECT_EQ(mesh_error("(((0 0 0) (1 0 0)) ((0 1 -1)))"),
            "mesh3d: face 0: expected the number of a vertex below 2, got -1");
  EXPECT_EQ(mesh_error("(((0 0 0) (1 0 0)) ((0 1 0.5)))"),
            "mesh3d: face 0: expected the number of a vertex below 2, got 0.5");
  EXPECT_TRUE(mesh_error("(((0 0 0) (1 0)) ())").starts_with("mesh3d: vertex 1")) << mesh_error("(((0 0 0) (1 0)) ())");
}

constexpr std::string_view kWithAttributes =
    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)) ((0 1 2)) ((vertex \"Weight\" real (1.5 undefined -2.0)) "
    "(edge \"Seam\" text (undefined 'yes' 'no')) (halfedge \"Normal\" vector ((0.0 0.0 1.0) undefined (1.0 2.0 3.0))) "
    "(halfedge \"TextureCoordinate\" pair ((0.0 0.5) (1.0 0.0) undefined)) (face \"Material\" text ('steel'))))";

TEST(mesh3d_text, attributes_are_a_third_list) {
  EXPECT_EQ(mesh_of(kWithAttributes).to_nested().print(), kWithAttributes);
  EXPECT_EQ(mesh_of("(() () ())").to_nested().print(), "(() ())");
  const auto with = [](const std::string& attributes) {
    return mesh_error("(((0 0 0) (1 0 0) (0 1 0)) ((0 1 2)) (" + attributes + "))");
  };
  const std::string expected =
      "mesh3d: attribute 0: expected (element \"name\" kind (values)) with the element vertex, edge, halfedge or face "
      "and the kind real, pair, vector or text, got ";
  EXPECT_EQ(with("5"), expected + "5");
  EXPECT_EQ(with("(side \"a\" real ())"), expected + "(side \"a\" real ())");
  EXPECT_EQ(with("(face \"a\" int ())"), expected + "(face \"a\" int ())");
  EXPECT_EQ(with("(face \"a\" real (1 2))"), "mesh3d: attribute 0: expected 1 values, one for each face, got 2");
  EXPECT_EQ(with("(face \"a\" pair (1))"), "mesh3d: attribute 0: value 0: expected 2 numbers, got 1");
  EXPECT_EQ(with("(face \"a\" text (1))"), "mesh3d: attribute 0: value 0: expected a text, got 1");
  EXPECT_EQ(with("(face \"a\" real (1)) (face \"a\" text ('b'))"),
            "mesh3d: attribute 1: a second attribute \"a\" of the same elements");
}

TEST(mesh3d_order, counts_attributes) {
  const Value plain = mesh_of("(((0 0 0) (1 0 0) (0 1 0)) ((0 1 2)))");
  const Value attributed = mesh_of(kWithAttributes);
  EXPECT_EQ(compare(plain, attributed), std::strong_ordering::less);
  EXPECT_EQ(compare(attributed, mesh_of(kWithAttributes)), std::strong_ordering::equal);
  EXPECT_EQ(hash(attributed), hash(mesh_of(kWithAttributes)));
  EXPECT_NE(hash(attributed), hash(plain));
  EXPECT_LT(heap_bytes(plain), heap_bytes(attributed));
}

TEST(mesh3d_text, box_and_size_are_those_of_vertices_and_faces) {
  const Value value = mesh_of("(((0 0 0) (1 0 0) (1 1 0) (0 1 0) (5 -6 7)) ((0 1 2 3) (0 1 4)))");
  EXPECT_EQ(value.header().size, 2U);
  EXPECT_EQ(value.header().box, (Box3{{0, -6, 0}, {5, 1, 7}}));
  EXPECT_TRUE(mesh_of("(() ())").header().box.is_empty());
}

TEST(mesh3d_order, is_total_and_agrees_with_equality_and_hash) {
  // Ascending: fewer vertices, fewer faces, vertices, degrees, corners.
  const std::vector<Value> values{
      mesh_of("(() ())"),
      mesh_of("(((0 0 0)) ())"),
      mesh_of("(((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ())"),
      mesh_of("(((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((0 1 2)))"),
      mesh_of("(((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((1 2 0)))"),
      mesh_of("(((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((0 1 2 3)))"),
      mesh_of("(((0 0 0) (1 0 0) (1 1 0) (0 1 1/3)) ((0 1 2)))"),
      mesh_of("(((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((0 1 2) (0 2 3)))"),
      mesh_of("(((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 0)) ())"),
  };
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = 0; j < values.size(); ++j) EXPECT_EQ(compare(values[i], values[j]), i <=> j) << i << " " << j;
  for (const Value& value : values) {
    const Value again = mesh_of(value.to_nested().print());
    EXPECT_EQ(compare(value, again), std::strong_ordering::equal);
    EXPECT_EQ(hash(value), hash(again));
  }
}

TEST(mesh3d_value, heap_bytes_count_the_mesh) {
  EXPECT_GT(heap_bytes(mesh_of(kSquare)), 4U * 28 + 4U * 8);
}

/// Faces of 3 to 6 corners with jumps, unused vertices and repeated corners; coordinates with fractions if wanted.
Mesh3d random_mesh(std::mt19937& random, std::uint32_t point_count, std::uint32_t face_count, bool exact, bool mixed) {
  PointArray points;
  for (std::uint32_t i = 0; i < point_count; ++i) {
    const double x = static_cast<double>(random() % 100) / 7;
    if (exact && random() % 3 == 0)
      points.push_back(ExactPoint(RationalVec3(Rational(1, 3), Rational(x), Rational(static_cast<int>(i), 7))));
    else
      points.push_back(ExactPoint(Vec3{x, static_cast<double>(i), -x}));
  }
  LargeVector<std::uint32_t> starts{0}, corners;
  std::uint32_t start = 0;
  for (std::uint32_t f = 0; f < face_count; ++f, ++start) {
    if (random() % 8 == 0) start = static_cast<std::uint32_t>(random() % point_count);
    const std::uint32_t degree = mixed ? 3 + static_cast<std::uint32_t>(random() % 4) : 4;
    for (std::uint32_t i = 0; i < degree; ++i) corners.push_back((start + i) % point_count);
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  return Mesh3d(PolygonMesh(std::move(points), PolygonLayout(std::move(starts)), std::move(corners)));
}

TEST(mesh3d_codec, meshes_come_back_number_by_number) {
  std::mt19937 random(5);
  for (std::uint32_t round = 0; round < 80; ++round) {
    const Value value =
        Value::of(random_mesh(random, 1 + static_cast<std::uint32_t>(random() % 300),
                              static_cast<std::uint32_t>(random() % 400), round % 3 == 0, round % 2 == 0));
    const auto decoded = decode(mesh_type(), encode(value), Origin::elsewhere);
    ASSERT_TRUE(decoded.ok()) << decoded.error().text();
    ASSERT_EQ(compare(*decoded, value), std::strong_ordering::equal);
    ASSERT_EQ(decoded->header().box, value.header().box);
    ASSERT_TRUE(audit(decoded->get<Mesh3d>().mesh()).empty());
  }
}

TEST(mesh3d_codec, attributes_come_back_and_damage_never_crashes) {
  const Value value = mesh_of(kWithAttributes);
  const auto decoded = decode(mesh_type(), encode(value), Origin::elsewhere);
  ASSERT_TRUE(decoded.ok()) << decoded.error().text();
  EXPECT_EQ(decoded->to_nested().print(), kWithAttributes);
  std::string body;
  mesh_type().encode(value, body);
  for (std::size_t length = 0; length < body.size(); ++length)
    ASSERT_FALSE(mesh_type().decode(std::string_view(body).substr(0, length), false).ok()) << length;
  for (std::size_t bit = 0; bit < 8 * body.size(); ++bit) {
    std::string damaged = body;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    const auto read = mesh_type().decode(damaged, false);
    if (!read.ok()) continue;
    const Mesh3d& mesh = read->get<Mesh3d>();
    ASSERT_TRUE(mesh.attributes().fits(mesh.mesh()));
    ASSERT_EQ(compare(*read, mesh_of(read->to_nested().print())), std::strong_ordering::equal);
  }
}

TEST(mesh3d_codec, damaged_bodies_never_crash_and_cut_ones_are_errors) {
  std::mt19937 random(6);
  for (std::uint32_t round = 0; round < 6; ++round) {
    std::string body;
    mesh_type().encode(Value::of(random_mesh(random, 12, 20, round % 2 == 0, round % 3 != 0)), body);
    for (std::size_t length = 0; length < body.size(); ++length)
      ASSERT_FALSE(mesh_type().decode(std::string_view(body).substr(0, length), false).ok()) << length;
    for (std::size_t bit = 0; bit < 8 * body.size(); ++bit) {
      std::string damaged = body;
      damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
      const auto decoded = mesh_type().decode(damaged, false);
      if (decoded.ok()) {
        ASSERT_TRUE(audit(decoded->get<Mesh3d>().mesh()).empty());
      } else {
        ASSERT_TRUE(decoded.error().text().starts_with("mesh3d: byte ")) << decoded.error().text();
      }
    }
  }
}

}  // namespace
}  // namespace algebra3d
