#include "base/detail/database_part.h"

#include <array>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include <fmt/core.h>

#include "base/open_databases.h"

namespace algebra3d {
namespace {

namespace fs = std::filesystem;

// The beginnings of SQLite's files: https://www.sqlite.org/fileformat.html, sections 1.3, 3 and 4.1, and
// https://www.sqlite.org/walformat.html, section 2.1.
constexpr std::string_view kDatabase("SQLite format 3\0", 16);
constexpr std::array<std::string_view, 2> kLogs = {std::string_view("\x37\x7f\x06\x82", 4),
                                                   std::string_view("\x37\x7f\x06\x83", 4)};
constexpr std::string_view kJournal("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);
constexpr std::uint32_t kLogIndexVersion = 3007000;
constexpr std::size_t kLogIndexHeader = 48;  // bytes, and then the same again

std::string first_bytes(const fs::path& file) {
  std::string bytes(2 * kLogIndexHeader, '\0');
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return {};
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

bool is_database(const fs::path& file) {
  return open_database_with(file) || first_bytes(file).starts_with(kDatabase);
}

bool is_log_index(std::string_view bytes) {
  if (bytes.size() < 2 * kLogIndexHeader) return false;
  std::uint32_t version = 0;
  std::memcpy(&version, bytes.data(), sizeof version);
  return version == kLogIndexVersion &&
         bytes.substr(0, kLogIndexHeader) == bytes.substr(kLogIndexHeader, kLogIndexHeader);
}

bool is_kept_beside_a_database(std::string_view bytes) {
  return bytes.starts_with(kLogs[0]) || bytes.starts_with(kLogs[1]) || bytes.starts_with(kJournal) ||
         is_log_index(bytes);
}

}  // namespace

std::optional<std::string> database_part(const fs::path& path) {
  if (const auto open = open_database_with(path))
    return fmt::format("this file holds the open database '{}'; choose another name", open->string());
  const std::string name = path.string();
  for (const std::string_view ending : kSidecarEndings) {
    if (!name.ends_with(ending)) continue;
    const std::string database = name.substr(0, name.size() - ending.size());
    if (is_database(database))
      return fmt::format("this file belongs to the database '{}'; choose another name", database);
  }
  const std::string bytes = first_bytes(path);
  if (bytes.starts_with(kDatabase)) return "this file is a database, which no other file may replace";
  if (is_kept_beside_a_database(bytes)) return "this file belongs to a database; choose another name";
  return std::nullopt;
}

}  // namespace algebra3d
