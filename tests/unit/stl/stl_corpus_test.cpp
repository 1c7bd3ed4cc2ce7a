#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "stl/stl_reader.h"
#include "unit/stl/corpus_manifest.h"

namespace {

TEST(StlCorpus, every_file_has_the_format_and_triangle_count_of_the_manifest) {
  const char* folder = std::getenv("ALGEBRA3D_CORPUS");
  if (folder == nullptr) GTEST_SKIP() << "ALGEBRA3D_CORPUS is not set: no folder of real files to read";
  std::size_t file_count = 0;
  for (auto& row : corpus_manifest(folder)) {
    if (!row["fmt"].starts_with("stl_")) continue;
    SCOPED_TRACE(row["file"]);
    ++file_count;
    const auto read = mesh_formats::read_stl_file(std::filesystem::path(folder) / row["file"]);
    if (row["class"].starts_with("malformed") && !read) {
      EXPECT_NE(read.error().text().find(" byte "), std::string::npos) << read.error().text();
      continue;
    }
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->format, row["fmt"] == "stl_bin" ? mesh_formats::Encoding::binary : mesh_formats::Encoding::ascii);
    EXPECT_EQ(std::to_string(read->soup.triangles.size()), row["triangles"]);
    EXPECT_EQ(read->solid_count > 1, row["fmtflags"].find("multi_solid") != std::string::npos);
  }
  EXPECT_GT(file_count, 0U) << "no STL file in the manifest of " << folder;
}

}  // namespace
