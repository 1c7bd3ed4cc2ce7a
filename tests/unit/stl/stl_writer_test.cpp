#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "stl/stl_reader.h"
#include "stl/stl_writer.h"
#include "support/scratch_folder.h"
#include "unit/stl/stl_bytes.h"

namespace {

using algebra3d::ErrorCode;
using algebra3d::TriangleSoup;
using algebra3d::Vec3;
using mesh_formats::Encoding;
using mesh_formats::write_stl_file;

TriangleSoup soup_of(std::vector<TriangleSoup::Triangle> triangles) {
  TriangleSoup soup;
  soup.triangles = std::move(triangles);
  return soup;
}

const TriangleSoup kOne = soup_of({{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{0, 0.5, 0}}});

class StlWriter : public ::testing::Test {
 protected:
  std::string written(const TriangleSoup& soup, std::string_view name, Encoding format) {
    const auto status = write_stl_file(folder_.path("out.stl"), soup, name, format);
    EXPECT_TRUE(status) << status.error().text();
    return folder_.bytes("out.stl");
  }

  void expect_error(const std::filesystem::path& path, const TriangleSoup& soup, ErrorCode code,
                    const std::string& message) {
    for (const Encoding format : {Encoding::ascii, Encoding::binary}) {
      const std::size_t before = folder_.file_count();
      const auto status = write_stl_file(path, soup, "part", format);
      ASSERT_FALSE(status) << message;
      EXPECT_EQ(status.error().text(), message);
      EXPECT_EQ(status.error().code, code);
      EXPECT_EQ(folder_.file_count(), before) << "the temporary file was left behind";
    }
  }

  ScratchFolder folder_;
};

TEST_F(StlWriter, binary_files_have_the_bytes_of_the_format) {
  EXPECT_EQ(written(kOne, "part", Encoding::binary),
            stl_bytes::header("part", 1) + stl_bytes::facet({0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0.5F, 0}));
  EXPECT_EQ(written({}, "", Encoding::binary), std::string(84, '\0'));
}

TEST_F(StlWriter, ascii_files_have_the_text_of_the_format) {
  EXPECT_EQ(written(kOne, "my part", Encoding::ascii),
            "solid my part\n"
            "  facet normal 0 0 1\n"
            "    outer loop\n"
            "      vertex 0 0 0\n"
            "      vertex 2 0 0\n"
            "      vertex 0 0.5 0\n"
            "    endloop\n"
            "  endfacet\n"
            "endsolid my part\n");
  EXPECT_EQ(written({}, "", Encoding::ascii), "solid\nendsolid\n");
}

TEST_F(StlWriter, ascii_digits_give_the_float_both_as_float_and_as_double) {
  const std::string text =
      written(soup_of({{Vec3{0.1, 1e-45, 0}, Vec3{1e10, -3.4028234663852886e38, 0}, Vec3{0, 0, 1.0 / 3}}}), "",
              Encoding::ascii);
  EXPECT_NE(text.find("vertex 0.10000000149011612 1.401298464324817e-45 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("vertex 1e+10 -3.4028234663852886e+38 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("vertex 0 0 0.3333333432674408\n"), std::string::npos) << text;
}

struct Name {
  std::string given;
  std::string header;
  std::string line;
};

TEST_F(StlWriter, names_become_one_line_and_a_header_that_does_not_begin_with_solid) {
  const std::string long_name(100, 'n');
  const std::vector<Name> names = {
      {"", "", ""},
      {"solid part", "STL solid part", " solid part"},
      {" SOLID", "STL SOLID", " SOLID"},
      {"Solidity", "STL Solidity", " Solidity"},
      {"two\nlines\r\nand\ta tab\n", "two lines  and a tab", " two lines  and a tab"},
      {std::string("nul\0inside", 10), "nul inside", " nul inside"},
      {long_name, long_name.substr(0, 80), " " + long_name},
      {std::string(79, 'n') + "\xc3\xbc", std::string(79, 'n'), " " + std::string(79, 'n') + "\xc3\xbc"},
  };
  for (const Name& name : names) {
    EXPECT_EQ(written({}, name.given, Encoding::binary), stl_bytes::header(name.header, 0)) << name.given;
    EXPECT_EQ(written({}, name.given, Encoding::ascii), "solid" + name.line + "\nendsolid" + name.line + "\n");
  }
}

TEST_F(StlWriter, awkward_names_read_back) {
  for (const std::string name :
       {"facet", "endsolid", "a solid b", "the end solid of it", "facet normal", "facet normal 1"}) {
    TriangleSoup soup = kOne;
    written(soup, name, Encoding::ascii);
    const auto read = mesh_formats::read_stl_file(folder_.path("out.stl"));
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->soup.name, name);
    EXPECT_EQ(read->soup.triangles, soup.triangles);
  }
}

TEST_F(StlWriter, coordinates_are_rounded_once_to_the_nearest_float) {
  // Halfway between 1 and its successor: to even. A little more: up. Rounding to 9 digits first would lose the
  // difference.
  const double half = 1 + 0x1p-24;
  written(soup_of({{Vec3{half, half + 0x1p-52, half - 0x1p-53}, Vec3{0x1.fffffefffffffp127, 0x1p-150, 0x1.8p-150},
                    Vec3{}}}),
          "", Encoding::ascii);
  const auto read = mesh_formats::read_stl_file(folder_.path("out.stl"));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->soup.triangles.at(0)[0], (Vec3{1, 1 + 0x1p-23, 1}));
  EXPECT_EQ(read->soup.triangles.at(0)[1], (Vec3{0x1.fffffep127, 0, 0x1p-149}));
}

TEST_F(StlWriter, what_is_written_reads_back_for_any_floats) {
  std::mt19937 random(20240601);
  TriangleSoup soup;
  while (soup.triangles.size() < 20'000) {
    TriangleSoup::Triangle triangle;
    bool finite = true;
    for (Vec3& corner : triangle) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // Any bit pattern: all exponents, subnormals and zeros of both signs.
        const auto bits = static_cast<std::uint32_t>(random());
        const auto value = std::bit_cast<float>(random() % 8 == 0 ? bits & 0x807fffffU : bits);
        finite = finite && std::isfinite(value);
        corner[axis] = value;
      }
    }
    if (finite) soup.triangles.push_back(triangle);
  }
  std::vector<std::vector<Vec3>> normals;
  for (const Encoding format : {Encoding::binary, Encoding::ascii}) {
    written(soup, "any", format);
    const auto read = mesh_formats::read_stl_file(folder_.path("out.stl"));
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->format, format);
    EXPECT_EQ(read->soup.triangles, soup.triangles);
    EXPECT_EQ(read->soup.name, "any");
    EXPECT_TRUE(read->remarks.empty());
    normals.push_back(read->soup.normals);
  }
  EXPECT_EQ(normals[0], normals[1]);
}

TEST_F(StlWriter, normals_have_length_one_and_follow_the_order_of_the_corners) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> coordinate(-1000, 1000);
  std::vector<TriangleSoup::Triangle> triangles(1'000);
  for (auto& triangle : triangles)
    for (Vec3& corner : triangle) corner = {coordinate(random), coordinate(random), coordinate(random)};
  written(soup_of(triangles), "", Encoding::binary);
  const auto read = mesh_formats::read_stl_file(folder_.path("out.stl"));
  ASSERT_TRUE(read);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Vec3& n = read->soup.normals[i];
    const Vec3 u = triangles[i][1] - triangles[i][0];
    const Vec3 v = triangles[i][2] - triangles[i][0];
    ASSERT_NEAR(std::sqrt(dot(n, n)), 1, 1e-6);
    ASSERT_NEAR(dot(n, u), 0, 1e-3);
    ASSERT_NEAR(dot(n, v), 0, 1e-3);
    ASSERT_GT(dot(n, cross(u, v)), 0);
  }
}

// The C library as a second reader: as float and as double.
TEST_F(StlWriter, ascii_numbers_are_the_same_for_strtof_and_strtod) {
  std::mt19937 random(7);
  std::vector<float> values;
  std::vector<TriangleSoup::Triangle> triangles;
  while (triangles.size() < 3'000) {
    TriangleSoup::Triangle triangle;
    for (Vec3& corner : triangle)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()) & 0xbfffffffU);
        values.push_back(value);
        corner[axis] = value;
      }
    triangles.push_back(triangle);
  }
  std::istringstream text(written(soup_of(triangles), "", Encoding::ascii));
  std::size_t index = 0;
  for (std::string word; text >> word;) {
    if (word != "vertex") continue;
    for (int axis = 0; axis < 3; ++axis, ++index) {
      text >> word;
      ASSERT_EQ(std::strtof(word.c_str(), nullptr), values.at(index)) << word;
      ASSERT_EQ(std::strtod(word.c_str(), nullptr), static_cast<double>(values.at(index))) << word;
    }
  }
  EXPECT_EQ(index, values.size());
}

TEST_F(StlWriter, triangles_without_area_have_the_zero_normal) {
  std::mt19937 random(3);
  std::vector<TriangleSoup::Triangle> triangles = {{Vec3{}, Vec3{}, Vec3{}},
                                                   {Vec3{1, 2, 3}, Vec3{4, 5, 6}, Vec3{1, 2, 3}}};
  for (int i = 0; i < 2'000; ++i) {
    // p, p + d, p + 7 d in integers of 20 bits: collinear, and below 2^24, so exact as floats.
    const auto next = [&] { return static_cast<double>(random() % (1U << 20U)); };
    const Vec3 p{next(), next(), next()};
    const Vec3 d{next(), next(), next()};
    triangles.push_back({p, p + d, p + 7.0 * d});
  }
  // Twice its area is 16777215 * 16777213 - 16777214^2 = -1, below the rounding error of either product in float.
  triangles.push_back({Vec3{0, 0, 0}, Vec3{16777215, 16777214, 0}, Vec3{16777214, 16777213, 0}});
  written(soup_of(triangles), "", Encoding::binary);
  const auto read = mesh_formats::read_stl_file(folder_.path("out.stl"));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->soup.triangles, triangles);
  for (std::size_t i = 0; i + 1 < triangles.size(); ++i) ASSERT_EQ(read->soup.normals[i], (Vec3{0, 0, 0})) << i;
  EXPECT_EQ(read->soup.normals.back(), (Vec3{0, 0, -1}));
}

TEST_F(StlWriter, coordinates_beyond_float_are_refused_and_the_old_file_stays) {
  folder_.write("out.stl", "old");
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string expected = "; expected a finite number within the range of float";
  expect_error(folder_.path("out.stl"), soup_of({kOne.triangles[0], {Vec3{}, Vec3{0, 1e39, 0}, Vec3{}}}),
               ErrorCode::invalid_value,
               folder_.path("out.stl").string() + ": triangle 2, corner 2: y is 1e+39" + expected);
  expect_error(folder_.path("out.stl"), soup_of({{Vec3{}, Vec3{}, Vec3{0, 0, -infinity}}}), ErrorCode::invalid_value,
               folder_.path("out.stl").string() + ": triangle 1, corner 3: z is -inf" + expected);
  expect_error(folder_.path("out.stl"), soup_of({{Vec3{std::nan(""), 0, 0}, Vec3{}, Vec3{}}}), ErrorCode::invalid_value,
               folder_.path("out.stl").string() + ": triangle 1, corner 1: x is nan" + expected);
  expect_error(folder_.path("out.stl"), soup_of({{Vec3{0x1.ffffffp127, 0, 0}, Vec3{}, Vec3{}}}),
               ErrorCode::invalid_value,
               folder_.path("out.stl").string() + ": triangle 1, corner 1: x is 3.4028235677973366e+38" + expected);
  EXPECT_EQ(folder_.bytes("out.stl"), "old");
}

TEST_F(StlWriter, places_that_cannot_be_written_are_named) {
  folder_.write("file", "x");
  const std::string folder = folder_.path("").string();
  expect_error(folder_.path("none/out.stl"), kOne, ErrorCode::file_missing,
               folder + "none/out.stl: there is no folder '" + folder + "none'");
  expect_error(folder_.path("file/out.stl"), kOne, ErrorCode::file_missing,
               folder + "file/out.stl: '" + folder + "file' is a file, not a folder");
  expect_error(folder_.path(""), kOne, ErrorCode::io_error, folder + ": it is a folder, not a file");
  expect_error("/dev/full", kOne, ErrorCode::io_error, "/dev/full: Not a regular file (but a pipe or device)");
  expect_error("", kOne, ErrorCode::file_missing, "the file name is empty");
}

TEST_F(StlWriter, protected_files_and_folders_are_left_alone) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write every file";
  folder_.write("out.stl", "old");
  std::filesystem::permissions(folder_.path("out.stl"), std::filesystem::perms::owner_read);
  expect_error(folder_.path("out.stl"), kOne, ErrorCode::io_error,
               folder_.path("out.stl").string() + ": there is no permission to write this file");
  EXPECT_EQ(folder_.bytes("out.stl"), "old");
}

// A limit on the size of files stands for a full disk: the write fails half way in the same manner.
TEST_F(StlWriter, a_write_that_fails_half_way_leaves_the_old_file_and_nothing_else) {
  folder_.write("out.stl", "old");
  const TriangleSoup many = soup_of(std::vector<TriangleSoup::Triangle>(50'000, kOne.triangles[0]));
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1'500'000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  expect_error(folder_.path("out.stl"), many, ErrorCode::disk_full,
               folder_.path("out.stl").string() + ": the file would exceed the limit on the size of files");
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(folder_.bytes("out.stl"), "old");
}

TEST_F(StlWriter, a_database_is_never_replaced) {
  std::string bytes("SQLite format 3");
  bytes += std::string(100, '\0');
  folder_.write("parts.db", bytes);
  const auto file = algebra3d::AtomicFile::create(folder_.path("parts.db"));
  ASSERT_FALSE(file.ok());
  EXPECT_EQ(file.error().text(),
            folder_.path("parts.db").string() + ": this file is a database, which no other file may replace");
  EXPECT_EQ(folder_.bytes("parts.db"), bytes);
}

TEST_F(StlWriter, replaces_a_file_behind_a_link_and_keeps_its_permissions) {
  using std::filesystem::perms;
  folder_.write("real.stl", "old");
  const perms mode = perms::owner_read | perms::owner_write | perms::group_read;
  std::filesystem::permissions(folder_.path("real.stl"), mode);
  std::filesystem::create_symlink("real.stl", folder_.path("out.stl"));
  EXPECT_EQ(written({}, "", Encoding::ascii), "solid\nendsolid\n");
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.path("out.stl")));
  EXPECT_EQ(folder_.bytes("real.stl"), "solid\nendsolid\n");
  EXPECT_EQ(std::filesystem::status(folder_.path("real.stl")).permissions(), mode);
  EXPECT_EQ(folder_.file_count(), 2U);
}

TEST_F(StlWriter, a_name_without_folder_means_the_working_directory) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path(""));
  const auto status = write_stl_file(std::filesystem::path("here.stl"), {}, "", Encoding::ascii);
  std::filesystem::current_path(before);
  ASSERT_TRUE(status) << status.error().text();
  EXPECT_EQ(folder_.bytes("here.stl"), "solid\nendsolid\n");
}

}  // namespace
