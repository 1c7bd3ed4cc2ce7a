#include "queries/shell/detail/terminal_output.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace queries {
namespace {

/// A terminal of 5 rows of 10 columns whose pager writes to a file.
class TerminalOutputTest : public testing::Test {
 protected:
  TerminalOutputTest() {
    std::string name = testing::TempDir() + "pager-XXXXXX";
    folder_ = mkdtemp(name.data());
  }
  ~TerminalOutputTest() override { std::filesystem::remove_all(folder_); }

  std::string paged_file() const { return (folder_ / "paged").string(); }
  std::string paged() const {
    std::ostringstream text;
    text << std::ifstream(paged_file()).rdbuf();
    return text.str();
  }
  TerminalOutput::Settings settings(const std::string& pager) const {
    TerminalOutput::Settings settings;
    settings.pager = pager;
    settings.screen = [] { return ScreenSize{10, 5}; };
    return settings;
  }
  TerminalOutput::Settings settings() const { return settings("cat > '" + paged_file() + "'"); }

  std::filesystem::path folder_;
  std::ostringstream terminal_;
};

TEST_F(TerminalOutputTest, what_fits_on_the_screen_is_printed_when_the_statement_ends) {
  TerminalOutput output(terminal_, settings());
  std::ostream out(&output);
  output.begin_statement("", true);
  out << "1\n2\n3\n4\n" << std::flush;
  EXPECT_EQ(terminal_.str(), "");
  output.end_statement();
  EXPECT_EQ(terminal_.str(), "1\n2\n3\n4\n");
  EXPECT_FALSE(std::filesystem::exists(paged_file()));
}

// The characters from U+0080 to U+009F have two bytes, which may come one by one.
TEST_F(TerminalOutputTest, values_do_not_control_the_terminal) {
  TerminalOutput output(terminal_, settings());
  std::ostream out(&output);
  output.begin_statement("", true);
  out << "a\x1b[2Jb\u009bc\u00e9\n\xC2"
      << "\x9b" << '\xC2' << '\x9b' << "\xC2"
      << "\xA0\td";
  output.end_statement();
  EXPECT_EQ(terminal_.str(), "a\\x1b[2Jb\\x9bc\u00e9\n\\x9b\\x9b\u00a0\td");
}

TEST_F(TerminalOutputTest, what_is_longer_goes_through_the_pager_from_its_first_line) {
  TerminalOutput output(terminal_, settings());
  std::ostream out(&output);
  output.begin_statement("", true);
  for (int i = 1; i <= 6; ++i) out << i << "\n";
  output.end_statement();
  EXPECT_EQ(terminal_.str(), "");
  EXPECT_EQ(paged(), "1\n2\n3\n4\n5\n6\n");
  out << "after" << std::flush;
  EXPECT_EQ(terminal_.str(), "after");
}

TEST_F(TerminalOutputTest, a_long_line_counts_as_the_rows_that_it_takes) {
  TerminalOutput output(terminal_, settings());
  std::ostream out(&output);
  output.begin_statement("", true);
  out << std::string(60, 'x') << "\n";
  output.end_statement();
  EXPECT_EQ(paged(), std::string(60, 'x') + "\n");
}

TEST_F(TerminalOutputTest, without_a_pager_or_if_it_is_not_wanted_all_is_printed) {
  for (const bool is_wanted : {false, true}) {
    terminal_.str("");
    TerminalOutput output(terminal_, is_wanted ? settings("") : settings());
    std::ostream out(&output);
    output.begin_statement("", is_wanted);
    for (int i = 1; i <= 9; ++i) out << i << "\n";
    output.end_statement();
    EXPECT_EQ(terminal_.str(), "1\n2\n3\n4\n5\n6\n7\n8\n9\n");
  }
  EXPECT_FALSE(std::filesystem::exists(paged_file()));
}

TEST_F(TerminalOutputTest, the_stream_fails_once_the_pager_was_left_and_serves_the_next_statement) {
  TerminalOutput output(terminal_, settings("exec true"));
  std::ostream out(&output);
  output.begin_statement("", true);
  const std::string line = std::string(1000, 'x') + "\n";
  for (int i = 0; i < 10000 && out; ++i) out << line;
  EXPECT_FALSE(out);
  output.end_statement();
  out.clear();
  output.begin_statement("", true);
  out << "short\n";
  output.end_statement();
  EXPECT_EQ(terminal_.str(), "short\n");
}

TEST(ProgressLine, says_what_runs_and_is_erased) {
  std::ostringstream stream;
  {
    ProgressLine line(stream, "query Parts feed count", std::chrono::milliseconds(0));
    line.stop();
    line.stop();
  }
  if (!stream.str().empty()) {  // unless the statement has ended before the first line
    EXPECT_TRUE(stream.str().starts_with("\rquery Parts feed count: running for 0 s, Ctrl-C ends it\x1b[K"));
    EXPECT_TRUE(stream.str().ends_with("\r\x1b[K"));
  }
}

TEST(ProgressLine, nothing_is_written_before_the_delay) {
  std::ostringstream stream;
  { const ProgressLine line(stream, "query 1", std::chrono::hours(1)); }
  EXPECT_EQ(stream.str(), "");
}

TEST(ProgressText, fits_the_columns_and_shows_minutes_and_hours) {
  using std::chrono::seconds;
  EXPECT_EQ(progress_text("query 1", "", seconds(75), 80), "query 1: running for 1:15 min, Ctrl-C ends it");
  EXPECT_EQ(progress_text("query 1", "", seconds(3661), 80), "query 1: running for 1:01:01 h, Ctrl-C ends it");
  EXPECT_EQ(progress_text("query\n1", "", seconds(2), 80), "query...: running for 2 s, Ctrl-C ends it");
  EXPECT_LT(progress_text(std::string(100, 'x'), "", seconds(2), 60).size(), 60U);
}

TEST(ProgressText, says_how_far_the_statement_is_if_there_is_room) {
  using std::chrono::seconds;
  EXPECT_EQ(progress_text("check database", "42 % (Parts)", seconds(12), 80),
            "check database: 42 % (Parts), running for 12 s, Ctrl-C ends it");
  EXPECT_EQ(progress_text("check database", "42 % (Parts)", seconds(12), 60),
            "check database: running for 12 s, Ctrl-C ends it");
  EXPECT_EQ(progress_text("check database", "42 % (" + std::string(60, 'P') + ")", seconds(12), 200),
            "check database: running for 12 s, Ctrl-C ends it");
}

TEST(Printable, control_characters_are_made_visible) {
  EXPECT_EQ(printable("a\x1b[2Jb\n\tc\x7F"), "a\\x1b[2Jb\n\tc\\x7f");
  EXPECT_EQ(printable("\xC2\x9B"
                      "2J \xC3\xA4"),
            "\\x9b2J \xC3\xA4");
}

}  // namespace
}  // namespace queries
