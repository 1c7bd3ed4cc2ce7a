#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mesh_formats/mesh_formats.h"
#include "mesh_formats/obj/obj_reader.h"
#include "mesh_formats/off/off_reader.h"
#include "stl/stl_reader.h"
#include "unit/stl/corpus_manifest.h"

namespace {

using algebra3d::PolygonSoup;
using algebra3d::Vec3;

// Every polygon cut into its degree - 2 triangles.
std::size_t triangle_count(const PolygonSoup& soup) {
  return soup.corners.size() - 2 * soup.face_count();
}

// Different places of corners, as the manifest counts vertices.
std::size_t corner_place_count(const PolygonSoup& soup) {
  std::set<Vec3> places;
  for (const std::uint32_t corner : soup.corners) places.insert(soup.points[corner] + Vec3{});  // no -0
  return places.size();
}

const char* corpus() {
  return std::getenv("ALGEBRA3D_CORPUS");
}

TEST(PolygonCorpus, every_file_has_the_triangle_and_vertex_count_of_the_manifest) {
  const char* folder = corpus();
  if (folder == nullptr) GTEST_SKIP() << "ALGEBRA3D_CORPUS is not set: no folder of real files to read";
  std::size_t file_count = 0;
  for (auto& row : corpus_manifest(folder)) {
    if (row["fmt"] != "obj" && row["fmt"] != "off") continue;
    SCOPED_TRACE(row["file"]);
    ++file_count;
    const auto path = std::filesystem::path(folder) / row["file"];
    const auto read = row["fmt"] == "obj" ? mesh_formats::read_obj_file(path) : mesh_formats::read_off_file(path);
    if (row["class"].starts_with("malformed")) {
      EXPECT_TRUE(read || read.error().text().find(", line ") != std::string::npos);
      continue;
    }
    ASSERT_TRUE(read) << read.error().text();
    if (row["class"].starts_with("binary_off")) continue;  // the manifest's reader could not read it
    EXPECT_EQ(std::to_string(triangle_count(read->soup)), row["triangles"]);
    EXPECT_EQ(std::to_string(corner_place_count(read->soup)), row["uniqverts"]);
  }
  EXPECT_GT(file_count, 0U) << "no OBJ or OFF file in the manifest of " << folder;
}

// The oracle is the count in the header, read off a dump by hand.
TEST(PolygonCorpus, binary_files_of_pmp_library_are_read) {
  const char* folder = corpus();
  if (folder == nullptr) GTEST_SKIP() << "ALGEBRA3D_CORPUS is not set: no folder of real files to read";
  for (auto& row : corpus_manifest(folder)) {
    if (row["source_path"] != "data/off/beetle.off") continue;
    const auto read = mesh_formats::read_off_file(std::filesystem::path(folder) / row["file"]);
    ASSERT_TRUE(read) << read.error().text();
    // Its bytes f1 13 00 00 and c0 25 00 00.
    EXPECT_EQ(read->soup.points.size(), 0x13f1U);
    EXPECT_EQ(read->soup.face_count(), 0x25c0U);
    EXPECT_EQ(read->remarks, (std::vector<std::string>{"numbers are little-endian; the format has them big-endian",
                                                       "faces lack the number of their colour floats"}));
  }
}

TEST(PolygonCorpus, every_file_has_the_format_of_the_manifest) {
  const char* folder = corpus();
  if (folder == nullptr) GTEST_SKIP() << "ALGEBRA3D_CORPUS is not set: no folder of real files to read";
  for (auto& row : corpus_manifest(folder)) {
    SCOPED_TRACE(row["file"]);
    const auto format = mesh_formats::known_mesh_formats().detect_file(std::filesystem::path(folder) / row["file"]);
    ASSERT_TRUE(format) << format.error().text();
    const std::string_view expected = row["fmt"] == "obj" ? "OBJ" : row["fmt"] == "off" ? "OFF" : "STL";
    EXPECT_EQ((*format)->name, expected);
  }
}

}  // namespace
