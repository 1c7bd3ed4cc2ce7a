#include "queries/importer/detail/import_summary.h"

#include <gtest/gtest.h>

#include "base/progress_display.h"
#include "queries/importer/detail/import_progress.h"

namespace queries {
namespace {

using algebra3d::grouped;

std::vector<std::string> kinds_of(const std::string& status) {
  LoadedFile file;
  file.path = "/some/folder/part7.stl";
  file.status = status;
  return reason_kinds(file);
}

TEST(ImportSummary, files_with_the_same_trouble_share_a_kind) {
  EXPECT_EQ(kinds_of("no valid solid: 12 boundary edges (triangle 17, near (0 0.5 1))"),
            std::vector<std::string>{"boundary edges"});
  EXPECT_EQ(
      kinds_of(
          "no valid solid: 1 boundary edge (triangle 17, near (0 0.5 1)), at least 3 intersecting pairs (triangles "
          "4 and 9, near (2 0 0)), 1 shell with a wrong winding number (triangle 1, near (0 0 0))"),
      (std::vector<std::string>{"boundary edges", "intersecting pairs", "shells with a wrong winding number"}));
  EXPECT_EQ(kinds_of("part7.stl: byte 84: header announces 12 triangles"),
            std::vector<std::string>{"FILE: byte N: header announces N triangles"});
  EXPECT_EQ(kinds_of("wrong count: header announces 24 triangles, file has 12, and may be cut short"),
            std::vector<std::string>{"wrong counts of triangles in the header"});
  EXPECT_EQ(kinds_of("no valid solid: 12 boundary edges (triangle 17, near (0 0.5 1)); wrong count: header announces 0 "
                     "triangles, file has 7"),
            (std::vector<std::string>{"boundary edges", "wrong counts of triangles in the header"}));
  EXPECT_EQ(kinds_of("/some/folder/part7.stl: Permission denied"), std::vector<std::string>{"FILE: Permission denied"});
}

TEST(ImportSummary, a_long_reason_is_cut_between_characters) {
  std::string reason(71, 'x');
  reason += "\xC3\xA9 and more";
  EXPECT_EQ(kinds_of(reason), std::vector<std::string>{std::string(71, 'x') + "..."});
}

TEST(ImportSummary, numbers_are_grouped) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
}

TEST(ImportSummary, the_table_counts_what_was_counted) {
  ImportSummary summary;
  summary.file_count = 4;
  LoadedFile solid;
  solid.solid = algebra3d::Volume3d();
  LoadedFile bad;
  bad.status = "no valid solid: 2 boundary edges (triangle 1, near (0 0 0))";
  solid.status = "ok; wrong count: header announces 24 triangles, file has 12, and may be cut short";
  summary.count(solid, RelationWriter::Written::inserted);
  summary.count(bad, RelationWriter::Written::replaced);
  summary.count(solid, RelationWriter::Written::known);
  const std::string table = summary_table(summary, "Parts", 1);
  EXPECT_NE(table.find("import into Parts\n"), std::string::npos) << table;
  for (const char* row :
       {"files                                    3\n", "  not reached                            1\n",
        "  imported before                        1\n", "  solids                                 1\n",
        "  with a wrong count                     1\n", "  undefined                              1\n",
        "  of these replaced                      1\n", "         1  boundary edges\n"})
    EXPECT_NE(table.find(row), std::string::npos) << row << table;
}

std::string line_of(const ImportSummary& summary, std::uint64_t pending_count) {
  return algebra3d::progress_line(done_part(summary), progress_text(summary, pending_count));
}

TEST(ProgressLine, shows_the_share_of_bytes) {
  ImportSummary summary;
  summary.file_count = 2;
  summary.byte_count = 100;
  EXPECT_TRUE(line_of(summary, 0).starts_with("[          ] 0/2 files")) << line_of(summary, 0);
  summary.done_bytes = 50;
  summary.inserted_count = 1;
  EXPECT_TRUE(line_of(summary, 1).starts_with("[#####     ] 1/2 files")) << line_of(summary, 1);
  summary.done_bytes = 120;  // a file has grown since it was listed
  EXPECT_TRUE(line_of(summary, 1).starts_with("[##########] ")) << line_of(summary, 1);
}

TEST(ProgressLine, fits_into_a_terminal_of_eighty_columns) {
  ImportSummary summary;
  summary.file_count = summary.inserted_count = summary.undefined_count = 10000;
  EXPECT_LE(line_of(summary, 10000).size(), 80);
}

}  // namespace
}  // namespace queries
