#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mesh_formats/off/off_reader.h"
#include "mesh_formats/off/off_writer.h"
#include "support/scratch_folder.h"
#include "unit/mesh_formats/off_bytes.h"
#include "unit/mesh_formats/random_polygons.h"

namespace {

using algebra3d::ErrorCode;
using algebra3d::PolygonSoup;
using algebra3d::Vec3;
using mesh_formats::Encoding;
using mesh_formats::write_off_file;
using off_bytes::floats;
using off_bytes::Order;
using off_bytes::words;

class OffWriter : public ::testing::Test {
 protected:
  std::string written(const PolygonSoup& soup, Encoding format) {
    const auto status = write_off_file(folder_.path("out.off"), soup, format);
    EXPECT_TRUE(status) << status.error().text();
    return folder_.bytes("out.off");
  }

  void expect_error(const std::filesystem::path& path, const PolygonSoup& soup, Encoding format, ErrorCode code,
                    const std::string& message) {
    const std::size_t before = folder_.file_count();
    const auto status = write_off_file(path, soup, format);
    ASSERT_FALSE(status) << message;
    EXPECT_EQ(status.error().text(), message);
    EXPECT_EQ(status.error().code, code);
    EXPECT_EQ(folder_.file_count(), before) << "the temporary file was left behind";
  }

  ScratchFolder folder_;
};

const PolygonSoup& small_soup() {
  static const PolygonSoup soup =
      polygon_soup({Vec3{0, 0, 0}, Vec3{1.5, 0, -2}, Vec3{0.1, 1e30, 0}}, {{0, 1, 2}, {2, 1, 0, 0}});
  return soup;
}

TEST_F(OffWriter, ascii_files_have_the_text_of_the_format) {
  EXPECT_EQ(written(small_soup(), Encoding::ascii),
            "OFF\n"
            "3 2 0\n"
            "0 0 0\n"
            "1.5 0 -2\n"
            "0.1 1e+30 0\n"
            "3 0 1 2\n"
            "4 2 1 0 0\n");
  EXPECT_EQ(written({}, Encoding::ascii), "OFF\n0 0 0\n");
}

TEST_F(OffWriter, binary_files_have_the_bytes_of_the_format) {
  EXPECT_EQ(written(small_soup(), Encoding::binary), "OFF BINARY\n" + words(Order::big, {3, 2, 0}) +
                                                         floats(Order::big, {0, 0, 0, 1.5F, 0, -2, 0.1F, 1e30F, 0}) +
                                                         words(Order::big, {3, 0, 1, 2, 0, 4, 2, 1, 0, 0, 0}));
  EXPECT_EQ(written({}, Encoding::binary), "OFF BINARY\n" + std::string(12, '\0'));
}

TEST_F(OffWriter, binary_coordinates_are_rounded_once_to_the_nearest_float) {
  // Halfway between 1 and its successor: to even. A little more: up.
  const double half = 1 + 0x1p-24;
  written(
      polygon_soup({Vec3{half, half + 0x1p-52, half - 0x1p-53}, Vec3{0x1.fffffefffffffp127, 0x1p-150, 0x1.8p-150}}, {}),
      Encoding::binary);
  const auto read = mesh_formats::read_off_file(folder_.path("out.off"));
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->soup.points, (std::vector<Vec3>{Vec3{1, 1 + 0x1p-23, 1}, Vec3{0x1.fffffep127, 0, 0x1p-149}}));
}

TEST_F(OffWriter, what_is_written_reads_back) {
  for (const Encoding format : {Encoding::ascii, Encoding::binary}) {
    const PolygonSoup soup =
        format == Encoding::ascii ? random_polygons<double>(20'000) : random_polygons<float>(20'000);
    written(soup, format);
    const auto read = mesh_formats::read_off_file(folder_.path("out.off"));
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->soup.points, soup.points);
    EXPECT_EQ(read->soup.face_starts, soup.face_starts);
    EXPECT_EQ(read->soup.corners, soup.corners);
    EXPECT_TRUE(read->remarks.empty());
  }
}

TEST_F(OffWriter, what_cannot_be_written_is_named_and_the_old_file_stays) {
  folder_.write("out.off", "old");
  const double infinity = std::numeric_limits<double>::infinity();
  const auto path = folder_.path("out.off");
  const std::vector<Vec3> points = {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  const std::string finite = "; expected a finite number";
  expect_error(path, polygon_soup({Vec3{}, Vec3{0, std::nan(""), 0}}, {}), Encoding::ascii, ErrorCode::invalid_value,
               folder_.path("out.off").string() + ": point 2: y is nan" + finite);
  expect_error(path, polygon_soup({Vec3{0, 0, -infinity}}, {}), Encoding::binary, ErrorCode::invalid_value,
               folder_.path("out.off").string() + ": point 1: z is -inf" + finite + " within the range of float");
  expect_error(path, polygon_soup({Vec3{0x1.ffffffp127, 0, 0}}, {}), Encoding::binary, ErrorCode::invalid_value,
               folder_.path("out.off").string() + ": point 1: x is 3.4028235677973366e+38" + finite +
                   " within the range of float");
  for (const Encoding format : {Encoding::ascii, Encoding::binary}) {
    expect_error(path, polygon_soup(points, {{0, 1, 2}, {}}), format, ErrorCode::invalid_value,
                 folder_.path("out.off").string() + ": face 2 has 0 corners; expected at least 3");
    expect_error(path, polygon_soup(points, {{0, 1, 3}}), format, ErrorCode::invalid_value,
                 folder_.path("out.off").string() + ": face 1, corner 3: the index is 3; expected one of 3 points");
  }
  EXPECT_EQ(folder_.bytes("out.off"), "old");
  EXPECT_EQ(written(polygon_soup({Vec3{0x1.ffffffp127, 0, 0}}, {}), Encoding::ascii),
            "OFF\n1 0 0\n3.4028235677973366e+38 0 0\n");
}

TEST_F(OffWriter, places_that_cannot_be_written_are_named) {
  const auto missing = folder_.path("no such folder") / "out.off";
  expect_error(missing, {}, Encoding::ascii, ErrorCode::file_missing,
               missing.string() + ": there is no folder '" + missing.parent_path().string() + "'");
}

}  // namespace
