#include "queries/store/detail/sidecar_files.h"

#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "base/open_databases.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Status;
namespace fs = std::filesystem;

/// A journal that names another file ends with these bytes; another one has page content, or zeros, there.
/// Source: https://www.sqlite.org/fileformat.html, section 3, and `readSuperJournal` of SQLite.
constexpr std::string_view kMagic("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);

bool names_another_file(const fs::path& journal) {
  std::ifstream stream(journal, std::ios::binary | std::ios::ate);
  if (!stream || stream.tellg() < static_cast<std::streamoff>(2 * kMagic.size())) return false;
  stream.seekg(-static_cast<std::streamoff>(kMagic.size()), std::ios::end);
  std::string end(kMagic.size(), '\0');
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  return stream && end == kMagic;
}

}  // namespace

// SQLite names them after the file that a symbolic link leads to.
Status check_sidecar_files(const fs::path& database) {
  std::error_code error;
  const fs::path file = fs::canonical(database, error);
  if (error) return {};  // reported where the database is opened
  for (const std::string ending : algebra3d::kSidecarEndings) {
    const fs::path beside = file.string() + ending;
    const fs::file_status status = fs::symlink_status(beside, error);
    if (status.type() == fs::file_type::not_found) continue;
    if (status.type() != fs::file_type::regular)
      return Error{ErrorCode::database_foreign,
                   "{}: not a regular file, as SQLite's files beside a database are; remove it", beside.string()};
    if (ending == "-journal" && names_another_file(beside))
      return Error{ErrorCode::database_foreign,
                   "{}: the journal names another file, which would be deleted; algebra3d makes no such journals; "
                   "remove it, and look at the database with `check database`",
                   beside.string()};
  }
  return {};
}

}  // namespace queries
