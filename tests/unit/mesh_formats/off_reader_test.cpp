#include <atomic>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mesh_formats/off/off_reader.h"
#include "support/scratch_folder.h"
#include "unit/mesh_formats/off_bytes.h"
#include "unit/mesh_formats/polygon_faces.h"
#include "unit/stl/stl_bytes.h"

namespace {

using algebra3d::ErrorCode;
using algebra3d::Vec3;
using mesh_formats::read_off;
using off_bytes::floats;
using off_bytes::Order;
using off_bytes::words;
using stl_bytes::replaced;

const std::vector<Vec3> kOffPoints = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
const Faces kOffFaces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
const std::string kOffVertexLines = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kOffFaceLines = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string kOffLines = kOffVertexLines + kOffFaceLines;
const std::string kOffTetrahedron = "OFF\n4 4 6\n" + kOffLines;

struct AcceptedOff {
  std::string label;
  std::string bytes;
  std::vector<std::string> remarks = {};
  Faces faces = kOffFaces;
  std::vector<Vec3> points = kOffPoints;
};

std::vector<AcceptedOff> off_layouts() {
  return {
      {"plain", kOffTetrahedron},
      {"carriage return and line feed", replaced(kOffTetrahedron, "\n", "\r\n")},
      {"carriage return", replaced(kOffTetrahedron, "\n", "\r")},
      {"no end of the last line", kOffTetrahedron.substr(0, kOffTetrahedron.size() - 1)},
      {"byte order mark", "\xef\xbb\xbf" + kOffTetrahedron},
      {"byte order mark before counts",
       "\xef\xbb\xbf"
       "4 4 6\n" +
           kOffLines},
      {"blanks and empty lines", "\n\t " + replaced(replaced(kOffTetrahedron, " ", "\t  "), "\n", " \n\n\t")},
      {"comments", "# first OFF 1\n#\n" + replaced(kOffTetrahedron, "\n", " # 7 7\n# 8\n") + "# last"},
      {"every number on a line of its own", replaced(kOffTetrahedron, " ", "\n")},
      {"counts in the line of the keyword", "OFF 4 4 6\n" + kOffLines},
      {"counts right behind the keyword", "OFF4 4 6\n" + kOffLines},
      {"comment right behind the keyword", "OFF# 1 2 3\n4 4 6#x\n" + kOffLines},
      {"keyword in small letters", replaced(kOffTetrahedron, "OFF", "off")},
      {"all in one line", replaced(kOffTetrahedron, "\n", " ")},
      {"vertices in one line, faces in another",
       "OFF\n4 4 6\n" + replaced(kOffVertexLines, "\n", " ") + "\n" + replaced(kOffFaceLines, "\n", " ")},
      {"counts and vertices in one line, coloured faces",
       "OFF 4 4 6 " + replaced(kOffVertexLines, "\n", " ") + "\n" + replaced(kOffFaceLines, "\n", " 255 0 9\n"),
       {"4 face colours ignored"}},
      {"colours of vertices in one line",
       "COFF 4 4 6 0 0 0 1 1 1 1 1 0 0 1 1 1 1 0 1 0 1 1 1 1 0 0 1 1 1 1 1 " + replaced(kOffFaceLines, "\n", " "),
       {}},
      {"no keyword", "4 4 6\n" + kOffLines},
      {"no keyword and comments", "# a\n 4 4 6\n" + kOffLines},
      {"no number of edges", "OFF\n4 4\n" + kOffLines},
      {"no number of edges, no keyword, comment", "4 4 # vertices faces\n\n" + kOffLines},
      {"number of edges in the next line", "OFF\n4\n4\n6\n" + kOffLines},
      {"number of edges below a comment", "OFF\n4 4\n# edges:\n6 # six\n" + kOffLines},
      {"wrong number of edges", "OFF\n4 4 -1\n" + kOffLines},
      {"vertices in the line of the counts", "OFF 4 4 6 " + kOffLines},
      {"long zeros", "OFF\n0000000000000000000000000004 4 6\n" + kOffLines},
      {"faces of any degree",
       "OFF\n4 2 0\n" + kOffVertexLines + "4 0 1 2 3\n6 3 2 1 0 0 1\n",
       {},
       {{0, 1, 2, 3}, {3, 2, 1, 0, 0, 1}}},
      {"nothing", "OFF\n0 0 0\n", {}, {}, {}},
  };
}

std::vector<AcceptedOff> off_attributes() {
  const auto vertices = [](const std::string& attributes) {
    return replaced(kOffVertexLines, "\n", " " + attributes + "\n");
  };
  return {
      {"COFF with reals", "COFF\n4 4 6\n" + vertices("0.1 .2 3e-1 1") + kOffFaceLines, {"4 vertex colours ignored"}},
      {"COFF with three integers",
       "COFF\n4 4 6\n" + vertices("255 0 128") + kOffFaceLines,
       {"4 vertex colours ignored"}},
      {"COFF without colours", "COFF\n4 4 6\n" + kOffLines},
      {"NOFF", "NOFF\n4 4 6\n" + vertices("0 0 1") + kOffFaceLines, {"4 normals ignored"}},
      {"NOFF with normals below", "NOFF\n4 4 6\n" + vertices("\n nan 0\n 1") + kOffFaceLines, {"4 normals ignored"}},
      {"STOFF", "STOFF\n4 4 6\n" + vertices("0.5 0.5") + kOffFaceLines, {"4 texture coordinates ignored"}},
      {"CNOFF",
       "CNOFF 4 4 6\n" + vertices("0 0 1 255 255 255 0") + kOffFaceLines,
       {"4 normals ignored", "4 vertex colours ignored"}},
      {"NCOFF",
       "NCOFF 4 4 6\n" + vertices("0 0 1 1 1 1") + kOffFaceLines,
       {"4 normals ignored", "4 vertex colours ignored"}},
      {"STNOFF",
       "STNOFF\n4 4 6\n" + vertices("0 0 1 .5 .5") + kOffFaceLines,
       {"4 normals ignored", "4 texture coordinates ignored"}},
      {"STCN4nOFF",
       "STCN4nOFF 3\n4 4 6\n" + vertices("1 0 0 1 .1 .2 .3 1 .5 .5") + kOffFaceLines,
       {"4 normals ignored", "4 vertex colours ignored", "4 texture coordinates ignored"}},
      {"4OFF with weights 1", "4OFF\n4 4 6\n" + vertices("1.0") + kOffFaceLines},
      {"nOFF in three dimensions", "nOFF\n3\n4 4 6\n" + kOffLines},
      {"numbers that the header does not announce",
       "OFF\n4 4 6\n0 0 0 9 9 9\n1 0 0\n0 1 0 1\n0 0 1\n" + kOffFaceLines,
       {"surplus numbers after 2 vertices ignored"}},
      {"colours of faces",
       "OFF\n4 4 6\n" + kOffVertexLines + "3 0 2 1 255 0 0\n3 0 1 3 .1 .2 .3 .4 # c\n3 1 2 3 7\n3 2 0 3\n",
       {"3 face colours ignored"}},
      {"small faces",
       "OFF\n4 6 0\n" + kOffVertexLines + "0\n1 0\n3 0 2 1\n2 0 1 1 0 0\n3 0 1 3\n2 3 1",
       {"1 face colour ignored", "4 faces with fewer than 3 corners ignored"},
       {{0, 2, 1}, {0, 1, 3}}},
      {"text behind the faces",
       kOffTetrahedron + "\n# comment\n3 0 1 2\n",
       {"text from line 13 after the last face ignored"}},
      {"padding", kOffTetrahedron + std::string("\x1a\0\0", 3), {"3 trailing bytes after the last face ignored"}},
  };
}

std::string binary_header(Order order, const std::string& line = "OFF BINARY\n") {
  return line + words(order, {4, 4, 6});
}

std::string binary_vertices(Order order, const std::vector<float>& attributes = {}) {
  std::string bytes;
  for (const std::vector<float>& point : {std::vector<float>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    bytes += floats(order, point) + floats(order, attributes);
  return bytes;
}

// `behind` follows each face: the number of colour floats, if any, and these.
std::string binary_faces(Order order, const std::string& behind) {
  std::string bytes;
  for (const std::vector<std::uint32_t>& face : kOffFaces) bytes += words(order, {3}) + words(order, face) + behind;
  return bytes;
}

std::vector<AcceptedOff> binary_layouts() {
  const std::string little = "numbers are little-endian; the format has them big-endian";
  const std::string no_count = "faces lack the number of their colour floats";
  const std::string zero = words(Order::big, {0});
  const std::string colour = words(Order::big, {3}) + floats(Order::big, {1, 0.5F, 0});
  const std::string plain = binary_header(Order::big) + binary_vertices(Order::big) + binary_faces(Order::big, zero);
  return {
      {"plain", plain},
      {"CRLF and blanks", replaced(plain, " BINARY\n", " \tBINARY \r\n")},
      {"comment before", "# c\n" + plain},
      {"colours",
       binary_header(Order::big) + binary_vertices(Order::big) + binary_faces(Order::big, colour),
       {"4 face colours ignored"}},
      {"no colour counts",
       binary_header(Order::big) + binary_vertices(Order::big) + binary_faces(Order::big, ""),
       {no_count}},
      {"little-endian",
       binary_header(Order::little) + binary_vertices(Order::little) +
           binary_faces(Order::little, words(Order::little, {0})),
       {little}},
      {"little-endian without colour counts, as pmp-library writes",
       binary_header(Order::little) + binary_vertices(Order::little) + binary_faces(Order::little, ""),
       {little, no_count}},
      {"attributes",
       binary_header(Order::big, "STCN4nOFF BINARY\n" + words(Order::big, {3})) +
           binary_vertices(Order::big, {1, 0, 0, 1, 0.5F, 0.5F, 0.5F, 1, 0, 1}) + binary_faces(Order::big, zero),
       {"4 normals ignored", "4 vertex colours ignored", "4 texture coordinates ignored"}},
      {"rest", plain + "12345", {"5 trailing bytes after the last face ignored"}},
      {"no faces", "OFF BINARY\n" + words(Order::big, {4, 0, 0}) + binary_vertices(Order::big), {}, {}},
      {"little-endian without faces",
       "OFF BINARY\n" + words(Order::little, {4, 0, 0}) + binary_vertices(Order::little),
       {little},
       {}},
      {"nothing", "OFF BINARY\n" + words(Order::big, {0, 0, 0}), {}, {}, {}},
      {"small faces",
       "OFF BINARY\n" + words(Order::big, {4, 3, 0}) + binary_vertices(Order::big) +
           words(Order::big, {0, 0, 2, 0, 1, 0, 3, 0, 1, 2, 0}),
       {"2 faces with fewer than 3 corners ignored"},
       {{0, 1, 2}}},
  };
}

TEST(OffReader, reads_what_the_format_allows) {
  for (const auto& table : {off_layouts(), off_attributes(), binary_layouts()}) {
    for (const AcceptedOff& file : table) {
      SCOPED_TRACE(file.label);
      const auto read = read_off(file.bytes, "a.off");
      ASSERT_TRUE(read) << read.error().text();
      EXPECT_EQ(read->soup.points, file.points);
      EXPECT_EQ(faces_of(read->soup), file.faces);
      EXPECT_EQ(read->soup.name, "");
      EXPECT_EQ(read->remarks, file.remarks);
    }
  }
}

TEST(OffReader, numbers_are_the_nearest_doubles) {
  const auto read = read_off("OFF 3 0 0\n+1.5 -2 .5\n5. -.5e1 1E+2\n0.1 1e-400 4.9e-324", "a.off");
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->soup.points,
            (std::vector<Vec3>{Vec3{1.5, -2, 0.5}, Vec3{5, -5, 100}, Vec3{0x1.999999999999ap-4, 0, 0x1p-1074}}));
}

// 65536 vertices and 131072 faces are 256 and 512 with their bytes turned round, which the file has room for too.
TEST(OffReader, byte_order_is_told_where_the_counts_allow_both) {
  for (const Order order : {Order::big, Order::little}) {
    std::string bytes = "OFF BINARY\n" + words(order, {65536, 131072, 0});
    for (std::uint32_t i = 0; i < 65536; ++i) bytes += floats(order, {static_cast<float>(i), 1, 2});
    for (std::uint32_t i = 0; i < 131072; ++i) bytes += words(order, {3, i % 65536, 1, 65535, 0});
    const auto read = read_off(bytes, "a.off");
    ASSERT_TRUE(read) << read.error().text();
    ASSERT_EQ(read->soup.points.size(), 65536U);
    ASSERT_EQ(read->soup.face_count(), 131072U);
    EXPECT_EQ(read->soup.points.back(), (Vec3{65535, 1, 2}));
    EXPECT_EQ(read->remarks.size(), order == Order::big ? 0U : 1U);
  }
}

struct RefusedOff {
  std::string bytes;
  std::string message;  // behind "a.off: "
};

std::vector<RefusedOff> refused_headers() {
  return {
      {"OF\n4 4 6\n", "byte 0, line 1: expected 'OFF' or the number of vertices, found 'OF'"},
      {"NNOFF 1 0 0\n", "byte 0, line 1: expected 'OFF' or the number of vertices, found 'NNOFF'"},
      {"OFFX 1 0 0\n", "byte 0, line 1: expected 'OFF' or the number of vertices, found 'OFFX'"},
      {"solid a\n", "byte 0, line 1: expected 'OFF' or the number of vertices, found 'solid'"},
      {std::string("# c\n\0\1", 6), R"(byte 4, line 2: expected 'OFF' or the number of vertices, found '\x00\x01')"},
      {"OFF", "byte 3, line 1: expected the number of vertices, found end of file"},
      {"OFF BINARY", "byte 4, line 1: expected the number of vertices, found 'BINARY'"},
      {"OFF\n-4 4 6\n", "byte 4, line 2: expected the number of vertices, found '-4'"},
      {"OFF\n4.0 4 6\n", "byte 4, line 2: expected the number of vertices, found '4.0'"},
      {"OFF\n4 x 6\n", "byte 6, line 2: expected the number of faces, found 'x'"},
      {"OFF\n4", "byte 5, line 2: expected the number of faces, found end of file"},
      {"OFF\n4 4 x\n", "byte 8, line 2: expected the number of edges, found 'x'"},
      {"nOFF\n4\n4 4 6\n", "byte 6, line 2: the dimension of the space is 4; expected 3"},
      {"nOFF\nx", "byte 5, line 2: expected the dimension of the space, found 'x'"},
  };
}

std::vector<RefusedOff> refused_lines() {
  const std::string counts = "OFF\n4 4 6\n";
  const std::string vertices = counts + kOffVertexLines;  // 10 and 24 bytes, 6 lines
  return {
      {counts + "0 0 0\n1 x 0", "byte 18, line 4: vertex 2 of 4: expected a number, found 'x'"},
      {counts + "0 0 0\n1 0", "byte 19, line 4: vertex 2 of 4: expected a number, found end of file"},
      {counts + "0 0 inf\n", "byte 14, line 3: vertex 1 of 4: z is 'inf'; expected a finite number"},
      {counts + "nan 0 0\n", "byte 10, line 3: vertex 1 of 4: x is 'nan'; expected a finite number"},
      {counts + "0 1e999 0\n",
       "byte 12, line 3: vertex 1 of 4: y is '1e999'; expected a number within the range of double"},
      {counts + "0 0 0 red\n", "byte 16, line 3: expected a number or the end of the line, found 'red'"},
      {counts + "0 0 0 1 2 3 4 5 6 7\n", "byte 28, line 3: expected the end of the line, found '7'"},
      {"4OFF\n1 0 0\n0 0 0 2\n", "byte 17, line 3: vertex 1 of 1: the weight is '2'; expected 1"},
      {"4OFF\n1 0 0\n0 0 0", "byte 16, line 3: vertex 1 of 1: expected a number, found end of file"},
      {"NOFF\n1 0 0\n0 0 0 0 0", "byte 20, line 3: vertex 1 of 1: expected a number, found end of file"},
      {vertices + "3 0 1 4\n", "byte 40, line 7: face 1 of 4, corner 3: the index is 4; expected 0 to 3"},
      {vertices + "3 0 1 2\n3 0 1 99999999999999999999\n",
       "byte 48, line 8: face 2 of 4, corner 3: the index is 999999999999999999; expected 0 to 3"},
      {"OFF 0 1 0\n3 0 0 0",
       "byte 12, line 2: face 1 of 1, corner 1: the index is 0; expected no face, since there is no vertex"},
      {vertices + "3 0 -1 2\n", "byte 38, line 7: face 1 of 4: expected the index of corner 2 of 3, found '-1'"},
      {vertices + "3 0 1.5 2\n", "byte 38, line 7: face 1 of 4: expected the index of corner 2 of 3, found '1.5'"},
      {vertices + "3 0 1", "byte 39, line 7: face 1 of 4: expected the index of corner 3 of 3, found end of file"},
      {vertices + "3 0 1 2\n", "byte 42, line 8: face 2 of 4: expected the number of its corners, found end of file"},
      {vertices + "-3 0 1 2\n", "byte 34, line 7: face 1 of 4: expected the number of its corners, found '-3'"},
      {vertices + "3 0 1 2 1 1 1 1 1\n", "byte 50, line 7: expected the end of the line, found '1'"},
      {vertices + "3 0 1 2 red\n", "byte 42, line 7: expected a number or the end of the line, found 'red'"},
      {"OFF\n1000000000 1000000000 0\n0 0 0\n",
       "byte 34, line 4: vertex 2 of 1000000000: expected a number, found end of file"},
  };
}

std::vector<RefusedOff> refused_binary() {
  const std::string head = binary_header(Order::big);               // 11 + 12 bytes
  const std::string vertices = head + binary_vertices(Order::big);  // and 48
  const float infinity = std::bit_cast<float>(0x7f800000U);
  const std::string one = "OFF BINARY\n" + words(Order::big, {1, 1, 0});
  const std::string origin = floats(Order::big, {0, 0, 0});
  return {
      {"OFF BINARY\n", "byte 11: the file ends; expected the numbers of vertices, faces and edges"},
      {"OFF BINARY\n" + words(Order::big, {1, 2}) + "abc",
       "byte 19: the file ends; expected the numbers of vertices, faces and edges"},
      {head, "byte 11: 4 vertices announced (48 bytes), but 0 bytes follow"},
      {vertices.substr(0, vertices.size() - 1), "byte 11: 4 vertices announced (48 bytes), but 44 bytes follow"},
      {vertices, "byte 15: 4 faces announced, but 0 bytes follow the vertices"},
      {vertices + words(Order::big, {3, 0, 1, 2, 0, 3, 0, 1, 4, 0}),
       "byte 103: face 2 of 4, corner 3: the index is 4; expected 0 to 3"},
      {vertices + words(Order::big, {3, 0, 1, 2, 0, 9, 0, 1}),
       "byte 91: face 2 of 4: 9 corners announced, but 8 bytes follow"},
      {vertices + words(Order::big, {3, 0, 1, 2, 0}),
       "byte 91: face 2 of 4: the file ends; expected the number of corners"},
      {one + floats(Order::big, {0, infinity, 0}) + words(Order::big, {3, 0, 0, 0, 0}),
       "byte 27: vertex 1 of 1: y is inf; expected a finite number"},
      {one + origin + words(Order::big, {3, 0, 0, 0, 5}),
       "byte 51: face 1 of 1: 5 colour floats announced; expected at most 4"},
      {one + origin + words(Order::big, {3, 0, 0, 0, 4, 1}),
       "byte 51: face 1 of 1: 4 colour floats announced, but 4 bytes follow"},
      {"4OFF BINARY\n" + words(Order::big, {1, 0, 0}) + floats(Order::big, {0, 0, 0, 2}),
       "byte 36: vertex 1 of 1: the weight is 2; expected 1"},
      {"nOFF BINARY\n" + words(Order::big, {4, 0, 0, 0}), "byte 12: the dimension of the space is 4; expected 3"},
  };
}

TEST(OffReader, refuses_what_is_wrong_with_its_place) {
  for (const auto& table : {refused_headers(), refused_lines(), refused_binary()}) {
    for (const RefusedOff& file : table) {
      const auto read = read_off(file.bytes, "a.off");
      ASSERT_FALSE(read) << file.message;
      EXPECT_EQ(read.error().text(), "a.off: " + file.message);
      EXPECT_EQ(read.error().code, ErrorCode::file_format);
    }
  }
}

// Numbers near the end of a file are read another way, so everything again where there is room behind it.
TEST(OffReader, refuses_the_same_before_a_long_rest) {
  const std::string rest = "\n" + std::string(200, '#') + "\n";
  for (const RefusedOff& file : refused_lines()) {
    if (file.message.ends_with("found end of file")) continue;
    const auto read = read_off(file.bytes + rest, "a.off");
    ASSERT_FALSE(read) << file.message;
    EXPECT_EQ(read.error().text(), "a.off: " + file.message);
  }
}

TEST(OffReader, an_empty_file_is_an_error) {
  for (const std::string& bytes : {std::string(), std::string(" \r\n\t"), std::string(100, '\0')}) {
    const auto read = read_off(bytes, "a.off");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().text(), "a.off: empty file; expected an OFF file");
  }
}

TEST(OffReader, more_vertices_than_indices_can_name_are_refused) {
  const auto read = read_off("OFF\n4294967296 1 0\n", "a.off");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::limit_exceeded);
  EXPECT_EQ(read.error().text(), "a.off: byte 16, line 2: 4294967296 vertices announced; expected at most 4294967295");
}

TEST(OffReader, every_truncation_is_an_error) {
  const std::string binary =
      binary_header(Order::big) + binary_vertices(Order::big) + binary_faces(Order::big, words(Order::big, {0}));
  for (const std::string& whole :
       {kOffTetrahedron, std::string("NOFF # c\r\n1 1 0\r\n0 0 0 0 0 1\r\n3 0 0 0 1 1 1"), binary}) {
    for (std::size_t size = 1; size < whole.size(); ++size) {
      // On the heap, so that the sanitizer sees a byte read beyond the end.
      const std::vector<char> bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      const auto read = read_off({bytes.data(), bytes.size()}, "a.off");
      if (read) {
        // Whole but for the end of the last line, a colour, or the last digit of an index.
        EXPECT_GE(size + 6, whole.size());
        continue;
      }
      EXPECT_TRUE(read.error().text().starts_with("a.off: byte ")) << read.error().text();
    }
  }
}

TEST(OffReader, stops_when_asked) {
  std::string text = "OFF\n70000 0 0\n";
  for (int i = 0; i < 70'000; ++i) text += "0 0 0\n";
  const std::string binary = "OFF BINARY\n" + words(Order::big, {70'000, 0, 0}) + std::string(70'000 * 12, '\0');
  const std::atomic<bool> cancel = true;
  for (const std::string& bytes : {text, binary}) {
    const auto read = read_off(bytes, "a.off", &cancel);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::interrupted);
    EXPECT_EQ(read.error().text(), "a.off: interrupted");
  }
}

TEST(OffReader, files_are_read_by_their_path) {
  const ScratchFolder folder;
  folder.write("a.off", kOffTetrahedron);
  const auto read = mesh_formats::read_off_file(folder.path("a.off"));
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(faces_of(read->soup), kOffFaces);
  const auto missing = mesh_formats::read_off_file(folder.path("b.off"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::file_missing);
  EXPECT_EQ(missing.error().text(), folder.path("b.off").string() + ": No such file or directory");
}

}  // namespace
