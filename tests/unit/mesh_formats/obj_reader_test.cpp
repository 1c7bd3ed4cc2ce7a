#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mesh_formats/obj/obj_reader.h"
#include "support/scratch_folder.h"
#include "unit/mesh_formats/polygon_faces.h"
#include "unit/stl/stl_bytes.h"

namespace {

using algebra3d::ErrorCode;
using algebra3d::Vec3;
using mesh_formats::read_obj;
using stl_bytes::replaced;

const std::vector<Vec3> kObjPoints = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
const std::string kObjVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string kObjTetrahedron = kObjVertices + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const Faces kObjTetrahedronFaces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

struct AcceptedObj {
  std::string label;
  std::string bytes;
  Faces faces = kObjTetrahedronFaces;
  std::string name = {};
  std::vector<std::string> remarks = {};
  std::vector<Vec3> points = kObjPoints;
};

std::vector<AcceptedObj> obj_layouts() {
  return {
      {"plain", kObjTetrahedron},
      {"carriage return and line feed", replaced(kObjTetrahedron, "\n", "\r\n")},
      {"carriage return", replaced(kObjTetrahedron, "\n", "\r")},
      {"mixed line ends", kObjVertices + "f 1 3 2\r\nf 1 2 4\rf 2 3 4\r\r\n\nf 3 1 4"},
      {"no end of the last line", kObjTetrahedron.substr(0, kObjTetrahedron.size() - 1)},
      {"byte order mark", "\xef\xbb\xbf" + kObjTetrahedron},
      {"blanks everywhere", "\n \n" + replaced(replaced(kObjTetrahedron, " ", " \t "), "\n", " \t\n\n\t ")},
      {"comments", "# f 9 9 9 \\\n" + replaced(kObjTetrahedron, "\n", " # and \\\n#more\n") + "#"},
      {"comments right behind numbers", replaced(kObjTetrahedron, "\n", "#c\n")},
      {"continued lines", replaced(kObjTetrahedron, " ", " \\\n")},
      {"continued lines that end in CRLF", replaced(kObjTetrahedron, " ", "\\\r\n ")},
      {"continued lines that end in CR", replaced(kObjTetrahedron, " ", "\\\r")},
      {"a backslash right behind numbers", replaced(kObjTetrahedron, "\n", "\\\n\n")},
      {"a backslash alone", "\\\n\\\r\n" + replaced(kObjTetrahedron, "\n", "\n\\\n") + "\\"},
      {"continued statements that are left out", "g a \\\nv 7 7 7 \\\r\n v 8 8 8\n" + kObjTetrahedron,
       kObjTetrahedronFaces, "a v 7 7 7  v 8 8 8"},
      {"faces before their vertices", "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n" + kObjVertices},
  };
}

std::vector<AcceptedObj> obj_corners() {
  return {
      {"v/vt/vn and the shorter ones",
       kObjVertices + "f 1/1/1 3/2/2 2/3/3\nf 1/1 2/2 4/3\nf 2//1 3//2 4//3\nf 3 1/7 4//9"},
      {"slashes at the end, as some programs write them", kObjVertices + "f 1/ 3// 2/1/\nf 1 2 4\nf 2 3 4\nf 3 1 4"},
      {"attributes that do not exist",
       kObjVertices + "f 1/0/0 3/-9/-9 2/+8/99999999999999999999\nf 1 2 4\nf 2 3 4\nf 3 1 4"},
      {"signs and leading zeros",
       kObjVertices + "f +1 +3 02\nf 01 2 000000000000000000000000000000004\nf 2 3 4\nf 3 1 4"},
      {"counted from the last vertex", kObjVertices + "f -4 -2 -3\nf -4/-1/-1 -3//-1 -1/-1\nf -3 -2 -1\nf 3 -4 4"},
      {"counted from the last vertex so far",
       "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -1 -2\nv 0 0 1\nf -4 -3 -1\nf 2 3 4\nf 3 1 4"},
      {"faces of any degree",
       kObjVertices + "f 1 2 3 4\nf 4 3 2 1 1 2\nfo 1 2 3\n",
       {{0, 1, 2, 3}, {3, 2, 1, 0, 0, 1}, {0, 1, 2}}},
      {"short faces",
       kObjVertices + "f 1 2 3\nf\nf 1\nf 1 2\nf 2 3 4",
       {{0, 1, 2}, {1, 2, 3}},
       "",
       {"3 faces with fewer than 3 corners ignored"}},
      {"one short face", kObjVertices + "f 1 2", {}, "", {"1 face with fewer than 3 corners ignored"}},
  };
}

std::vector<AcceptedObj> left_out_of_obj() {
  const std::string free_form = "vp 1 2\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\n";
  const std::string display = "mtllib a b.mtl\nusemtl x\ns off\nmg 1 2\nlod 3\nbevel on\n";
  return {
      {"names: the first object", "g early\no part one\no other\n" + kObjTetrahedron, kObjTetrahedronFaces, "part one"},
      {"names: the first group", "g  left \t right \ng b\n" + kObjTetrahedron, kObjTetrahedronFaces, "left \t right"},
      {"names: an object without one", "g a\no\n" + kObjTetrahedron, kObjTetrahedronFaces, ""},
      {"what says nothing about shapes", display + kObjTetrahedron},
      {"texture coordinates",
       "vt 0 0\nvt 1\nvt 1 1 1\n" + kObjTetrahedron,
       kObjTetrahedronFaces,
       "",
       {"3 texture coordinates ignored"}},
      {"normals", "vn 0 0 1\n" + kObjTetrahedron, kObjTetrahedronFaces, "", {"1 normal ignored"}},
      {"normals that are not numbers",
       "vn nan nan nan\nvn\n" + kObjTetrahedron,
       kObjTetrahedronFaces,
       "",
       {"2 normals ignored"}},
      {"lines and points",
       kObjTetrahedron + "l 1 2\nl 1/1 2/2 3/3\np 1 2 3 4\n",
       kObjTetrahedronFaces,
       "",
       {"2 line elements (l) ignored", "1 point element (p) ignored"}},
      {"curves and surfaces",
       free_form + kObjTetrahedron,
       kObjTetrahedronFaces,
       "",
       {"6 statements on curves and surfaces ignored"}},
      {"colours",
       "v 0 0 0 1 0 0\nv 1 0 0 0.5 .5 5e-1\nv 0 1 0 1 1 1 1\nv 0 0 1\nf 1 3 2",
       {{0, 2, 1}},
       "",
       {"3 colours ignored"}},
      {"weights",
       "v 0 0 0 1\nv 1 0 0 1.0\nv 0 1 0 2\nv 0 0 1 0\nf 1 3 2",
       {{0, 2, 1}},
       "",
       {"2 vertex weights other than 1 ignored"}},
      {"unknown keywords",
       kObjVertices + "foo 1 2 3\nf 1 2 3\nV 1 2 3\nbar",
       {{0, 1, 2}},
       "",
       {"3 statements with an unknown keyword, the first 'foo' in line 5, ignored"}},
      {"an unknown keyword",
       "vx\\\n" + kObjVertices + "f 1 2 3",
       {{0, 1, 2}},
       "",
       {"1 statement with an unknown keyword, the first 'vx\\' in line 1, ignored"},
       {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}},
      {"padding",
       kObjTetrahedron + std::string("\x1a\0\0\n", 4),
       kObjTetrahedronFaces,
       "",
       {"4 trailing bytes after the last statement ignored"}},
      {"nothing but vertices", kObjVertices, {}},
      {"nothing but a comment", "# nothing\n", {}, "", {}, {}},
  };
}

TEST(ObjReader, reads_what_the_format_allows) {
  for (const auto& table : {obj_layouts(), obj_corners(), left_out_of_obj()}) {
    for (const AcceptedObj& file : table) {
      SCOPED_TRACE(file.label);
      const auto read = read_obj(file.bytes, "a.obj");
      ASSERT_TRUE(read) << read.error().text();
      EXPECT_EQ(read->soup.points, file.points);
      EXPECT_EQ(faces_of(read->soup), file.faces);
      EXPECT_EQ(read->soup.name, file.name);
      EXPECT_EQ(read->remarks, file.remarks);
    }
  }
}

TEST(ObjReader, numbers_are_the_nearest_doubles) {
  const auto read = read_obj(
      "v +1.5 -2 .5\nv 5. -.5e1 1E+2\nv 0.1 1e-400 -0\nv 4.9e-324 123456789012345678901234567890 1e308", "a.obj");
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->soup.points,
            (std::vector<Vec3>{Vec3{1.5, -2, 0.5}, Vec3{5, -5, 100}, Vec3{0x1.999999999999ap-4, 0, 0},
                               Vec3{0x1p-1074, 0x1.8ee90ff6c373ep+96, 1e308}}));
}

struct RefusedObj {
  std::string bytes;
  std::string message;  // behind "a.obj: "
};

std::vector<RefusedObj> refused_obj_corners() {
  const std::string index = "; expected an index such as 1, 1/2, 1//3 or 1/2/3";
  const std::string zero = "; expected an index from 1, or below 0 counted from the last vertex";
  return {
      {kObjVertices + "f 1 2 0", "byte 38, line 5: face 1, corner 3 is '0'" + zero},
      {kObjVertices + "f 1 2 3\nf -0/1 2 3", "byte 42, line 6: face 2, corner 1 is '-0/1'" + zero},
      {kObjVertices + "f 1 2 5",
       "byte 38, line 5: face 1, corner 3 is '5'; expected 1 to 4, since 4 vertices stand in the file"},
      {"v 0 0 0\nf 1 2 1",
       "byte 12, line 2: face 1, corner 2 is '2'; expected 1 to 1, since 1 vertex stands in the file"},
      {"f 1 2 3", "byte 2, line 1: face 1, corner 1 is '1'; expected a vertex in the file"},
      {"f 1 2 3\r" + kObjVertices + "f 4 99/1/1\r\n",
       "byte 44, line 6: face 2, corner 2 is '99/1/1'; expected 1 to 4, since 4 vertices stand in the file"},
      {kObjVertices + "f 1 4294967296 2",
       "byte 36, line 5: face 1, corner 2 is '4294967296'; expected 1 to 4, since 4 vertices stand in the file"},
      {kObjVertices + "f -5 1 2",
       "byte 34, line 5: face 1, corner 1 is '-5'; expected -4 to -1, since 4 vertices stand before it"},
      {"v 0 0 0\nf -2 1 1\n" + kObjVertices,
       "byte 10, line 2: face 1, corner 1 is '-2'; expected -1 to -1, since 1 vertex stands before it"},
      {"f -1 1 1\n" + kObjVertices, "byte 2, line 1: face 1, corner 1 is '-1'; expected a vertex before it"},
      {kObjVertices + "f 1 2 99999999999999999999999999999",
       "byte 38, line 5: face 1, corner 3 is '999999999999999999999999...'; "
       "expected 1 to 4, since 4 vertices stand in the file"},
      {kObjVertices + "f 1 2.5 3", "byte 36, line 5: face 1, corner 2 is '2.5'" + index},
      {kObjVertices + "f 1 a 3", "byte 36, line 5: face 1, corner 2 is 'a'" + index},
      {kObjVertices + "f 1/1/1/1 2 3", "byte 34, line 5: face 1, corner 1 is '1/1/1/1'" + index},
      {kObjVertices + "f 1/x 2 3", "byte 34, line 5: face 1, corner 1 is '1/x'" + index},
      {kObjVertices + "f 1/-/1 2 3", "byte 34, line 5: face 1, corner 1 is '1/-/1'" + index},
      {kObjVertices + "f 1 2 --3", "byte 38, line 5: face 1, corner 3 is '--3'" + index},
      {kObjVertices + "f 1 2 -", "byte 38, line 5: face 1, corner 3 is '-'" + index},
      {kObjVertices + "f /1 2 3", "byte 34, line 5: face 1, corner 1 is '/1'" + index},
  };
}

std::vector<RefusedObj> refused_obj_vertices() {
  return {
      {"v 0 0", "byte 5, line 1: expected a number, found end of file"},
      {"v 0 0\nv 0 0 0", "byte 5, line 1: expected a number, found end of line"},
      {"v 0 0 #0\n", "byte 6, line 1: expected a number, found end of line"},
      {"v 0 0 x\n", "byte 6, line 1: expected a number, found 'x'"},
      {"v 0 1,5 0\n", "byte 4, line 1: expected a number, found '1,5' with a decimal comma"},
      {"v\n1 2 3", "byte 1, line 1: expected a number, found end of line"},
      {"v 0 0 0\n\nv 0 nan 0", "byte 13, line 3: vertex 2: y is 'nan'; expected a finite number"},
      {"v -inf 0 0", "byte 2, line 1: vertex 1: x is '-inf'; expected a finite number"},
      {"v 0 0 1.#QNAN", "byte 6, line 1: vertex 1: z is '1.#QNAN'; expected a finite number"},
      {"v 0 0 -1e309", "byte 6, line 1: vertex 1: z is '-1e309'; expected a number within the range of double"},
      {"v 0 0 0 1 2",
       "byte 11, line 1: vertex 1 has 5 numbers; expected 3, or with a weight 4, or with a colour 6 or 7"},
      {"v 0 0 0 1 2 3 4 5", "byte 16, line 1: expected the end of the line, found '5'"},
      {"v 0 0 0 red", "byte 8, line 1: expected a number or the end of the line, found 'red'"},
  };
}

std::vector<RefusedObj> refused_obj_files() {
  const std::string statement = "expected a statement of an OBJ file such as 'v' or 'f', found ";
  return {
      {kObjVertices + "1 2 3\n", "byte 32, line 5: " + statement + "'1'"},
      {kObjVertices + std::string("\0\0v 1 2 3", 9), "byte 32, line 5: " + statement + R"('\x00\x00v')"},
      {"\x89PNG\r\n\x1a\n", "byte 0, line 1: " + statement + R"('\x89PNG')"},
      {"Once upon a time\nthere was a text\n", "byte 0, line 1: " + statement + "'Once'"},
      {"\n ply\nformat ascii 1.0\n3 0 1 2", "byte 23, line 4: " + statement + "'3'"},
      {"solid part\nfacet normal 0 0 1\n", "byte 0, line 1: " + statement + "'solid'"},
  };
}

TEST(ObjReader, refuses_what_is_wrong_with_its_place) {
  for (const auto& table : {refused_obj_corners(), refused_obj_vertices(), refused_obj_files()}) {
    for (const RefusedObj& file : table) {
      const auto read = read_obj(file.bytes, "a.obj");
      ASSERT_FALSE(read) << file.message;
      EXPECT_EQ(read.error().text(), "a.obj: " + file.message);
      EXPECT_EQ(read.error().code, ErrorCode::file_format);
    }
  }
}

// Numbers near the end of a file are read another way, so everything again where there is room behind it.
TEST(ObjReader, refuses_the_same_before_a_long_rest) {
  const std::string rest = "\n" + std::string(200, '#') + "\n";
  for (const auto& table : {refused_obj_corners(), refused_obj_vertices()}) {
    for (const RefusedObj& file : table) {
      if (file.message.ends_with("found end of file")) continue;
      const auto read = read_obj(file.bytes + rest, "a.obj");
      ASSERT_FALSE(read) << file.message;
      EXPECT_EQ(read.error().text(), "a.obj: " + file.message);
    }
  }
}

TEST(ObjReader, an_empty_file_is_an_error) {
  for (const std::string& bytes : {std::string(), std::string(" \r\n\t"), std::string(100, '\0')}) {
    const auto read = read_obj(bytes, "a.obj");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().text(), "a.obj: empty file; expected an OBJ file");
  }
}

TEST(ObjReader, every_beginning_of_a_file_is_read_or_refused) {
  const std::string whole = "o a\nv 0 0 0 1 1 1\\\n\nvn 1 0 0\nf -1/1/1 1//1 1 # x\r\n";
  for (std::size_t size = 1; size <= whole.size(); ++size) {
    // On the heap, so that the sanitizer sees a byte read beyond the end.
    const std::vector<char> bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    for (const auto wanted : {mesh_formats::Wanted::shape, mesh_formats::Wanted::attributes}) {
      const auto read = read_obj({bytes.data(), bytes.size()}, "a.obj", nullptr, wanted);
      EXPECT_TRUE(read || read.error().text().starts_with("a.obj: byte ")) << size;
    }
  }
}

TEST(ObjReader, the_shape_is_the_same_with_attributes) {
  for (const AcceptedObj& accepted : obj_layouts()) {
    const auto read = read_obj(accepted.bytes, "a.obj", nullptr, mesh_formats::Wanted::attributes);
    ASSERT_TRUE(read) << accepted.label << ": " << read.error().text();
    EXPECT_EQ(read->soup.points, accepted.points) << accepted.label;
    EXPECT_EQ(faces_of(read->soup), accepted.faces) << accepted.label;
  }
}

TEST(ObjReader, attributes_are_those_of_corners_and_faces) {
  const std::string bytes = kObjVertices +
                            "mtllib a.mtl\nmtllib b c.mtl\nvt 0 \\\n 1#c\nvt 2 3 4\nvn 0 0 1 # up\ng a b\nusemtl m\nf "
                            "1/1/1 2/-1/-1 3//1\ng\nf 1 2\nf 1/3 2/2/ 3/-9\n"
                            "usemtl n\\\n  o\nmtllib d.mtl\nf 1 2 4\n";
  const auto read = read_obj(bytes, "a.obj", nullptr, mesh_formats::Wanted::attributes);
  ASSERT_TRUE(read) << read.error().text();
  constexpr std::uint32_t none = 0xFFFFFFFF;
  using Numbers = std::vector<std::uint32_t>;
  ASSERT_NE(read->soup.attributes, nullptr);
  const algebra3d::SoupAttributes& attributes = *read->soup.attributes;
  EXPECT_EQ(attributes.textures, (std::vector<std::array<double, 2>>{{0, 1}, {2, 3}}));
  EXPECT_EQ(attributes.normals, (std::vector<Vec3>{{0, 0, 1}}));
  EXPECT_EQ(attributes.corner_textures, (Numbers{0, 1, none, none, 1, none, none, none, none}));
  EXPECT_EQ(attributes.corner_normals, (Numbers{0, 0, 0, none, none, none, none, none, none}));
  EXPECT_EQ(attributes.groups.of_face, (Numbers{0, none, none}));
  EXPECT_EQ(attributes.groups.names[0], "a b");
  EXPECT_EQ(attributes.materials.of_face, (Numbers{0, 0, 1}));
  EXPECT_EQ(attributes.materials.names[1], "n  o");
  EXPECT_EQ(attributes.libraries.of_face, (Numbers{0, 0, 1}));
  EXPECT_EQ(attributes.libraries.names, (std::vector<std::string>{"a.mtl b c.mtl", "d.mtl"}));
  EXPECT_TRUE(attributes.objects.of_face.empty());
  EXPECT_EQ(read->remarks,
            (std::vector<std::string>{"1 face with fewer than 3 corners ignored",
                                      "2 references of corners to missing texture coordinates or normals ignored"}));
}

TEST(ObjReader, many_vertices_and_faces) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += "v " + std::to_string(i) + " 0.5 -1\n";
  for (int i = 1; i <= 99'998; ++i)
    text += "f " + std::to_string(i) + "/1 " + std::to_string(i + 1) + "/2 " + std::to_string(i + 2) + "/3\n";
  const auto read = read_obj(text, "a.obj");
  ASSERT_TRUE(read) << read.error().text();
  ASSERT_EQ(read->soup.points.size(), 100'000U);
  ASSERT_EQ(read->soup.face_count(), 99'998U);
  for (std::uint32_t i = 0; i < 99'998; ++i) {
    ASSERT_EQ(read->soup.points[i], (Vec3{static_cast<double>(i), 0.5, -1}));
    ASSERT_EQ(read->soup.corners[3 * i + 2], i + 2);
    ASSERT_EQ(read->soup.face_starts[i], 3 * i);
  }
}

TEST(ObjReader, stops_when_asked) {
  std::string text;
  for (int i = 0; i < 70'000; ++i) text += "v 0 0 0\n";
  const std::atomic<bool> cancel = true;
  const auto read = read_obj(text, "a.obj", &cancel);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::interrupted);
  EXPECT_EQ(read.error().text(), "a.obj: interrupted");
}

TEST(ObjReader, files_are_read_by_their_path) {
  const ScratchFolder folder;
  folder.write("a.obj", kObjTetrahedron);
  const auto read = mesh_formats::read_obj_file(folder.path("a.obj"));
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(faces_of(read->soup), kObjTetrahedronFaces);
  const auto missing = mesh_formats::read_obj_file(folder.path("b.obj"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::file_missing);
  EXPECT_EQ(missing.error().text(), folder.path("b.obj").string() + ": No such file or directory");
}

}  // namespace
