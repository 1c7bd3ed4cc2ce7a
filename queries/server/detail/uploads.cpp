#include "queries/server/detail/uploads.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"

namespace queries {
namespace {

namespace fs = std::filesystem;
using algebra3d::Error;
using algebra3d::ErrorCode;

constexpr std::size_t kLongestName = 200;
// Names of files that are not complete; clients cannot give them.
constexpr const char* kPart = ".part";

}  // namespace

bool is_upload_name(const std::string& name) {
  const auto is_allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-' || c == ' ' || c >= 0x80;
  };
  return !name.empty() && name.size() <= kLongestName && name.front() != '.' && std::ranges::all_of(name, is_allowed) &&
         algebra3d::first_no_text(name) == std::string::npos;
}

Refusal refusal_of(Body::Outcome outcome, std::size_t limit) {
  switch (outcome) {
    case Body::Outcome::too_large:
      return {413, "too_large", fmt::format("the body is larger than {} bytes", limit)};
    case Body::Outcome::too_slow:
      return {408, "timeout", "the body did not arrive in time"};
    default:
      return Refusal::bad_request("the body could not be read");
  }
}

Reply<Uploads::File> Uploads::take(const std::string& name, Body& body) {
  if (!is_upload_name(name))
    return Refusal::bad_request(
        fmt::format("'{}' is not a valid name for an upload; expected letters, digits, '.', '_', '-' and blanks, not "
                    "beginning with '.'",
                    name));
  fs::path part;
  {
    const std::lock_guard lock(mutex_);
    if (list().size() >= most_files_ && !fs::exists(folder() / name))
      return Refusal{429, "too_many", fmt::format("there are {} uploads already", most_files_), "Delete some."};
    part = folder() / fmt::format("{}{}", kPart, ++parts_);
  }
  std::uint64_t bytes = 0;
  std::ofstream file(part, std::ios::binary);
  const Body::Outcome outcome = body.read(most_bytes_, [&](std::string_view piece) {
    file.write(piece.data(), static_cast<std::streamsize>(piece.size()));
    bytes += piece.size();
    return file.good();
  });
  file.close();
  std::error_code error;
  if (outcome == Body::Outcome::complete && file) {
    const std::lock_guard lock(mutex_);
    fs::rename(part, folder() / name, error);
    if (!error) return File{"uploads/" + name, bytes};
  }
  fs::remove(part, error);
  if (outcome != Body::Outcome::complete && outcome != Body::Outcome::refused) return refusal_of(outcome, most_bytes_);
  return refusal_of(Error{ErrorCode::disk_full, "the upload could not be written after {} bytes", bytes});
}

std::vector<Uploads::File> Uploads::list() const {
  std::vector<File> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder(), ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kPart)) files.push_back({"uploads/" + name, entry.file_size(ignored)});
  }
  std::ranges::sort(files, {}, &File::name);
  return files;
}

bool Uploads::remove(const std::string& name) {
  const std::lock_guard lock(mutex_);
  std::error_code ignored;
  return is_upload_name(name) && fs::remove(folder() / name, ignored);
}

}  // namespace queries
