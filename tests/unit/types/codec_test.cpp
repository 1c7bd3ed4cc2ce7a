// The binary form: round trips, the page that describes it, and bytes that were damaged.
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/bytes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/values/types/all.h"
#include "algebra3d/values/types/detail/codec_points.h"
#include "algebra3d/values/types/detail/mesh_codec.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/moving_region.h"
#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/time.h"

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

Value read(const Type& type, std::string_view text) {
  Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};
  const auto list = NestedList::parse(text);
  EXPECT_TRUE(list.ok()) << text;
  auto value = value_from_nested(type, *list, context);
  EXPECT_TRUE(value.ok()) << text;
  return *value;
}

/// The type of nested relations of a tuple type, given as a nested list.
const Type* nested(std::string_view tuple) {
  const auto term = TypeExpr::from_nested(*NestedList::parse(tuple));
  return *NestedRelationType::of(*term);
}

/// A mesh that need not be valid, with coordinates of many kinds.
TriangleMesh random_mesh(std::mt19937& random, std::size_t point_count, std::size_t triangle_count, bool exact) {
  std::uniform_int_distribution<int> small(-20, 20);
  std::uniform_real_distribution<double> real(-1, 1);
  PointArray points;
  for (std::size_t i = 0; i < point_count; ++i) {
    const Vec3 doubles{static_cast<double>(small(random)), static_cast<double>(static_cast<float>(real(random))),
                       real(random) * std::pow(10.0, small(random) * 15)};
    if (exact && random() % 3 == 0)
      points.push_back(ExactPoint(RationalVec3(Rational(small(random), 7), Rational(doubles.y), Rational(1, 3))));
    else
      points.push_back(ExactPoint(doubles));
  }
  std::vector<Triangle> triangles;
  std::uint32_t start = 0;
  for (std::size_t t = 0; t < triangle_count; ++t) {
    // Strips with jumps between them, so that shared edges and corners without one occur.
    if (random() % 8 == 0) start = static_cast<std::uint32_t>(random() % point_count);
    Triangle triangle{};
    for (std::uint32_t i = 0; i < 3; ++i)
      triangle[t % 2 == 0 ? i : 2 - i] = static_cast<std::uint32_t>((start + i) % point_count);
    std::rotate(triangle.begin(), triangle.begin() + random() % 3, triangle.end());
    triangles.push_back(triangle);
    ++start;
  }
  return {std::move(points), triangles};
}

void expect_same_mesh(const TriangleMesh& a, const TriangleMesh& b) {
  ASSERT_EQ(a.points(), b.points());
  ASSERT_EQ(a.face_count(), b.face_count());
  for (std::size_t f = 0; f < a.face_count(); ++f) {
    ASSERT_EQ(a.triangle(FaceId(f)), b.triangle(FaceId(f)));
    for (std::uint32_t i = 0; i < 3; ++i) {
      const HalfedgeId h = TriangleMesh::halfedge(FaceId(f), i);
      ASSERT_EQ(a.opposite(h), b.opposite(h));
    }
  }
}

const std::vector<std::pair<const Type*, std::string_view>>& samples() {
  static const std::vector<std::pair<const Type*, std::string_view>> list{
      {&TypeOf<std::int64_t>::type(), "-2147483648"},
      {&TypeOf<std::int64_t>::type(), "2147483648"},
      {&TypeOf<std::int64_t>::type(), "-9223372036854775808"},
      {&TypeOf<double>::type(), "0.1"},
      {&TypeOf<bool>::type(), "TRUE"},
      {&TypeOf<std::string>::type(), "\"gr\xC3\xBC\xC3\x9F\""},
      {&TypeOf<Text>::type(), "'many words, many words, many words, many words, many words, many words, many words'"},
      {&TypeOf<Bytes>::type(), "''"},
      {&TypeOf<Bytes>::type(),
       "'00ff0000000000000000000000000000000000000000000000000000000000000000000000000000000000001d'"},
      {&TypeOf<Point3d>::type(), "(1/3 2.5 -7)"},
      {&TypeOf<Vector3d>::type(), "(1 2 3)"},
      {&TypeOf<Plane3d>::type(), "(1 0 0 2)"},
      {&TypeOf<Plane3d>::type(), "((1/3 0 0) (1 1/7 1))"},
      {&TypeOf<Box3>::type(), "(0 1 0 2 -1e300 3)"},
      {&TypeOf<Points3d>::type(), "((0 0 0) (1/3 1 1) (2 2 2/7))"},
      {&TypeOf<Points3d>::type(), "()"},
      {&TypeOf<Surface3d>::type(), "()"},
      {&TypeOf<Surface3d>::type(), "(((0 0 0) (1 0 0) (0 1 0)))"},
      {&TypeOf<Surface3d>::type(), "(((0 0 0) (1 0 0) (0 1/3 0)) ((5 5 5) (6 5 5) (5 6 7)))"},
      {&TypeOf<Volume3d>::type(), TypeOf<Volume3d>::type().example()},
      {&TypeOf<Mesh3d>::type(), TypeOf<Mesh3d>::type().example()},
      {&TypeOf<Mesh3d>::type(), "(() ())"},
      {&TypeOf<Mesh3d>::type(), "(((0 0 0) (1/3 1 1)) ())"},
      {&TypeOf<Mesh3d>::type(),
       "(((0 0 0) (1 0 0) (1 1/7 0) (0 1 2) (9 9 9)) ((3 2 1 0) (0 1 2) (0 0 4) (0 3 1) (0 1 2 3 2)))"},
      {&TypeOf<Mesh3d>::type(),
       "(((0 0 0) (1 0 0) (0 1 0)) ((0 1 2)) ((vertex \"W\" real (1 undefined 2)) (face \"M\" text ('a'))))"},
      {&TypeOf<Instant>::type(), R"("2011-07-08-14:00:00.001")"},
      {&TypeOf<Duration>::type(), "(-3 5)"},
      {&TypeOf<TimeInterval>::type(), "(-1 2.5 FALSE TRUE)"},
      {&TypeOf<RegionUnit>::type(), "((0 1 TRUE FALSE) ((((0 0 1/3 0) (4 0 6 0) (4 4 6 9)))))"},
      {&TypeOf<MovingRegion>::type(), TypeOf<MovingRegion>::type().example()},
      {&TypeOf<MovingRegion>::type(), "()"},
      {nested("(tuple ((A int) (S string)))"), R"(((1 "a") (undefined "b") (3 undefined) (1 "a")))"},
      {nested("(tuple ((A int)))"), "()"},
      {nested("(tuple ((V volume3d) (R (arel (tuple ((P point3d) (B bool)))))))"),
       "(((((0 0 0) (0 1 0) (1 0 0)) ((0 0 0) (1 0 0) (0 0 1)) ((0 0 0) (0 0 1) (0 1 0)) ((1 0 0) (0 1 0) (0 0 1))) "
       "(((1/3 0 1) TRUE) (undefined FALSE))) (undefined ()) (() undefined))"},
  };
  return list;
}

TEST(codec, every_type_comes_back_equal_from_either_origin) {
  for (const auto& [type, text] : samples()) {
    const Value value = read(*type, text);
    ASSERT_TRUE(value.is_defined()) << text;
    const std::string bytes = encode(value);
    EXPECT_EQ(bytes, encode(value));
    for (const Origin origin : {Origin::own_store, Origin::elsewhere}) {
      const auto decoded = decode(*type, bytes, origin);
      ASSERT_TRUE(decoded.ok()) << text << ": " << decoded.error().text();
      EXPECT_EQ(compare(*decoded, value), std::strong_ordering::equal);
      EXPECT_EQ(decoded->to_nested(), value.to_nested());
      EXPECT_EQ(encode(*decoded), bytes);
    }
  }
}

TEST(codec, undefined_comes_back_undefined) {
  for (const Type* type : all_types()) {
    const auto decoded = decode(*type, encode(Value(*type)), Origin::elsewhere);
    ASSERT_TRUE(decoded.ok()) << decoded.error().text();
    EXPECT_FALSE(decoded->is_defined());
    EXPECT_EQ(&decoded->type(), type);
  }
}

TEST(codec, the_first_bytes_tell_box_and_size) {
  for (const auto& [type, text] : samples()) {
    if (!type->has_header()) continue;
    const Value value = read(*type, text);
    const auto header = decode_header(std::string_view(encode(value)).substr(0, kCodecHeaderBytes));
    ASSERT_TRUE(header.ok());
    EXPECT_EQ(header->box, value.header().box);
    EXPECT_EQ(header->size, value.header().size);
  }
  EXPECT_FALSE(decode_header(std::string(95, '\0')).ok());
  EXPECT_FALSE(decode_header(std::string(96, '\0')).ok());
}

TEST(codec, the_same_mesh_comes_back_index_by_index) {
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    const std::size_t point_count = 1 + random() % 400;
    const TriangleMesh mesh = random_mesh(random, point_count, random() % 600, round % 3 == 0);
    const Value value = Value::of(Volume3d::trusted(mesh));
    const auto decoded = decode(value.type(), encode(value), Origin::own_store);
    ASSERT_TRUE(decoded.ok()) << decoded.error().text();
    expect_same_mesh(decoded->get<Volume3d>().mesh(), mesh);
  }
}

TEST(codec, isolated_points_and_points_out_of_order_are_kept) {
  const TriangleMesh mesh(PointArray(std::vector<Vec3>{{5, 5, 5}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {9, 9, 9}}),
                          std::vector<Triangle>{{3, 1, 2}, {2, 1, 3}});
  const Value value = Value::of(Surface3d::trusted(mesh));
  const auto decoded = decode(value.type(), encode(value), Origin::own_store);
  ASSERT_TRUE(decoded.ok()) << decoded.error().text();
  expect_same_mesh(decoded->get<Surface3d>().mesh(), mesh);
}

TEST(codec, extreme_doubles_and_long_rationals_are_kept) {
  using Limits = std::numeric_limits<double>;
  Rational power(1);
  for (int i = 0; i < 2000; ++i) power *= Rational(1'000'000'007);
  const Rational small = Rational(1) / (power + Rational(1));
  const Rational near_one = power / (power + Rational(1));
  PointArray points;
  points.push_back(Vec3{Limits::max(), Limits::lowest(), Limits::denorm_min()});
  points.push_back(Vec3{-Limits::denorm_min(), Limits::min(), 0.0});
  points.push_back(ExactPoint(RationalVec3(-near_one, near_one, small)));
  std::string bytes;
  ByteWriter writer(bytes);
  write_points(writer, points);
  ByteReader reader(bytes, "points");
  const PointArray again = read_points(reader);
  ASSERT_TRUE(reader.finish().ok()) << reader.status().error().text();
  EXPECT_EQ(again, points);
}

TEST(codec, content_that_compresses_without_end_keeps_its_ratio) {
  const Value value = Value::of(Text{std::string(10'000'000, 'a')});
  const std::string bytes = encode(value);
  EXPECT_GE(bytes.size(), 10'000'000U / 1024);
  EXPECT_LT(bytes.size(), 10'000'000U / 1024 + 1000);
  const auto decoded = decode(value.type(), bytes, Origin::elsewhere);
  ASSERT_TRUE(decoded.ok()) << decoded.error().text();
  EXPECT_EQ(compare(*decoded, value), std::strong_ordering::equal);
}

std::string read_file(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  return content.str();
}

/// The bytes of the page's dump: "offset  bytes  | comment" between the fences. Offsets are checked.
std::string bytes_of_dump() {
  std::istringstream page(read_file(ALGEBRA3D_SOURCE "/docs/file_format.md"));
  std::string bytes;
  std::string line;
  bool inside = false;
  while (std::getline(page, line)) {
    if (line.starts_with("```")) inside = line == "```dump";
    if (!inside || line.starts_with("```")) continue;
    EXPECT_EQ(std::stoul(line.substr(0, 4), nullptr, 16), bytes.size()) << line;
    std::istringstream columns(line.substr(4, line.find('|') - 4));
    for (std::string byte; columns >> byte;) bytes.push_back(static_cast<char>(std::stoi(byte, nullptr, 16)));
  }
  return bytes;
}

TEST(codec, the_dump_of_the_page_is_the_value_it_says) {
  const std::string bytes = bytes_of_dump();
  ASSERT_EQ(bytes.size(), 153U);
  const auto decoded = decode(TypeOf<Surface3d>::type(), bytes, Origin::elsewhere);
  ASSERT_TRUE(decoded.ok()) << decoded.error().text();
  EXPECT_EQ(decoded->to_nested().print(), "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)))");
  EXPECT_EQ(encode(*decoded), bytes);
}

TEST(codec, a_changed_bit_is_always_noticed) {
  for (const auto& [type, text] : samples()) {
    const std::string bytes = encode(read(*type, text));
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      std::string damaged = bytes;
      damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
      const auto decoded = decode(*type, damaged, Origin::own_store);
      ASSERT_FALSE(decoded.ok()) << text << " bit " << bit;
      ASSERT_TRUE(decoded.error().code == ErrorCode::database_corrupt ||
                  decoded.error().code == ErrorCode::database_version);
    }
  }
}

TEST(codec, a_cut_or_lengthened_value_is_always_noticed) {
  for (const auto& [type, text] : samples()) {
    const std::string bytes = encode(read(*type, text));
    for (std::size_t length = 0; length < bytes.size(); ++length)
      ASSERT_FALSE(decode(*type, std::string_view(bytes).substr(0, length), Origin::own_store).ok());
    EXPECT_FALSE(decode(*type, bytes + '\0', Origin::own_store).ok());
  }
}

TEST(codec, damaged_bodies_never_crash_and_cut_ones_are_errors) {
  std::mt19937 random(4);
  const Type& type = TypeOf<Volume3d>::type();
  for (int round = 0; round < 6; ++round) {
    const TriangleMesh mesh = random_mesh(random, 12, 30, round % 2 == 0);
    std::string body;
    type.encode(Value::of(Volume3d::trusted(mesh)), body);
    for (std::size_t length = 0; length < body.size(); ++length)
      ASSERT_FALSE(type.decode(std::string_view(body).substr(0, length), true).ok()) << length;
    for (std::size_t bit = 0; bit < 8 * body.size(); ++bit) {
      std::string damaged = body;
      damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
      const auto decoded = type.decode(damaged, true);
      if (decoded.ok()) {
        EXPECT_EQ(compare(*decoded, *decoded), std::strong_ordering::equal);
      } else {
        EXPECT_TRUE(decoded.error().text().starts_with("volume3d: byte ")) << decoded.error().text();
      }
    }
  }
}

TEST(codec, damaged_nested_relations_never_crash) {
  std::mt19937 random(5);
  for (const auto& [type, text] : samples()) {
    if (as_nested_relation(*type) == nullptr) continue;
    std::string body;
    type->encode(read(*type, text), body);
    for (std::size_t length = 0; length < body.size(); ++length)
      ASSERT_FALSE(type->decode(std::string_view(body).substr(0, length), true).ok()) << length;
    for (std::size_t round = 0; round < 8 * body.size() + 20'000; ++round) {
      std::string damaged = body;
      if (round < 8 * body.size())
        damaged[round / 8] = static_cast<char>(damaged[round / 8] ^ (1 << (round % 8)));
      else
        for (std::size_t i = random() % 4; i < 4; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
      for (const bool is_trusted : {true, false}) {
        const auto decoded = type->decode(damaged, is_trusted);
        if (decoded.ok())
          EXPECT_EQ(compare(*decoded, *decoded), std::strong_ordering::equal);
        else
          EXPECT_EQ(decoded.error().code, ErrorCode::database_corrupt) << decoded.error().text();
      }
    }
  }
}

TEST(codec, nested_relations_name_the_tuple_and_attribute_that_is_damaged) {
  const Type& type = *nested("(tuple ((A bool) (B bool)))");
  const auto message = [&](std::string_view body) {
    const auto decoded = type.decode(body, true);
    return decoded.ok() ? std::string("no error") : decoded.error().text();
  };
  using namespace std::string_view_literals;
  EXPECT_EQ(message("\1\0\0"sv), "no error");
  EXPECT_EQ(message("\1\0\2"sv), "arel: byte 3 of the body: expected 0 or 1 for a value that is undefined or defined");
  EXPECT_EQ(message("\1\0\1\1\5"sv), "arel: tuple 1, attribute B: bool: byte 1 of the body: expected 0 or 1");
  EXPECT_TRUE(message("\xff\xff\xff\x7f\0"sv).starts_with("arel: byte ")) << message("\xff\xff\xff\x7f\0"sv);
  EXPECT_TRUE(message("\1\0\0\0"sv).starts_with("arel: byte ")) << message("\1\0\0\0"sv);
}

TEST(codec, a_solid_in_a_nested_relation_from_elsewhere_is_proved) {
  const Type& type = *nested("(tuple ((V volume3d)))");
  const TriangleMesh open(PointArray(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
                          std::vector<Triangle>{{0, 1, 2}});
  const Value relation = *as_nested_relation(type)->value_of({Value::of(Volume3d::trusted(open))});
  EXPECT_TRUE(decode(type, encode(relation), Origin::own_store).ok());
  const auto refused = decode(type, encode(relation), Origin::elsewhere);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::database_corrupt);
  EXPECT_TRUE(refused.error().text().starts_with("arel: tuple 1, attribute V: no valid solid: "))
      << refused.error().text();
}

TEST(codec, a_newer_version_is_refused_before_all_else) {
  std::string bytes = encode(read(TypeOf<double>::type(), "1.5"));
  bytes[4] = 2;
  const auto decoded = decode(TypeOf<double>::type(), bytes, Origin::own_store);
  ASSERT_FALSE(decoded.ok());
  EXPECT_EQ(decoded.error().code, ErrorCode::database_version);
  EXPECT_EQ(decoded.error().text(), "stored value: format version 2, this program reads versions up to 1");
}

TEST(codec, errors_name_the_byte_and_the_expectation) {
  const std::string bytes = encode(read(TypeOf<double>::type(), "1.5"));
  const auto message = [&](std::string changed, const Type& type = TypeOf<double>::type()) {
    const auto decoded = decode(type, changed, Origin::own_store);
    return decoded.ok() ? std::string("no error") : decoded.error().text();
  };
  const auto with = [&](std::size_t offset, char byte) {
    std::string changed = bytes;
    changed[offset] = byte;
    return changed;
  };
  EXPECT_EQ(message(with(0, 'x')), "stored value: byte 0: expected the bytes 89 41 33 44");
  EXPECT_EQ(message(with(6, 4)), "stored value: byte 6: expected known flags, found 4");
  EXPECT_EQ(message(bytes, TypeOf<bool>::type()), "stored value: byte 12: expected type bool, found real");
  EXPECT_EQ(message(bytes.substr(0, 50)), "stored value: byte 50: expected 96 bytes before the body, found the end");
  EXPECT_EQ(message(bytes + "!"), "stored value: byte 72: expected 9, the bytes after the frame, found 8");
  EXPECT_EQ(message(with(100, 1)), "stored value: byte 88: expected the checksum of these bytes; they were changed");
  EXPECT_EQ(message(with(87, 1)), "stored value: byte 80: expected 8, the stored bytes, found 72057594037927944");
}

TEST(codec, a_mesh_from_elsewhere_is_proved) {
  // An open surface that claims to be a solid.
  const TriangleMesh open(PointArray(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
                          std::vector<Triangle>{{0, 1, 2}});
  const std::string bytes = encode(Value::of(Volume3d::trusted(open)));
  EXPECT_TRUE(decode(TypeOf<Volume3d>::type(), bytes, Origin::own_store).ok());
  const auto decoded = decode(TypeOf<Volume3d>::type(), bytes, Origin::elsewhere);
  ASSERT_FALSE(decoded.ok());
  EXPECT_EQ(decoded.error().code, ErrorCode::database_corrupt);
  EXPECT_TRUE(decoded.error().text().starts_with("no valid solid: ")) << decoded.error().text();

  // Two points in one place would hide that triangles meet.
  const TriangleMesh doubled(PointArray(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}),
                             std::vector<Triangle>{{0, 1, 2}});
  const std::string twice = encode(Value::of(Surface3d::trusted(doubled)));
  const auto refused = decode(TypeOf<Surface3d>::type(), twice, Origin::elsewhere);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().text(), "surface3d: expected points that differ from each other");
}

TEST(codec, a_large_regular_mesh_takes_few_bytes) {
  // A grid of float coordinates: 2 * 100 * 100 triangles. The limit is a tenth of what PostGIS stores.
  constexpr std::uint32_t kSide = 100;
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i <= kSide; ++i)
    for (std::uint32_t j = 0; j <= kSide; ++j)
      points.push_back({static_cast<float>(i) * 0.1F, static_cast<float>(j) * 0.1F, static_cast<float>(i * j) * 0.01F});
  for (std::uint32_t i = 0; i < kSide; ++i)
    for (std::uint32_t j = 0; j < kSide; ++j) {
      const std::uint32_t p = i * (kSide + 1) + j;
      triangles.push_back({p, p + kSide + 1, p + 1});
      triangles.push_back({p + 1, p + kSide + 1, p + kSide + 2});
    }
  const TriangleMesh mesh(PointArray(std::move(points)), triangles);
  EXPECT_LT(encode(Value::of(Surface3d::trusted(mesh))).size(), 2 * kSide * kSide * 16 / 10);
}

TEST(binary_io, varints_and_planes_come_back) {
  const std::vector<std::uint64_t> values{0, 1, 127, 128, 300, 0xFFFFFFFF, std::uint64_t{1} << 56, ~std::uint64_t{0}};
  std::string bytes;
  ByteWriter writer(bytes);
  for (const std::uint64_t value : values) writer.varint(value);
  writer.planes(values);
  writer.f64(-0.0);
  ByteReader reader(bytes, "test");
  for (const std::uint64_t value : values) EXPECT_EQ(reader.varint(), value);
  EXPECT_EQ(reader.planes(values.size(), 0, 8), values);
  EXPECT_TRUE(std::signbit(reader.f64()));
  EXPECT_TRUE(reader.finish().ok());
  for (const std::int64_t value : {std::int64_t{0}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::min(),
                                   std::numeric_limits<std::int64_t>::max()})
    EXPECT_EQ(unzigzag(zigzag(value)), value);
}

TEST(binary_io, counts_beyond_the_bytes_are_refused) {
  std::string bytes;
  ByteWriter writer(bytes);
  writer.varint(std::uint64_t{1} << 60);
  bytes += "abc";
  ByteReader reader(bytes, "test");
  EXPECT_EQ(reader.count(1), 0U);
  EXPECT_EQ(reader.status().error().text(),
            "test: byte 9 of the body: expected a count of at most 3, found 1152921504606846976");
  ByteReader overlong("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x02", "test");
  EXPECT_EQ(overlong.varint(), 0U);
  EXPECT_FALSE(overlong.ok());
}

}  // namespace
}  // namespace algebra3d
