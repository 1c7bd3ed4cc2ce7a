#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "stl/stl_reader.h"
#include "unit/stl/stl_bytes.h"

namespace {

using algebra3d::ErrorCode;
using algebra3d::Vec3;
using mesh_formats::read_stl;
using stl_bytes::facet;
using stl_bytes::facets;
using stl_bytes::Floats;
using stl_bytes::header;
using stl_bytes::kCorner;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct AcceptedBytes {
  std::string label;
  std::string bytes;
  std::size_t triangle_count;
  std::string name;
  std::vector<std::string> remarks;
};

std::vector<AcceptedBytes> accepted_files() {
  Floats nan_normal = kCorner;
  nan_normal[1] = kNan;
  return {
      {"plain", header("part", 2) + facets(2), 2, "part", {}},
      {"no facets", header("part", 0), 0, "part", {}},
      {"header of zeros", header("", 1) + facets(1), 1, "", {}},
      {"solid header", header("solid part", 1) + facets(1), 1, "part", {}},
      {"solid header filled with blanks",
       header("solid a part" + std::string(68, ' '), 1) + facets(1),
       1,
       "a part",
       {}},
      {"solid header after a blank", header(" SOLID PRO2STL", 1) + facets(1), 1, "PRO2STL", {}},
      {"header that begins like solid", header("solidworks", 1) + facets(1), 1, "solidworks", {}},
      {"header with keywords", header("solid facet vertex endsolid", 1) + facets(1), 1, "facet vertex endsolid", {}},
      {"attribute bytes",
       header("", 3) + facet(kCorner, 1) + facet() + facet(kCorner, 0x8000),
       3,
       "",
       {"2 facets carry attribute bytes, which are ignored"}},
      {"one attribute",
       header("", 1) + facet(kCorner, 7),
       1,
       "",
       {"1 facet carries attribute bytes, which are ignored"}},
      {"trailing byte",
       header("solid x", 2) + facets(2) + "\n",
       2,
       "x",
       {"1 trailing byte after the last facet ignored"}},
      {"many trailing bytes",
       header("", 1) + facets(1) + std::string(60, 'z'),
       1,
       "",
       {"60 trailing bytes after the last facet ignored"}},
      {"trailing bytes and no facet", header("", 0) + "abc", 0, "", {"3 trailing bytes after the last facet ignored"}},
      {"count zero",
       header("", 0) + facets(2),
       2,
       "",
       {"header announces 0 triangles, file has 2: all in the file are read"}},
      {"count minus one",
       header("", 0xffffffffU) + facets(1),
       1,
       "",
       {"header announces 4294967295 triangles, file has 1: all in the file are read"}},
      {"count minus one under a solid header",
       header("solid x", 0xffffffffU) + facets(30),
       30,
       "x",
       {"header announces 4294967295 triangles, file has 30: all in the file are read"}},
      {"count too small",
       header("", 1) + facets(3),
       3,
       "",
       {"header announces 1 triangle, file has 3: all in the file are read"}},
      {"count too great",
       header("", 5) + facets(3),
       3,
       "",
       {"header announces 5 triangles, file has 3: all in the file are read"}},
      {"nan normal",
       header("", 2) + facet(nan_normal) + facet(),
       2,
       "",
       {"1 facet has a normal that is not finite, read as zero"}},
  };
}

TEST(StlBinaryReader, accepts_what_programs_write_and_says_what_it_tolerated) {
  for (const AcceptedBytes& file : accepted_files()) {
    SCOPED_TRACE(file.label);
    const auto read = read_stl(file.bytes, "a.stl");
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->format, mesh_formats::Encoding::binary);
    EXPECT_EQ(read->soup.triangles.size(), file.triangle_count);
    EXPECT_EQ(read->soup.normals.size(), file.triangle_count);
    EXPECT_EQ(read->soup.name, file.name);
    EXPECT_EQ(read->solid_count, 1U);
    EXPECT_EQ(read->remarks, file.remarks);
  }
}

struct RefusedBytes {
  std::string bytes;
  std::string message;
};

std::string with_float(std::size_t index, float value) {
  Floats floats = kCorner;
  floats[index] = value;
  return header("", 2) + facet() + facet(floats);
}

TEST(StlBinaryReader, refuses_with_the_byte_and_the_expectation) {
  const std::vector<RefusedBytes> files = {
      {header("", 12) + std::string(516, '\0'),
       "a.stl: byte 84: header announces 12 triangles (684 bytes), file has 600 bytes"},
      {header("solid cube", 12) + std::string(516, '\0'),
       "a.stl: byte 84: header announces 12 triangles (684 bytes), file has 600 bytes"},
      {header("", 1), "a.stl: byte 84: header announces 1 triangle (134 bytes), file has 84 bytes"},
      {header("", 0xffffffffU) + "x",
       "a.stl: byte 84: header announces 4294967295 triangles (214748364834 bytes), file has 85 bytes"},
      {header("", 0) + facets(2) + "x",
       "a.stl: byte 80: header announces 0 triangles, but 101 bytes follow; expected none or a multiple of "
       "50"},
      {with_float(3, kNan), "a.stl: byte 146: facet 2, corner 1: x is nan; expected a finite number"},
      {with_float(7, kInfinity), "a.stl: byte 162: facet 2, corner 2: y is inf; expected a finite number"},
      {with_float(11, -kInfinity), "a.stl: byte 178: facet 2, corner 3: z is -inf; expected a finite number"},
      {std::string(40, '\0'),
       "a.stl: byte 40: file ends; expected 'solid', or the 84 bytes before the facets of a binary file"},
      {"", "a.stl: empty file; expected an STL file"},
      {" \r\n\t ", "a.stl: empty file; expected an STL file"},
  };
  for (const RefusedBytes& file : files) {
    const auto read = read_stl(file.bytes, "a.stl");
    ASSERT_FALSE(read) << file.message;
    EXPECT_EQ(read.error().text(), file.message);
    EXPECT_EQ(read.error().code, ErrorCode::file_format);
  }
}

TEST(StlBinaryReader, coordinates_and_normals_keep_value_and_order) {
  const Floats floats = {2, 0, 0, 0.1F, -0.0F, 1e-45F, 3.4028235e38F, -3.4028235e38F, 1.17549435e-38F, 5, 6, 7};
  const auto read = read_stl(header("", 1) + facet(floats), "a.stl");
  ASSERT_TRUE(read);
  const auto& corners = read->soup.triangles.at(0);
  EXPECT_EQ(read->soup.normals.at(0), (Vec3{2, 0, 0}));
  EXPECT_EQ(corners[0], (Vec3{0x1.99999ap-4, 0, 0x1p-149}));
  EXPECT_TRUE(std::signbit(corners[0].y));
  EXPECT_EQ(corners[1], (Vec3{0x1.fffffep127, -0x1.fffffep127, 0x1p-126}));
  EXPECT_EQ(corners[2], (Vec3{5, 6, 7}));
}

TEST(StlBinaryReader, nan_normals_become_zero_without_touching_others) {
  Floats floats = kCorner;
  floats[0] = kInfinity;
  const auto read = read_stl(header("", 3) + facet() + facet(floats) + facet(), "a.stl");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->soup.normals, (std::vector<Vec3>{{0, 0, 1}, {0, 0, 0}, {0, 0, 1}}));
}

// More facets than one block holds, the wrong one far behind.
TEST(StlBinaryReader, large_files_are_read_and_their_errors_located) {
  constexpr std::uint32_t count = 10'000;
  std::string bytes = header("", count);
  for (std::uint32_t i = 0; i < count; ++i) {
    Floats floats = kCorner;
    floats[3] = static_cast<float>(i);
    bytes += facet(floats, i % 2);
  }
  const auto read = read_stl(bytes, "a.stl");
  ASSERT_TRUE(read);
  ASSERT_EQ(read->soup.triangles.size(), count);
  for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(read->soup.triangles[i][0].x, i);
  EXPECT_EQ(read->remarks, std::vector<std::string>{"5000 facets carry attribute bytes, which are ignored"});

  const std::string wrong = facet({0, 0, 1, 0, kNan, 0, 1, 0, 0, 0, 1, 0});
  bytes.replace(84 + 50 * 9'000, 50, wrong);
  const auto refused = read_stl(bytes, "a.stl");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().text(), "a.stl: byte 450100: facet 9001, corner 1: y is nan; expected a finite number");
}

TEST(StlBinaryReader, every_truncation_is_an_error_or_has_a_remark) {
  for (const char* text : {"part", "solid part"}) {
    const std::string whole = header(text, 3) + facets(3);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const std::string bytes = whole.substr(0, size);
      const auto read = read_stl(bytes, "a.stl");
      EXPECT_TRUE(!read || !read->remarks.empty()) << size;
      EXPECT_EQ(read.ok(), size == 134 || size == 184) << size;
    }
  }
}

TEST(StlBinaryReader, stops_when_cancelled) {
  const std::atomic<bool> cancel = true;
  const auto read = read_stl(header("", 1) + facets(1), "a.stl", &cancel);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::interrupted);
  EXPECT_EQ(read.error().text(), "a.stl: interrupted");
}

/// A file whose numbers have their bytes in the reverse order.
std::string big_endian(std::string bytes) {
  const auto reverse_at = [&](std::size_t at) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.begin() + static_cast<std::ptrdiff_t>(at + 4));
  };
  reverse_at(80);
  for (std::size_t facet = 84; facet < bytes.size(); facet += 50)
    for (std::size_t number = 0; number < 12; ++number) reverse_at(facet + 4 * number);
  return bytes;
}

TEST(StlBinaryReader, big_endian_files_are_known_by_their_count) {
  for (const std::size_t count : {1U, 2U, 300U, 5000U}) {
    const std::string little = header("part", static_cast<std::uint32_t>(count)) + facets(count);
    const auto read = read_stl(big_endian(little), "a.stl");
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(read->soup.triangles, read_stl(little, "a.stl")->soup.triangles);
    EXPECT_EQ(read->soup.normals, read_stl(little, "a.stl")->soup.normals);
    EXPECT_EQ(read->remarks, std::vector<std::string>{"the numbers are big-endian; they are read as that"});
    EXPECT_FALSE(read->wrong_count);
  }
  // A count that reads the same both ways, and one that fits neither way.
  EXPECT_TRUE(read_stl(header("part", 0) + "", "a.stl")->remarks.empty());
  EXPECT_TRUE(read_stl(big_endian(header("part", 3) + facets(2)), "a.stl")->wrong_count);
}

}  // namespace
