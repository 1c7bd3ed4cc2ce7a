#include <array>
#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/memory_sink.h"
#include "mesh_formats/mesh_formats.h"
#include "support/scratch_folder.h"
#include "unit/stl/stl_bytes.h"

namespace {

using algebra3d::ErrorCode;
using mesh_formats::CoordinateRange;
using mesh_formats::Encoding;
using mesh_formats::Facets;
using mesh_formats::FileForm;
using mesh_formats::known_mesh_formats;
using mesh_formats::Match;
using mesh_formats::MeshContent;
using mesh_formats::MeshFormat;
using mesh_formats::MeshFormats;

struct Detected {
  std::string bytes;
  std::string name;
  std::string_view format;
};

const std::string kBinaryStl = stl_bytes::header("part", 2) + stl_bytes::facets(2);

std::vector<Detected> told_by_content() {
  return {
      {kBinaryStl, "a.off", "STL"},
      {stl_bytes::header("OFF", 1) + stl_bytes::facets(1), "a.off", "STL"},
      {stl_bytes::header("v 1 2 3", 1) + stl_bytes::facets(1), "a", "STL"},
      {stl_bytes::kAscii, "a.obj", "STL"},
      {stl_bytes::kAscii, "a", "STL"},
      {"# comment\n SOLID a\nendsolid a", "a.off", "STL"},
      {"OFF\n1 0 0\n0 0 0", "a.stl", "OFF"},
      {"\xef\xbb\xbf# comment\r\n OFF", "a.obj", "OFF"},
      {"STCN4nOFF 3 1 0 0", "", "OFF"},
      {"OFF8 6 12", "a", "OFF"},
      {"OFF BINARY\n" + std::string(12, '\0'), "a.stl", "OFF"},
      {"v 0 0 0\n", "a.stl", "OBJ"},
      {"v", "a", "OBJ"},
      {"\xef\xbb\xbf# comment\r\n\r\nmtllib a.mtl\r\n", "a.OFF", "OBJ"},
      {"o part\n", "a.txt", "OBJ"},
      {"usemtl x", "", "OBJ"},
  };
}

std::vector<Detected> told_by_name() {
  return {
      {"8 6 12\n0 0 0\n", "folder.stl/a.off", "OFF"},
      {"8 6 12\n0 0 0\n", "a.b.OFF", "OFF"},
      {"# nothing", "a.obj", "OBJ"},
      {"unknown statement", "a.Obj", "OBJ"},
      {"OFFX", "a.off", "OFF"},
      {"V 1 2 3", "a.stl", "STL"},
      {"", "a.obj", "OBJ"},
      {" \n", "a.off", "OFF"},
      {"", "a.STL", "STL"},
      // Headers of binary files whose count is wrong.
      {stl_bytes::header("OFF file, converted", 1) + stl_bytes::facets(2), "a.stl", "STL"},
      {stl_bytes::header("o part", 1) + stl_bytes::facets(2), "a.stl", "STL"},
      {std::string("\0\0rubbish", 9), "a.obj", "OBJ"},
  };
}

TEST(MeshFormatTest, content_decides_before_the_name) {
  for (const auto& table : {told_by_content(), told_by_name()}) {
    for (const Detected& file : table) {
      const auto format = known_mesh_formats().detect(file.bytes, file.name);
      ASSERT_TRUE(format) << format.error().text();
      EXPECT_EQ((*format)->name, file.format) << file.name << "\n" << file.bytes;
    }
  }
}

TEST(MeshFormatTest, what_is_no_text_and_has_no_ending_is_binary_stl) {
  const auto format = known_mesh_formats().detect(kBinaryStl + "x", "a.bin");
  ASSERT_TRUE(format) << format.error().text();
  EXPECT_EQ((*format)->name, "STL");
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
           {std::string("o\0f\0f\0\n\0"
                        "4\0 \0"
                        "4\0 \0"
                        "6\0\n\0",
                        20),
            "text in UTF-16, not UTF-8"},
           {std::string("\0s\0o\0l\0i\0d\0 \0a\0\n\0 ", 18), "text in UTF-16, not UTF-8"},
           {stl_bytes::header("%PDF", 1) + stl_bytes::facets(2), "a PDF document"}}) {
    for (const std::string name : {"a.stl", "a.obj", "a.off", "a"}) {
      const auto format = known_mesh_formats().detect(bytes, name);
      ASSERT_FALSE(format);
      EXPECT_EQ(format.error().code, ErrorCode::file_format);
      EXPECT_EQ(format.error().text(), name + ": it is " + what + "; expected an STL, OBJ or OFF file");
    }
  }
  const auto exact = known_mesh_formats().detect(stl_bytes::header("%PDF", 1) + stl_bytes::facets(1), "a");
  EXPECT_TRUE(exact && (*exact)->name == "STL");
}

TEST(MeshFormatTest, anything_else_is_an_error) {
  for (const std::string& bytes : {std::string("Once upon a time"), std::string(), std::string("8 6 12\n"),
                                   std::string("# comment"), std::string("\0\1\2", 3)}) {
    for (const std::string name : {"a.txt", "off", ""}) {
      const auto format = known_mesh_formats().detect(bytes, name);
      ASSERT_FALSE(format);
      EXPECT_EQ(format.error().code, ErrorCode::file_format);
      EXPECT_EQ(format.error().text(), (name.empty() ? "" : name + ": ") +
                                           "neither content nor name is that of a mesh file; expected STL, OBJ or OFF");
    }
  }
}

TEST(MeshFormatTest, files_are_examined_by_their_path) {
  const ScratchFolder folder;
  folder.write("a", "OFF\n0 0 0\n");
  const auto format = known_mesh_formats().detect_file(folder.path("a"));
  ASSERT_TRUE(format) << format.error().text();
  EXPECT_EQ((*format)->name, "OFF");
  const auto missing = known_mesh_formats().detect_file(folder.path("b.obj"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::file_missing);
}

/// A made-up format of one triangle: `tri` and nine digits.
Match detect_tri(std::string_view head, std::size_t /*size*/) {
  return head.starts_with("tri ") ? Match::sure : Match::none;
}
algebra3d::Result<MeshContent> read_tri(std::string_view bytes, std::string_view file_name,
                                        const std::atomic<bool>* /*cancel*/) {
  if (bytes.size() != 13) return algebra3d::Error{ErrorCode::file_format, "{}: expected nine digits", file_name};
  const auto digit = [&](std::size_t i) { return static_cast<double>(bytes[4 + i] - '0'); };
  algebra3d::TriangleSoup soup;
  soup.triangles.push_back(
      {{{digit(0), digit(1), digit(2)}, {digit(3), digit(4), digit(5)}, {digit(6), digit(7), digit(8)}}});
  return MeshContent{soup, Encoding::ascii, {}, std::nullopt};
}
algebra3d::Status write_tri(algebra3d::ByteSink& sink, const Facets& facets, std::string_view /*name*/,
                            Encoding /*encoding*/) {
  std::string text = "tri ";
  for (const auto& corner : std::get<algebra3d::TriangleSoup>(facets).triangles.at(0))
    text += fmt::format("{}{}{}", corner.x, corner.y, corner.z);
  return sink.append(text);
}
constexpr std::array<std::string_view, 2> kTriEndings{".tri", ".triangle"};
constexpr std::array<FileForm, 1> kTriForms{{{Encoding::ascii, CoordinateRange::doubles}}};
constexpr MeshFormat kTri{.name = "TRI",
                          .title = "a TRI file",
                          .variants = "",
                          .endings = kTriEndings,
                          .media_type = "model/tri",
                          .forms = kTriForms,
                          .stores_triangles = true,
                          .stores_name = false,
                          .detect = detect_tri,
                          .read = read_tri,
                          .write = write_tri};

/// The known formats and the made-up one.
MeshFormats with_tri() {
  std::vector<MeshFormat> formats(known_mesh_formats().begin(), known_mesh_formats().end());
  formats.push_back(kTri);
  return MeshFormats(std::move(formats));
}

TEST(MeshFormatTest, a_format_is_known_by_its_line_in_the_table) {
  const MeshFormats formats = with_tri();
  EXPECT_EQ(formats.names("or"), "STL, OBJ, OFF or TRI");
  EXPECT_EQ(formats.endings("and", "*"), "*.stl, *.obj, *.off, *.tri and *.triangle");
  EXPECT_EQ(formats.named("TRI")->title, "a TRI file");
  EXPECT_EQ(formats.of_name("a.Triangle")->name, "TRI");
  EXPECT_EQ(formats.of_name("a.tria"), nullptr);
  EXPECT_EQ(formats.of_content("tri 000100010")->name, "TRI");
  EXPECT_EQ((*formats.detect("tri 000100010", "a.obj"))->name, "TRI");
  EXPECT_EQ((*formats.detect("000100010", "a.tri"))->name, "TRI");
  EXPECT_EQ(formats.detect("000100010", "a").error().text(),
            "a: neither content nor name is that of a mesh file; expected STL, OBJ, OFF or TRI");
  EXPECT_EQ(kTri.form(Encoding::binary), nullptr);
  EXPECT_EQ(formats.form_words("and"), "stl, stl-ascii, obj, off, off-binary and tri");
}

TEST(MeshFormatTest, a_format_reads_and_writes_by_its_functions) {
  const MeshFormats formats = with_tri();
  const ScratchFolder folder;
  const auto read = formats.named("TRI")->read("tri 001200010", "a.tri", nullptr);
  ASSERT_TRUE(read) << read.error().text();
  ASSERT_TRUE(formats.named("TRI")->write_file(folder.path("b.tri"), read->facets, "", Encoding::ascii));
  EXPECT_EQ(folder.bytes("b.tri"), "tri 001200010");
  // The facets in a format that existed before.
  ASSERT_TRUE(formats.named("STL")->write_file(folder.path("b.stl"), read->facets, "a", Encoding::ascii));
  EXPECT_EQ((*formats.detect_file(folder.path("b.stl")))->name, "STL");
  algebra3d::MemorySink memory;
  ASSERT_TRUE(formats.named("STL")->write(memory, read->facets, "a", Encoding::ascii));
  EXPECT_EQ(std::move(memory).take().at(0), folder.bytes("b.stl"));
}

}  // namespace
