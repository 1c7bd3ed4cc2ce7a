#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "stl/stl_reader.h"

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

// The rows of MANIFEST.csv, whose counts come from another reader, as maps from column to field.
std::vector<std::map<std::string, std::string>> manifest(const std::filesystem::path& folder) {
  std::ifstream file(folder / "MANIFEST.csv");
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> columns = split(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = split(line);
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < fields.size() && i < columns.size(); ++i) row[columns[i]] = fields[i];
  }
  return rows;
}

TEST(StlCorpus, every_file_has_the_format_and_triangle_count_of_the_manifest) {
  const char* folder = std::getenv("ALGEBRA3D_CORPUS");
  if (folder == nullptr) GTEST_SKIP() << "ALGEBRA3D_CORPUS is not set: no folder of real files to read";
  std::size_t file_count = 0;
  for (auto& row : manifest(folder)) {
    if (!row["fmt"].starts_with("stl_")) continue;
    SCOPED_TRACE(row["file"]);
    ++file_count;
    const auto read = stl::read_stl_file(std::filesystem::path(folder) / row["file"]);
    if (row["class"].starts_with("malformed") && !read) {
      EXPECT_NE(read.error().message.find(" byte "), std::string::npos) << read.error().message;
      continue;
    }
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->format, row["fmt"] == "stl_bin" ? stl::Format::binary : stl::Format::ascii);
    EXPECT_EQ(std::to_string(read->soup.triangles.size()), row["triangles"]);
    EXPECT_EQ(read->solid_count > 1, row["fmtflags"].find("multi_solid") != std::string::npos);
  }
  EXPECT_GT(file_count, 0U) << "no STL file in the manifest of " << folder;
}

}  // namespace
