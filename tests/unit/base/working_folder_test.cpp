#include "algebra3d/base/working_folder.h"

#include <gtest/gtest.h>

#include "support/scratch_folder.h"

namespace algebra3d {
namespace {

TEST(WorkingFolder, NamesLeadAnywhereUnlessConfined) {
  EXPECT_EQ(*WorkingFolder("a").path_of("b"), "a/b");
  EXPECT_EQ(*WorkingFolder("a").path_of("../b"), "a/../b");
  EXPECT_EQ(*WorkingFolder("a").path_of("/b"), "/b");
}

TEST(WorkingFolder, ConfinedNamesStay) {
  const ScratchFolder scratch;
  std::filesystem::create_directories(scratch.path("in/sub"));
  std::filesystem::create_directories(scratch.path("in2"));
  std::filesystem::create_directories(scratch.path("up"));
  std::filesystem::create_symlink(scratch.path(""), scratch.path("in/out"));
  std::filesystem::create_symlink("sub", scratch.path("in/link"));
  std::filesystem::create_symlink(scratch.path("nothing"), scratch.path("in/dangling"));
  const WorkingFolder folder = WorkingFolder::confined(scratch.path("in"), scratch.path("up"));
  for (const char* name : {"a", "sub/a", "link/a", "", ".", "uploads.stl"}) {
    ASSERT_TRUE(folder.path_of(name).ok()) << name;
    EXPECT_EQ(*folder.path_of(name), scratch.path("in") / name);
  }
  EXPECT_EQ(*folder.path_of("uploads/a"), scratch.path("up") / "a");
  for (const char* name :
       {"..", "../in2/a", "sub/../a", "/etc/passwd", "out/a", "out", "dangling", "uploads/../a", "uploads/../../a"}) {
    const auto path = folder.path_of(name);
    ASSERT_FALSE(path.ok()) << name;
    EXPECT_EQ(path.error().code, ErrorCode::permission_denied) << name;
  }
}

}  // namespace
}  // namespace algebra3d
