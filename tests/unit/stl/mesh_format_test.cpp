#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "stl/mesh_format.h"
#include "unit/stl/scratch_folder.h"
#include "unit/stl/stl_bytes.h"

namespace {

using algebra3d::ErrorCode;
using stl::detect_mesh_format;
using stl::MeshFormat;

struct Detected {
  std::string bytes;
  std::string name;
  MeshFormat format;
};

const std::string kBinaryStl = stl_bytes::header("part", 2) + stl_bytes::facets(2);

std::vector<Detected> told_by_content() {
  return {
      {kBinaryStl, "a.off", MeshFormat::stl},
      {stl_bytes::header("OFF", 1) + stl_bytes::facets(1), "a.off", MeshFormat::stl},
      {stl_bytes::header("v 1 2 3", 1) + stl_bytes::facets(1), "a", MeshFormat::stl},
      {stl_bytes::kAscii, "a.obj", MeshFormat::stl},
      {stl_bytes::kAscii, "a", MeshFormat::stl},
      {"# comment\n SOLID a\nendsolid a", "a.off", MeshFormat::stl},
      {"OFF\n1 0 0\n0 0 0", "a.stl", MeshFormat::off},
      {"\xef\xbb\xbf# comment\r\n OFF", "a.obj", MeshFormat::off},
      {"STCN4nOFF 3 1 0 0", "", MeshFormat::off},
      {"OFF8 6 12", "a", MeshFormat::off},
      {"OFF BINARY\n" + std::string(12, '\0'), "a.stl", MeshFormat::off},
      {"v 0 0 0\n", "a.stl", MeshFormat::obj},
      {"v", "a", MeshFormat::obj},
      {"\xef\xbb\xbf# comment\r\n\r\nmtllib a.mtl\r\n", "a.OFF", MeshFormat::obj},
      {"o part\n", "a.txt", MeshFormat::obj},
      {"usemtl x", "", MeshFormat::obj},
  };
}

std::vector<Detected> told_by_name() {
  return {
      {"8 6 12\n0 0 0\n", "folder.stl/a.off", MeshFormat::off},
      {"8 6 12\n0 0 0\n", "a.b.OFF", MeshFormat::off},
      {"# nothing", "a.obj", MeshFormat::obj},
      {"unknown statement", "a.Obj", MeshFormat::obj},
      {"OFFX", "a.off", MeshFormat::off},
      {"V 1 2 3", "a.stl", MeshFormat::stl},
      {"", "a.obj", MeshFormat::obj},
      {" \n", "a.off", MeshFormat::off},
      {"", "a.STL", MeshFormat::stl},
      // Headers of binary files whose count is wrong.
      {stl_bytes::header("OFF file, converted", 1) + stl_bytes::facets(2), "a.stl", MeshFormat::stl},
      {stl_bytes::header("o part", 1) + stl_bytes::facets(2), "a.stl", MeshFormat::stl},
      {std::string("\0\0rubbish", 9), "a.obj", MeshFormat::obj},
  };
}

TEST(MeshFormatTest, content_decides_before_the_name) {
  for (const auto& table : {told_by_content(), told_by_name()}) {
    for (const Detected& file : table) {
      const auto format = detect_mesh_format(file.bytes, file.name);
      ASSERT_TRUE(format) << format.error().message;
      EXPECT_EQ(*format, file.format) << file.name << "\n" << file.bytes;
    }
  }
}

TEST(MeshFormatTest, what_is_no_text_and_has_no_ending_is_binary_stl) {
  const auto format = detect_mesh_format(kBinaryStl + "x", "a.bin");
  ASSERT_TRUE(format) << format.error().message;
  EXPECT_EQ(*format, MeshFormat::stl);
}

TEST(MeshFormatTest, files_of_other_programs_are_refused_whatever_their_name) {
  const std::string zeros(200, '\0');
  for (const auto& [bytes, what] : std::vector<std::pair<std::string, std::string>>{
           {"\x7f"
            "ELF" +
                zeros,
            "a program"},
           {"\x1f\x8b" + zeros, "compressed by gzip"},
           {"SQLite format 3" + zeros, "a SQLite database"},
           {stl_bytes::header("%PDF", 1) + stl_bytes::facets(2), "a PDF document"}}) {
    for (const std::string name : {"a.stl", "a.obj", "a.off", "a"}) {
      const auto format = detect_mesh_format(bytes, name);
      ASSERT_FALSE(format);
      EXPECT_EQ(format.error().code, ErrorCode::file_format);
      EXPECT_EQ(format.error().message, name + ": it is " + what + "; expected an STL, OBJ or OFF file");
    }
  }
  const auto exact = detect_mesh_format(stl_bytes::header("%PDF", 1) + stl_bytes::facets(1), "a");
  EXPECT_TRUE(exact && *exact == MeshFormat::stl);
}

TEST(MeshFormatTest, anything_else_is_an_error) {
  for (const std::string& bytes : {std::string("Once upon a time"), std::string(), std::string("8 6 12\n"),
                                   std::string("# comment"), std::string("\0\1\2", 3)}) {
    for (const std::string name : {"a.txt", "off", ""}) {
      const auto format = detect_mesh_format(bytes, name);
      ASSERT_FALSE(format);
      EXPECT_EQ(format.error().code, ErrorCode::file_format);
      EXPECT_EQ(format.error().message,
                name + ": neither content nor name is that of a mesh file; expected STL, OBJ or OFF");
    }
  }
}

TEST(MeshFormatTest, files_are_examined_by_their_path) {
  const ScratchFolder folder;
  folder.write("a", "OFF\n0 0 0\n");
  const auto format = stl::detect_mesh_format_of_file(folder.path("a"));
  ASSERT_TRUE(format) << format.error().message;
  EXPECT_EQ(*format, MeshFormat::off);
  const auto missing = stl::detect_mesh_format_of_file(folder.path("b.obj"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::file_missing);
}

}  // namespace
