#include "base/temporary_folder.h"

#include <optional>
#include <utility>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/scratch_folder.h"

namespace algebra3d {
namespace {

namespace fs = std::filesystem;

void fill(const TemporaryFolder& folder) {
  fs::create_directories(folder.path() / "sub");
  std::ofstream(folder.path() / "sub" / "file") << "content";
}

/// Makes a folder in a process that ends without removing it.
void leave_behind(const fs::path& parent) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const auto folder = TemporaryFolder::make(parent);
    if (folder) fill(*folder);
    ::_exit(folder ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
}

TEST(TemporaryFolder, IsEmptyAndGoesWithItsContent) {
  const ScratchFolder scratch;
  {
    const auto made = TemporaryFolder::make(scratch.path(""));
    ASSERT_TRUE(made.ok()) << made.error().text();
    EXPECT_TRUE(fs::is_empty(made->path()));
    fill(*made);
    EXPECT_EQ(scratch.file_count(), 1U);
  }
  EXPECT_EQ(scratch.file_count(), 0U);
}

TEST(TemporaryFolder, MovesWithItsOwner) {
  const ScratchFolder scratch;
  std::optional<TemporaryFolder> first = *TemporaryFolder::make(scratch.path(""));
  TemporaryFolder second = *TemporaryFolder::make(scratch.path(""));
  const fs::path kept = first->path();
  second = *std::move(first);
  first.reset();
  EXPECT_EQ(second.path(), kept);
  EXPECT_TRUE(fs::is_directory(kept));
  EXPECT_EQ(scratch.file_count(), 1U);
}

TEST(TemporaryFolder, KeptOnesStay) {
  const ScratchFolder scratch;
  fs::path kept;
  {
    TemporaryFolder folder = *TemporaryFolder::make(scratch.path(""));
    fill(folder);
    folder.keep();
    kept = folder.path();
  }
  TemporaryFolder::remove_leftovers(scratch.path(""));
  EXPECT_TRUE(fs::exists(kept / "sub" / "file"));
}

TEST(TemporaryFolder, LeftoversOfDeadProcessesAreRemoved) {
  const ScratchFolder scratch;
  leave_behind(scratch.path(""));
  leave_behind(scratch.path(""));
  // The second process has removed what the first one left.
  EXPECT_EQ(scratch.file_count(), 1U);
  const auto living = TemporaryFolder::make(scratch.path(""));
  EXPECT_EQ(scratch.file_count(), 1U);
  EXPECT_TRUE(fs::is_directory(living->path()));
}

TEST(TemporaryFolder, FoldersOfLivingOwnersAndOfOthersStay) {
  const ScratchFolder scratch;
  const auto living = TemporaryFolder::make(scratch.path(""));
  fill(*living);
  // Names like ours, of somebody else.
  fs::create_directories(scratch.path("algebra3d-backup/files"));
  fs::create_directories(scratch.path("algebra3d-server-abcdef"));
  scratch.write("algebra3d-abcdef", "a file");
  fs::create_directory_symlink(living->path(), scratch.path("algebra3d-symlnk"));
  const std::size_t before = scratch.file_count();
  TemporaryFolder::remove_leftovers(scratch.path(""));
  EXPECT_EQ(scratch.file_count(), before);
  EXPECT_TRUE(fs::exists(living->path() / "sub" / "file"));
  EXPECT_TRUE(fs::exists(scratch.path("algebra3d-backup/files")));
}

TEST(TemporaryFolder, WithoutAParentIsAnError) {
  const ScratchFolder scratch;
  const auto made = TemporaryFolder::make(scratch.path("missing"));
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().code, ErrorCode::io_error);
  EXPECT_NE(made.error().text().find("missing/algebra3d-"), std::string::npos) << made.error().text();
}

}  // namespace
}  // namespace algebra3d
