#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mesh_formats/obj/obj_reader.h"
#include "mesh_formats/obj/obj_writer.h"
#include "support/scratch_folder.h"
#include "unit/mesh_formats/polygon_faces.h"
#include "unit/mesh_formats/random_polygons.h"

namespace {

using algebra3d::ErrorCode;
using algebra3d::PolygonSoup;
using algebra3d::Vec3;
using mesh_formats::write_obj_file;

class ObjWriter : public ::testing::Test {
 protected:
  std::string written(const PolygonSoup& soup, std::string_view name) {
    const auto status = write_obj_file(folder_.path("out.obj"), soup, name);
    EXPECT_TRUE(status) << status.error().text();
    return folder_.bytes("out.obj");
  }

  void expect_error(const std::filesystem::path& path, const PolygonSoup& soup, ErrorCode code,
                    const std::string& message) {
    const std::size_t before = folder_.file_count();
    const auto status = write_obj_file(path, soup, "part");
    ASSERT_FALSE(status) << message;
    EXPECT_EQ(status.error().text(), message);
    EXPECT_EQ(status.error().code, code);
    EXPECT_EQ(folder_.file_count(), before) << "the temporary file was left behind";
  }

  ScratchFolder folder_;
};

TEST_F(ObjWriter, files_have_the_text_of_the_format) {
  const PolygonSoup soup =
      polygon_soup({Vec3{0, 0, 0}, Vec3{1.5, 0, -2}, Vec3{0.1, 1e300, 4.9e-324}}, {{0, 1, 2}, {2, 1, 0, 0}});
  EXPECT_EQ(written(soup, "my part"),
            "o my part\n"
            "v 0 0 0\n"
            "v 1.5 0 -2\n"
            "v 0.1 1e+300 5e-324\n"
            "f 1 2 3\n"
            "f 3 2 1 1\n");
  EXPECT_EQ(written({}, ""), "# no vertices\n");
}

TEST_F(ObjWriter, names_become_one_line) {
  const PolygonSoup soup = polygon_soup({Vec3{}}, {});
  EXPECT_EQ(written(soup, ""), "v 0 0 0\n");
  EXPECT_EQ(written(soup, " \n\t"), "v 0 0 0\n");
  EXPECT_EQ(written(soup, " two\nlines\r\nand\ta tab "), "o two lines  and a tab\nv 0 0 0\n");
  EXPECT_EQ(written(soup, "W\xc3\xbcrfel"), "o W\xc3\xbcrfel\nv 0 0 0\n");
  EXPECT_EQ(written(soup, "path\\"), "o path\\ \nv 0 0 0\n");
}

TEST_F(ObjWriter, nothing_reads_back) {
  EXPECT_EQ(written(polygon_soup({}, {}), ""), "# no vertices\n");
  const auto read = mesh_formats::read_obj_file(folder_.path("out.obj"));
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_TRUE(read->soup.points.empty());
}

TEST_F(ObjWriter, awkward_names_read_back) {
  const PolygonSoup soup = polygon_soup({Vec3{}}, {});
  for (const std::string name : {"path\\", "# 1", "o", "v 1 2 3", "a  b", "\\"}) {
    written(soup, name);
    const auto read = mesh_formats::read_obj_file(folder_.path("out.obj"));
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->soup.name, name);
    EXPECT_EQ(read->soup.points, soup.points);
    EXPECT_TRUE(read->remarks.empty());
  }
}

TEST_F(ObjWriter, what_is_written_reads_back_for_any_doubles) {
  const PolygonSoup soup = random_polygons(20'000);
  written(soup, "any");
  const auto read = mesh_formats::read_obj_file(folder_.path("out.obj"));
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->soup.points, soup.points);
  EXPECT_EQ(read->soup.face_starts, soup.face_starts);
  EXPECT_EQ(read->soup.corners, soup.corners);
  EXPECT_EQ(read->soup.name, "any");
  EXPECT_TRUE(read->remarks.empty());
}

// The C library as a second reader.
TEST_F(ObjWriter, numbers_are_the_same_for_strtod) {
  const PolygonSoup soup = random_polygons(3'000);
  std::istringstream text(written(soup, ""));
  for (const Vec3& point : soup.points) {
    std::string word;
    text >> word;
    ASSERT_EQ(word, "v");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      text >> word;
      ASSERT_EQ(std::strtod(word.c_str(), nullptr), point[axis]) << word;
    }
  }
}

TEST_F(ObjWriter, what_cannot_be_written_is_named_and_the_old_file_stays) {
  folder_.write("out.obj", "old");
  const double infinity = std::numeric_limits<double>::infinity();
  const auto path = folder_.path("out.obj");
  const std::vector<Vec3> points = {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  expect_error(path, polygon_soup({Vec3{}, Vec3{0, std::nan(""), 0}}, {}), ErrorCode::invalid_value,
               folder_.path("out.obj").string() + ": point 2: y is nan; expected a finite number");
  expect_error(path, polygon_soup({Vec3{0, 0, -infinity}}, {}), ErrorCode::invalid_value,
               folder_.path("out.obj").string() + ": point 1: z is -inf; expected a finite number");
  expect_error(path, polygon_soup(points, {{0, 1, 2}, {0, 1}}), ErrorCode::invalid_value,
               folder_.path("out.obj").string() + ": face 2 has 2 corners; expected at least 3");
  expect_error(path, polygon_soup(points, {{0, 1, 3}}), ErrorCode::invalid_value,
               folder_.path("out.obj").string() + ": face 1, corner 3: the index is 3; expected one of 3 points");
  EXPECT_EQ(folder_.bytes("out.obj"), "old");
}

TEST_F(ObjWriter, places_that_cannot_be_written_are_named) {
  const auto missing = folder_.path("no such folder") / "out.obj";
  expect_error(missing, {}, ErrorCode::file_missing,
               missing.string() + ": there is no folder '" + missing.parent_path().string() + "'");
  expect_error(folder_.path(""), {}, ErrorCode::io_error, folder_.path("").string() + ": it is a folder, not a file");
}

}  // namespace
