#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file_content.h"
#include "mesh_formats/unwritten_file.h"
#include "stl/stl_reader.h"
#include "support/scratch_folder.h"
#include "unit/stl/stl_bytes.h"

namespace {

using algebra3d::ErrorCode;
using algebra3d::FileContent;

class FileContentTest : public ::testing::Test {
 protected:
  void expect_error(const std::filesystem::path& path, ErrorCode code, const std::string& reason) {
    const auto file = FileContent::read(path);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().text(), path.string() + ": " + reason);
    EXPECT_EQ(file.error().code, code);
    const auto read = mesh_formats::read_stl_file(path);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().text(), path.string() + ": " + reason);
    EXPECT_EQ(read.error().code, code);
  }

  ScratchFolder folder_;
};

TEST_F(FileContentTest, holds_the_bytes_of_the_file_and_moves) {
  const std::string bytes("a\0b", 3);
  folder_.write("a", bytes);
  auto file = FileContent::read(folder_.path("a"));
  ASSERT_TRUE(file);
  FileContent moved = *std::move(file);
  EXPECT_EQ(moved.bytes(), bytes);
  folder_.write("b", "other");
  moved = *FileContent::read(folder_.path("b"));
  EXPECT_EQ(moved.bytes(), "other");
}

TEST_F(FileContentTest, an_empty_file_is_no_bytes_but_no_stl_file) {
  folder_.write("empty.stl", "");
  const auto file = FileContent::read(folder_.path("empty.stl"));
  ASSERT_TRUE(file);
  EXPECT_EQ(file->bytes(), "");
  const auto read = mesh_formats::read_stl_file(folder_.path("empty.stl"));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().text(), folder_.path("empty.stl").string() + ": empty file; expected an STL file");
}

TEST_F(FileContentTest, missing_files_and_folders_are_named) {
  folder_.write("file", "x");
  expect_error(folder_.path("none"), ErrorCode::file_missing, "No such file or directory");
  expect_error(folder_.path("none/none"), ErrorCode::file_missing, "No such file or directory");
  expect_error(folder_.path("file/none"), ErrorCode::file_missing, "Not a directory");
  expect_error(folder_.path(std::string(300, 'x')), ErrorCode::file_missing, "File name too long");
}

TEST_F(FileContentTest, folders_pipes_and_devices_are_refused_without_waiting) {
  ASSERT_EQ(::mkfifo(folder_.path("pipe").c_str(), 0600), 0);
  expect_error(folder_.path(""), ErrorCode::file_missing, "Is a directory");
  expect_error(folder_.path("pipe"), ErrorCode::file_missing, "Not a regular file (but a pipe or device)");
  expect_error("/dev/zero", ErrorCode::file_missing, "Not a regular file (but a pipe or device)");
}

TEST_F(FileContentTest, files_without_permission_are_refused) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read every file";
  folder_.write("secret", "x");
  std::filesystem::permissions(folder_.path("secret"), std::filesystem::perms::none);
  expect_error(folder_.path("secret"), ErrorCode::file_missing, "Permission denied");
}

TEST_F(FileContentTest, large_files_go_through_a_temporary_file) {
  std::string bytes(5'000'003, 'x');
  bytes.back() = 'y';
  folder_.write("a", bytes);
  const auto file = algebra3d::InputFile::open(folder_.path("a"));
  ASSERT_TRUE(file);
  auto content = FileContent::read(*file, nullptr, 1000);
  ASSERT_TRUE(content) << content.error().text();
  folder_.write("a", "changed afterwards");
  EXPECT_EQ(content->bytes(), bytes);
  EXPECT_EQ(folder_.file_count(), 1U);
}

TEST_F(FileContentTest, reading_is_interrupted) {
  folder_.write("a", "x");
  const std::atomic<bool> cancel = true;
  const auto content = FileContent::read(folder_.path("a"), &cancel);
  ASSERT_FALSE(content);
  EXPECT_EQ(content.error().code, ErrorCode::interrupted);
}

/// What a reader says of a file of 9 MB after `change` was done to it while it was read.
std::string reason_after(const ScratchFolder& folder, const std::function<void(const std::filesystem::path&)>& change) {
  folder.write("a", std::string(9'000'000, 'x'));
  const auto file = algebra3d::InputFile::open(folder.path("a"));
  if (!file) return "not opened";
  bool is_changed = false;
  const auto status = file->for_each_block(nullptr, [&](std::string_view) {
    if (!std::exchange(is_changed, true)) change(folder.path("a"));
    return algebra3d::Status();
  });
  if (status) return "no error";
  EXPECT_EQ(status.error().code, ErrorCode::io_error);
  return status.error().text().substr(folder.path("a").string().size());
}

TEST_F(FileContentTest, a_file_that_changes_while_it_is_read_is_an_error) {
  const std::string was_changed = ": the file was changed while it was read: ";
  EXPECT_EQ(reason_after(folder_, [](const auto& path) { std::filesystem::resize_file(path, 100); }),
            was_changed + "it had 9000000 bytes, and has 100 now");
  EXPECT_EQ(reason_after(folder_, [](const auto& path) { std::ofstream(path, std::ios::app) << "y"; }),
            was_changed + "it had 9000000 bytes, and has 9000001 now");
  EXPECT_EQ(reason_after(folder_,
                         [](const auto& path) {
                           std::fstream(path, std::ios::in | std::ios::out) << "y";
                           std::filesystem::last_write_time(path, {});  // the clock of files has a coarse step
                         }),
            was_changed + "another process wrote to it");
  EXPECT_EQ(reason_after(folder_, [](const auto& path) { std::filesystem::remove(path); }), "no error");
}

TEST_F(FileContentTest, what_was_never_written_is_counted_and_refused) {
  folder_.write("a.stl", stl_bytes::header("", 2) + stl_bytes::facets(2));
  const auto whole = algebra3d::InputFile::open(folder_.path("a.stl"));
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->hole_bytes(1000), 0U);
  EXPECT_TRUE(mesh_formats::refuse_unwritten(*whole));
  std::filesystem::resize_file(folder_.path("a.stl"), std::uintmax_t{1} << 40);
  const auto sparse = algebra3d::InputFile::open(folder_.path("a.stl"));
  ASSERT_TRUE(sparse);
  if (sparse->hole_bytes(1) == 0) GTEST_SKIP() << "the file system does not tell holes";
  const auto refused = mesh_formats::refuse_unwritten(*sparse);
  ASSERT_FALSE(refused);
  EXPECT_TRUE(refused.error().text().starts_with(
      folder_.path("a.stl").string() +
      ": header announces 2 triangles (184 bytes), file has 1099511627776 bytes, of which "))
      << refused.error().text();
}

TEST_F(FileContentTest, files_are_read_from_disk_as_from_memory) {
  folder_.write("a.stl", stl_bytes::kAscii);
  const auto read = mesh_formats::read_stl_file(folder_.path("a.stl"));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->soup.triangles.size(), 1U);
}

}  // namespace
