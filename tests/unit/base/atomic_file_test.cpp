// AtomicFile with files that must be new; what it does to files that it replaces is tested by the writers of mesh
// files.
#include "base/atomic_file.h"

#include <atomic>
#include <utility>

#include <gtest/gtest.h>

#include "base/propagate.h"
#include "support/scratch_folder.h"

namespace algebra3d {
namespace {

Status write_new(const ScratchFolder& scratch, const char* name, std::string_view bytes) {
  A3D_ASSIGN(AtomicFile file, AtomicFile::create(OutputPath::new_file(scratch.path(name))));
  A3D_TRY(file.append(bytes));
  return file.commit();
}

TEST(AtomicFile, ANewFileIsWritten) {
  const ScratchFolder scratch;
  EXPECT_TRUE(write_new(scratch, "new", "bytes").ok());
  EXPECT_EQ(scratch.bytes("new"), "bytes");
  EXPECT_EQ(scratch.file_count(), 1U);
}

TEST(AtomicFile, WhatIsThereStaysIfTheFileMustBeNew) {
  const ScratchFolder scratch;
  scratch.write("there", "kept");
  std::filesystem::create_symlink("there", scratch.path("link"));
  std::filesystem::create_symlink("nowhere", scratch.path("dangling"));
  std::filesystem::create_directory(scratch.path("folder"));
  const std::size_t before = scratch.file_count();
  for (const char* name : {"there", "link", "dangling", "folder"}) {
    const Status status = write_new(scratch, name, "bytes");
    ASSERT_FALSE(status.ok()) << name;
    EXPECT_EQ(status.error().code, ErrorCode::permission_denied) << name;
  }
  EXPECT_EQ(scratch.bytes("there"), "kept");
  EXPECT_EQ(scratch.file_count(), before);
}

TEST(AtomicFile, OfTwoNewFilesOfOneNameTheFirstWins) {
  const ScratchFolder scratch;
  const OutputPath path = OutputPath::new_file(scratch.path("new"));
  auto first = AtomicFile::create(path);
  {
    auto second = AtomicFile::create(path);
    ASSERT_TRUE(first.ok() && second.ok());
    ASSERT_TRUE(first->append("first").ok() && second->append("second").ok());
    EXPECT_TRUE(first->commit().ok());
    const Status late = second->commit();
    ASSERT_FALSE(late.ok());
    EXPECT_EQ(late.error().code, ErrorCode::permission_denied);
  }
  EXPECT_EQ(scratch.bytes("new"), "first");
  EXPECT_EQ(scratch.file_count(), 1U);
}

TEST(AtomicFile, EndsWhenTheWritingIsCancelled) {
  const ScratchFolder scratch;
  scratch.write("there", "kept");
  std::atomic<bool> cancel = false;
  {
    auto file = AtomicFile::create(OutputPath(scratch.path("there")).with_cancel(&cancel));
    ASSERT_TRUE(file.ok());
    EXPECT_TRUE(file->append("a few bytes").ok());
    cancel = true;
    // Noticed when the buffer is written, at the end at the latest.
    const Status status = file->commit();
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::interrupted);
  }
  EXPECT_EQ(scratch.bytes("there"), "kept");
  EXPECT_EQ(scratch.file_count(), 1U);
}

}  // namespace
}  // namespace algebra3d
