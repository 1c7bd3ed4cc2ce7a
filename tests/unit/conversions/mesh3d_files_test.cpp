#include "algebra3d/values/conversions/mesh3d_files.h"

#include <random>

#include <gtest/gtest.h>

#include "support/scratch_folder.h"
#include "unit/operators/call_operator.h"

namespace algebra3d {
namespace {

using calls::Answer;

Answer call(const std::filesystem::path& folder, const std::string& name, const std::vector<Value>& arguments) {
  return calls::call_values(name, arguments, folder);
}

Answer import(const std::filesystem::path& folder, const std::string& file) {
  return call(folder, "importMesh", {calls::value(file.c_str())});
}

Value mesh_of(const std::string& text) {
  Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};
  auto value = value_from_nested(TypeOf<Mesh3d>::type(), *NestedList::parse(text), context);
  EXPECT_TRUE(value.ok()) << text;
  return *value;
}

const std::string kSquareAndTriangle =
    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0) (0.0 0.0 1.0)) ((0 1 2 3) (0 4 1)))";

TEST(Mesh3dFiles, polygons_come_back_from_all_formats_of_polygons) {
  const ScratchFolder folder;
  const Value mesh = mesh_of(kSquareAndTriangle);
  ASSERT_TRUE(
      call(folder.path(""), "exportOBJ", {mesh, Value::of(std::string("part")), calls::value("a.obj")}).get<bool>());
  for (const bool is_binary : {false, true})
    ASSERT_TRUE(call(folder.path(""), "exportOFF",
                     {mesh, calls::value(is_binary ? "b.off" : "a.off"), Value::of<bool>(is_binary)})
                    .get<bool>());
  for (const char* file : {"a.off", "b.off"}) EXPECT_EQ(import(folder.path(""), file).text(), kSquareAndTriangle);
  const Answer named = import(folder.path(""), "a.obj");
  EXPECT_EQ(call(folder.path(""), "removeAttribute",
                 {named.single(), Value::of(std::string("face")), Value::of(std::string("Object"))})
                .text(),
            kSquareAndTriangle);
}

TEST(Mesh3dFiles, attributes_of_obj_files_are_kept) {
  const ScratchFolder folder;
  folder.write(
      "a.obj",
      "mtllib x.mtl\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
      "vt 0 0\nvt 1 0 0\nvt 1\nvn 0 0 1\ng left side\nusemtl steel\nf 1/1/1 2/2/1 3/-1/-1 4//1\ng\nf 1 5/2 2\n");
  const std::string expected =
      "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0) (0.0 0.0 1.0)) ((0 1 2 3) (0 4 1)) "
      "((halfedge \"Normal\" vector ((0.0 0.0 1.0) (0.0 0.0 1.0) (0.0 0.0 1.0) (0.0 0.0 1.0) undefined undefined "
      "undefined)) (halfedge \"TextureCoordinate\" pair ((0.0 0.0) (1.0 0.0) (1.0 0.0) undefined undefined (1.0 0.0) "
      "undefined)) (face \"Group\" text ('left side' undefined)) (face \"Material\" text ('steel' 'steel')) "
      "(face \"MaterialLibrary\" text ('x.mtl' 'x.mtl')) (face \"Object\" text ('cube' 'cube'))))";
  const Answer read = import(folder.path(""), "a.obj");
  EXPECT_EQ(read.text(), expected);
  EXPECT_EQ(read.diagnostics, std::vector<std::string>());
  ASSERT_TRUE(
      call(folder.path(""), "exportOBJ", {read.single(), Value::of(std::string()), calls::value("b.obj")}).get<bool>());
  EXPECT_EQ(folder.bytes("b.obj"),
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvn 0 0 1\no cube\ng left side\nmtllib x.mtl\n"
            "usemtl steel\nf 1/1/1 2/2/1 3/2/1 4//1\ng\nf 1 5/2 2\n");
  EXPECT_EQ(import(folder.path(""), "b.obj").text(), expected);
}

TEST(Mesh3dFiles, what_a_format_cannot_hold_is_reported) {
  const ScratchFolder folder;
  const Value mesh =
      mesh_of("(((0.1 0 0) (1 0 0) (1/3 1 0)) ((0 1 2)) ((face \"Material\" text ('a')) (face \"Weight\" real (1))))");
  const Answer obj = call(folder.path(""), "exportOBJ", {mesh, Value::of(std::string()), calls::value("a.obj")});
  EXPECT_TRUE(obj.get<bool>());
  ASSERT_EQ(obj.diagnostics.size(), 2U);
  EXPECT_TRUE(obj.diagnostics[0].starts_with("exportOBJ: 1 attribute not written")) << obj.diagnostics[0];
  EXPECT_TRUE(obj.diagnostics[1].starts_with("exportOBJ: 1 of 3 vertices rounded to doubles")) << obj.diagnostics[1];
  const Answer off = call(folder.path(""), "exportOFF", {mesh, calls::value("a.off"), Value::of<bool>(true)});
  ASSERT_EQ(off.diagnostics.size(), 2U);
  EXPECT_TRUE(off.diagnostics[0].starts_with("exportOFF: 2 attributes not written")) << off.diagnostics[0];
  EXPECT_TRUE(off.diagnostics[1].starts_with("exportOFF: 2 of 3 vertices rounded to floats")) << off.diagnostics[1];
}

/// Files in the forms of OFF, with the attributes of their mesh.
TEST(Mesh3dFiles, attributes_of_off_are_read_and_written) {
  const ScratchFolder folder;
  const std::vector<std::pair<std::string, std::string>> files = {
      {"NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 2\n0 1 0 0 0 0\n3 0 1 2\n",
       "((vertex \"Normal\" vector ((0.0 0.0 1.0) (0.0 0.0 2.0) undefined)))"},
      {"COFF\n3 1 0\n0 0 0 255 0 51 255\n1 0 0 0 0 0 0\n0 1 0 255 255 255 255\n3 0 1 2 255 0 0\n",
       "((vertex \"Colour\" vector ((1.0 0.0 0.2) (0.0 0.0 0.0) (1.0 1.0 1.0))) (vertex \"Opacity\" real (1.0 0.0 "
       "1.0)) "
       "(face \"Colour\" vector ((1.0 0.0 0.0))))"},
      {"STOFF\n3 1 0\n0 0 0 0.5 1\n1 0 0 7 0\n0 1 0 -1 2\n3 0 1 2\n",
       "((vertex \"TextureCoordinate\" pair ((0.5 1.0) (7.0 0.0) (-1.0 2.0))))"},
      {"STCNOFF\n3 1 0\n0 0 0 0 0 1 0.5 0 1 1 0.25 0.75\n1 0 0 0 1 0 0 0 0 1 0 0\n0 1 0 1 0 0 1 1 1 1 1 1\n3 0 1 2\n",
       "((vertex \"Colour\" vector ((0.5 0.0 1.0) (0.0 0.0 0.0) (1.0 1.0 1.0))) (vertex \"Normal\" vector ((0.0 0.0 "
       "1.0) "
       "(0.0 1.0 0.0) (1.0 0.0 0.0))) (vertex \"Opacity\" real (1.0 1.0 1.0)) (vertex \"TextureCoordinate\" pair "
       "((0.25 "
       "0.75) (0.0 0.0) (1.0 1.0))))"},
      {"CNOFF 3 1 0 0 0 0 0 0 1 0.5 0 1 1 1 0 0 0 1 0 0 0 0 1 0 1 0 1 0 0 1 1 1 1 3 0 1 2",
       "((vertex \"Colour\" vector ((0.5 0.0 1.0) (0.0 0.0 0.0) (1.0 1.0 1.0))) (vertex \"Normal\" vector ((0.0 0.0 "
       "1.0) "
       "(0.0 1.0 0.0) (1.0 0.0 0.0))) (vertex \"Opacity\" real (1.0 1.0 1.0)))"},
  };
  for (const auto& [bytes, attributes] : files) {
    SCOPED_TRACE(bytes);
    folder.write("a.off", bytes);
    const Answer read = import(folder.path(""), "a.off");
    EXPECT_EQ(read.text(), "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)) ((0 1 2)) " + attributes + ")");
    EXPECT_TRUE(read.diagnostics.empty()) << read.diagnostics.front();
    for (const bool is_binary : {false, true}) {
      const Answer written =
          call(folder.path(""), "exportOFF", {read.single(), calls::value("b.off"), Value::of<bool>(is_binary)});
      EXPECT_TRUE(written.get<bool>());
      EXPECT_TRUE(written.diagnostics.empty()) << written.diagnostics.front();
      const Answer again = import(folder.path(""), "b.off");
      // 0.2 is no float.
      const bool is_rounded = is_binary && bytes.starts_with("COFF");
      if (!is_rounded) {
        EXPECT_EQ(again.text(), read.text());
      }
    }
  }
}

TEST(Mesh3dFiles, texts_that_no_line_holds_are_reported) {
  const ScratchFolder folder;
  const Value mesh = mesh_of(
      "(((0 0 0) (1 0 0) (0 1 0) (0 0 1)) ((0 1 2) (0 1 3) (1 2 3)) ((face \"Material\" text (' a ' 'b' 'c'))))");
  const Answer obj = call(folder.path(""), "exportOBJ", {mesh, Value::of(std::string()), calls::value("a.obj")});
  ASSERT_EQ(obj.diagnostics.size(), 1U);
  EXPECT_TRUE(obj.diagnostics[0].starts_with("exportOBJ: 1 text changed: control characters become blanks"))
      << obj.diagnostics[0];
}

TEST(Mesh3dFiles, nonmanifold_meshes_are_kept_and_counted) {
  const ScratchFolder folder;
  folder.write("a.off", "OFF\n6 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n5 5 5\n3 0 1 2\n3 0 1 3\n3 1 0 4\n3 0 0 5\n");
  const Answer read = import(folder.path(""), "a.off");
  EXPECT_EQ(call(folder.path(""), "size", {read.single()}).get<std::int64_t>(), 4);
  ASSERT_EQ(read.diagnostics.size(), 1U);
  EXPECT_TRUE(read.diagnostics[0].starts_with(
      "importMesh: 2 non-manifold edges (first between vertices 0 and 1) and 2 non-manifold vertices (first 0)"))
      << read.diagnostics[0];
}

TEST(Mesh3dFiles, references_to_missing_attributes_are_counted) {
  const ScratchFolder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 x\nf 1/1/1 2/7 3/-9\nf 1/1 2\n");
  const Answer read = import(folder.path(""), "a.obj");
  EXPECT_EQ(read.text(),
            "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)) ((0 1 2)) "
            "((halfedge \"TextureCoordinate\" pair (undefined undefined undefined))))");
  ASSERT_EQ(read.diagnostics.size(), 2U);
  EXPECT_TRUE(read.diagnostics[1].starts_with(
      "importMesh: 3 references of corners to missing texture coordinates or normals ignored"))
      << read.diagnostics[1];
}

TEST(Mesh3dFiles, random_meshes_come_back_from_text) {
  std::mt19937 random(21);
  const ScratchFolder folder;
  for (int round = 0; round < 30; ++round) {
    std::string points, faces, materials;
    const std::uint32_t count = 3 + static_cast<std::uint32_t>(random() % 30);
    for (std::uint32_t i = 0; i < count; ++i)
      points += fmt::format("({} {} {})", static_cast<double>(random()) / 7, random() % 5, i);
    for (std::uint32_t f = static_cast<std::uint32_t>(random() % 40); f > 0; --f) {
      faces += "(";
      for (std::uint32_t i = 3 + static_cast<std::uint32_t>(random() % 4); i > 0; --i)
        faces += fmt::format(" {}", random() % count);
      faces += ")";
      materials += random() % 3 == 0 ? " undefined" : fmt::format(" 'm {}'", random() % 3);
    }
    const Value mesh = mesh_of("((" + points + ") (" + faces + ") ((face \"Material\" text (" + materials + "))))");
    ASSERT_TRUE(
        call(folder.path(""), "exportOBJ", {mesh, Value::of(std::string()), calls::value("r.obj")}).get<bool>());
    const Answer read = import(folder.path(""), "r.obj");
    const bool has_material = materials.find('m') != std::string::npos;
    if (has_material) {
      EXPECT_EQ(compare(read.single(), mesh), std::strong_ordering::equal);
    }
  }
}

TEST(Mesh3dFiles, missing_and_malformed_files_are_undefined_with_the_reason) {
  const ScratchFolder folder;
  EXPECT_FALSE(import(folder.path(""), "none.obj").is_defined());
  folder.write("bad.obj", "v 0 0\n");
  EXPECT_FALSE(import(folder.path(""), "bad.obj").is_defined());
}

}  // namespace
}  // namespace algebra3d
