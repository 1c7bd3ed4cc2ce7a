#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "stl/mapped_file.h"
#include "stl/stl_reader.h"
#include "unit/stl/scratch_folder.h"
#include "unit/stl/stl_bytes.h"

namespace {

using algebra3d::ErrorCode;
using stl::MappedFile;

class MappedFileTest : public ::testing::Test {
 protected:
  void expect_error(const std::filesystem::path& path, ErrorCode code, const std::string& reason) {
    const auto file = MappedFile::open(path);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().message, path.string() + ": " + reason);
    EXPECT_EQ(file.error().code, code);
    const auto read = stl::read_stl_file(path);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message, path.string() + ": " + reason);
    EXPECT_EQ(read.error().code, code);
  }

  ScratchFolder folder_;
};

TEST_F(MappedFileTest, holds_the_bytes_of_the_file_and_moves) {
  const std::string bytes("a\0b", 3);
  folder_.write("a", bytes);
  auto file = MappedFile::open(folder_.path("a"));
  ASSERT_TRUE(file);
  MappedFile moved = *std::move(file);
  EXPECT_EQ(moved.bytes(), bytes);
  folder_.write("b", "other");
  moved = *MappedFile::open(folder_.path("b"));
  EXPECT_EQ(moved.bytes(), "other");
}

TEST_F(MappedFileTest, an_empty_file_is_no_bytes_but_no_stl_file) {
  folder_.write("empty.stl", "");
  const auto file = MappedFile::open(folder_.path("empty.stl"));
  ASSERT_TRUE(file);
  EXPECT_EQ(file->bytes(), "");
  const auto read = stl::read_stl_file(folder_.path("empty.stl"));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, folder_.path("empty.stl").string() + ": empty file; expected an STL file");
}

TEST_F(MappedFileTest, missing_files_and_folders_are_named) {
  folder_.write("file", "x");
  expect_error(folder_.path("none"), ErrorCode::file_missing, "No such file or directory");
  expect_error(folder_.path("none/none"), ErrorCode::file_missing, "No such file or directory");
  expect_error(folder_.path("file/none"), ErrorCode::file_missing, "Not a directory");
  expect_error(folder_.path(std::string(300, 'x')), ErrorCode::io_error, "File name too long");
}

TEST_F(MappedFileTest, folders_pipes_and_devices_are_refused_without_waiting) {
  ASSERT_EQ(::mkfifo(folder_.path("pipe").c_str(), 0600), 0);
  expect_error(folder_.path(""), ErrorCode::io_error, "Is a directory");
  expect_error(folder_.path("pipe"), ErrorCode::io_error, "Not a regular file (but a pipe or device)");
  expect_error("/dev/zero", ErrorCode::io_error, "Not a regular file (but a pipe or device)");
}

TEST_F(MappedFileTest, files_without_permission_are_refused) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read every file";
  folder_.write("secret", "x");
  std::filesystem::permissions(folder_.path("secret"), std::filesystem::perms::none);
  expect_error(folder_.path("secret"), ErrorCode::io_error, "Permission denied");
}

TEST_F(MappedFileTest, files_are_read_from_disk_as_from_memory) {
  folder_.write("a.stl", stl_bytes::kAscii);
  const auto read = stl::read_stl_file(folder_.path("a.stl"));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->soup.triangles.size(), 1U);
}

}  // namespace
