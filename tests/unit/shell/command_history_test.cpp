#include "queries/shell/detail/command_history.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <fstream>

namespace queries {
namespace {

class CommandHistoryTest : public testing::Test {
 protected:
  CommandHistoryTest() {
    std::string name = testing::TempDir() + "history-XXXXXX";
    folder_ = mkdtemp(name.data());
    file_ = folder_ / "algebra3d/history";
  }
  ~CommandHistoryTest() override { std::filesystem::remove_all(folder_); }

  static unsigned mode(const std::filesystem::path& path) {
    struct stat info {};
    EXPECT_EQ(stat(path.c_str(), &info), 0);
    return info.st_mode & 0777U;
  }

  std::filesystem::path folder_;
  std::filesystem::path file_;
};

using Entries = std::vector<std::string>;

TEST_F(CommandHistoryTest, entries_come_back_in_order_and_with_their_lines) {
  const Entries typed = {"query 1;", "query\n  2;", "query \"a\\nb\\\\\";"};
  {
    CommandHistory history(file_);
    for (const std::string& entry : typed) EXPECT_TRUE(history.add(entry));
  }
  EXPECT_EQ(CommandHistory(file_).entries(), typed);
}

TEST_F(CommandHistoryTest, file_and_folder_are_for_their_owner_alone) {
  CommandHistory(file_).add("query 1;");
  EXPECT_EQ(mode(file_), 0600U);
  EXPECT_EQ(mode(file_.parent_path()), 0700U);
}

TEST_F(CommandHistoryTest, blank_and_repeated_commands_are_no_entries) {
  CommandHistory history(file_);
  EXPECT_TRUE(history.add("query 1;"));
  EXPECT_FALSE(history.add("query 1;"));
  EXPECT_FALSE(history.add(" \n "));
  EXPECT_EQ(history.entries(), (Entries{"query 1;"}));
}

TEST_F(CommandHistoryTest, sessions_side_by_side_keep_what_both_have_typed) {
  CommandHistory first(file_);
  CommandHistory second(file_);
  first.add("a");
  second.add("b");
  first.add("c");
  EXPECT_EQ(CommandHistory(file_).entries(), (Entries{"a", "b", "c"}));
}

TEST_F(CommandHistoryTest, a_long_file_is_shortened_to_the_newest_entries) {
  std::filesystem::create_directories(file_.parent_path());
  std::ofstream output(file_);
  for (std::size_t i = 0; i < 2 * CommandHistory::kMostEntries; ++i) output << i << "\n";
  output.close();
  const CommandHistory history(file_);
  EXPECT_EQ(history.entries().size(), CommandHistory::kMostEntries);
  EXPECT_EQ(history.entries().front(), std::to_string(CommandHistory::kMostEntries));
  EXPECT_EQ(CommandHistory(file_).entries(), history.entries());
  EXPECT_EQ(mode(file_), 0600U);
}

TEST_F(CommandHistoryTest, a_file_that_cannot_be_written_costs_the_history_only) {
  CommandHistory history("/proc/no/such/folder/history");
  EXPECT_TRUE(history.add("query 1;"));
  EXPECT_EQ(history.entries(), (Entries{"query 1;"}));
}

TEST_F(CommandHistoryTest, the_file_lies_where_programs_keep_their_state) {
  setenv("XDG_STATE_HOME", "/state", 1);
  EXPECT_EQ(history_file(), "/state/algebra3d/history");
  unsetenv("XDG_STATE_HOME");
  setenv("HOME", "/home/a", 1);
  EXPECT_EQ(history_file(), "/home/a/.local/state/algebra3d/history");
}

}  // namespace
}  // namespace queries
