#include "base/working_folder.h"

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
  const WorkingFolder folder =
      WorkingFolder::confined(scratch.path("in"), scratch.path("up"), WorkingFolder::Writing::new_files);
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

TEST(WorkingFolder, ConfinedNamesWithoutAFolderAreRelativeToTheProcess) {
  const WorkingFolder folder = WorkingFolder::confined({}, {}, WorkingFolder::Writing::new_files);
  EXPECT_EQ(*folder.path_of("no such file"), "no such file");
  EXPECT_EQ(*folder.path_of("no such/file"), "no such/file");
  EXPECT_FALSE(folder.path_of("/tmp/a").ok());
}

TEST(WorkingFolder, HiddenFilesAreSeenOnlyIfNotConfined) {
  const ScratchFolder scratch;
  std::filesystem::create_directories(scratch.path(".git"));
  scratch.write(".git/config", "secret");
  const WorkingFolder free(scratch.path(""));
  const WorkingFolder confined =
      WorkingFolder::confined(scratch.path(""), scratch.path(""), WorkingFolder::Writing::new_files);
  for (const char* name : {".git", ".git/config", "./.git/config", "sub/.hidden", "...", "uploads/.part1"}) {
    EXPECT_TRUE(free.path_of(name).ok()) << name;
    EXPECT_FALSE(free.hides(name)) << name;
    EXPECT_TRUE(confined.hides(name)) << name;
    for (const Error& error : {confined.path_of(name).error(), confined.output_path_of(name).error()}) {
      EXPECT_EQ(error.code, ErrorCode::permission_denied) << name;
      EXPECT_NE(error.text().find("hidden"), std::string::npos) << error.text();
    }
  }
  for (const char* name : {".", "./a", "a.stl", "sub/a."}) EXPECT_TRUE(confined.path_of(name).ok()) << name;
}

TEST(WorkingFolder, WritesOnlyWhatItMay) {
  const ScratchFolder scratch;
  scratch.write("there", "kept");
  const auto confined = [&](WorkingFolder::Writing writing) {
    return WorkingFolder::confined(scratch.path(""), {}, writing);
  };
  const WorkingFolder free(scratch.path(""));
  EXPECT_TRUE(free.output_path_of("there")->may_replace());
  const WorkingFolder adding = confined(WorkingFolder::Writing::new_files);
  ASSERT_TRUE(adding.output_path_of("new").ok());
  EXPECT_FALSE(adding.output_path_of("new")->may_replace());
  EXPECT_EQ(adding.output_path_of("new")->path(), scratch.path("new"));
  EXPECT_EQ(adding.output_path_of("there").error().text(),
            "'there' exists, and no file is replaced here; choose another name");
  const WorkingFolder reading = confined(WorkingFolder::Writing::none);
  EXPECT_TRUE(reading.path_of("there").ok());
  for (const char* name : {"new", "there"}) {
    EXPECT_EQ(reading.output_path_of(name).error().code, ErrorCode::permission_denied);
    EXPECT_NE(reading.output_path_of(name).error().text().find("only read"), std::string::npos);
  }
}

TEST(WorkingFolder, MessagesNameUploadsAsStatementsDo) {
  const WorkingFolder folder = WorkingFolder::confined({}, "/var/tmp/x/files", WorkingFolder::Writing::none);
  EXPECT_EQ(folder.with_names("/var/tmp/x/files/a.stl: bad; see '/var/tmp/x/files/a.stl'"),
            "uploads/a.stl: bad; see 'uploads/a.stl'");
  EXPECT_EQ(WorkingFolder("/a").with_names("/a/b"), "/a/b");
}

}  // namespace
}  // namespace algebra3d
